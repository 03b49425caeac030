/// The most lights that ids of 32 bits name.
pub(crate) const MOST: usize = u32::MAX as usize;

/// How many ids so many lights take, `None` if ids of 32 bits are too few: the count itself has 32
/// bits, so that the last id, 2^32 - 1, stays free.
pub(crate) fn id_count(lights: usize) -> Option<u32> {
    u32::try_from(lights).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_more_lights_than_a_count_of_32_bits() {
        assert_eq!(id_count(MOST), Some(u32::MAX), "so many");
        let more = MOST.checked_add(1).and_then(id_count);
        assert_eq!(more, None, "one more");
    }
}
