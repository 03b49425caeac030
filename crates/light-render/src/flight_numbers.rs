/// The random numbers of a flight through media: an unbounded sequence in `[0, 1)`.
///
/// The first is stratified over the samples of the pixel; the others are independent,
/// because a tracker uses an unknown number of them.
///
/// # Source
/// `[Steele2014]`, SplitMix64.
#[derive(Clone, Debug)]
pub struct FlightNumbers {
    first: Option<f32>,
    state: u64,
}

impl FlightNumbers {
    /// Begins with `first`; the numbers after it depend on `key`.
    #[must_use]
    pub const fn new(first: f32, key: u64) -> Self {
        Self {
            first: Some(first),
            state: key,
        }
    }

    /// The next number.
    #[inline]
    pub(crate) fn next_u(&mut self) -> f32 {
        if let Some(first) = self.first.take() {
            return first;
        }
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.state ^ self.state >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        // The upper 24 bits fit into an `f32`.
        ((x ^ x >> 31) >> 40) as f32 / (1u32 << 24) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fill_the_unit_interval() {
        let mut numbers = FlightNumbers::new(0.25, 7);
        assert_eq!(numbers.next_u(), 0.25, "the stratified one first");
        let drawn: Vec<f32> = (0..4096).map(|_| numbers.next_u()).collect();
        assert!(drawn.iter().all(|u| (0.0..1.0).contains(u)), "in range");
        let mean = drawn.iter().sum::<f32>() / 4096.0;
        // Four standard errors of 4096 uniform numbers.
        assert!((mean - 0.5).abs() < 4.0 * 0.289 / 64.0, "mean {mean}");
    }
}
