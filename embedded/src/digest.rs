/// A hash of the words that queries answer: equal words in equal order, or another hash.
///
/// FNV-1a over words instead of bytes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Digest(u64);

impl Digest {
    pub(crate) const EMPTY: Self = Self(0xcbf2_9ce4_8422_2325);

    pub(crate) fn add(&mut self, word: u32) {
        self.0 = (self.0 ^ u64::from(word)).wrapping_mul(0x100_0000_01b3);
    }

    /// Upper and lower word.
    pub(crate) fn words(self) -> [u32; 2] {
        [(self.0 >> 32) as u32, self.0 as u32]
    }
}
