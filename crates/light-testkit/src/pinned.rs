//! Values that are the same in every revision, known by a number of 64 bits.

/// An FNV-1a hash of numbers, bit by bit.
#[derive(Clone, Copy, Debug)]
pub struct Fingerprint(u64);

impl Default for Fingerprint {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fingerprint {
    /// Adds numbers, in their order.
    pub fn add(&mut self, numbers: impl IntoIterator<Item = f32>) {
        for number in numbers {
            for byte in u64::from(number.to_bits()).to_le_bytes() {
                self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
            }
        }
    }

    /// The hash of all numbers so far.
    #[must_use]
    pub const fn value(&self) -> u64 {
        self.0
    }
}

/// Compares names and [fingerprints](Fingerprint) with those that are `pinned`.
///
/// # Panics
/// If one of them is another, or not there; the message has a table of all as they are now.
pub fn assert_pinned(found: &[(&str, u64)], pinned: &[(&str, u64)]) {
    let row = |(name, value): &(&str, u64)| format!("    (\"{name}\", {value:#018x}),\n");
    let moved: Vec<_> = found.iter().filter(|one| !pinned.contains(one)).collect();
    let table: String = found.iter().map(row).collect();
    assert!(
        moved.is_empty() && found.len() == pinned.len(),
        "moved: {moved:?}; all are now\n{table}"
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_bit_changes_a_fingerprint() {
        let of = |numbers: [f32; 2]| {
            let mut all = Fingerprint::default();
            all.add(numbers);
            all.value()
        };
        assert_eq!(of([1.0, 2.0]), of([1.0, 2.0]), "the same");
        assert_ne!(of([1.0, 2.0]), of([2.0, 1.0]), "another order");
        assert_ne!(of([0.0, 2.0]), of([-0.0, 2.0]), "another sign");
    }

    #[test]
    fn what_is_pinned_is_compared() {
        assert_pinned(&[("a", 1), ("b", 2)], &[("a", 1), ("b", 2)]);
    }

    #[test]
    #[should_panic(expected = "moved: [(\"b\", 3)]")]
    fn what_moved_is_named() {
        assert_pinned(&[("a", 1), ("b", 3)], &[("a", 1), ("b", 2)]);
    }
}
