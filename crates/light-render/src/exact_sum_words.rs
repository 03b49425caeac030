/// The number of integers of the sum of a channel, and how many of them are always stored; omitted
/// ones are 0.
pub(crate) const WORDS: usize = 4;
pub(crate) const LOW_WORDS: usize = 2;

/// A sum as integers of 32 bits, the lowest first.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the parts of a number"
)]
pub(crate) fn words(steps: i128) -> [u32; WORDS] {
    core::array::from_fn(|word| (steps >> (32 * word)) as u32)
}

/// The inverse of [`words`].
pub(crate) fn from_words(words: [u32; WORDS]) -> i128 {
    let mut steps = 0;
    for (i, word) in words.into_iter().enumerate() {
        steps |= i128::from(word) << (32 * i);
    }
    steps
}
