//! A share of lights in a byte.

/// The nearest multiple of 1/255; 0 of what is not a number.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast truncates on purpose and saturates"
)]
pub(super) const fn encode_share(share: f32) -> u8 {
    (share * 255.0 + 0.5) as u8
}

/// The share of a code.
pub(super) fn decode_share(code: u8) -> f32 {
    f32::from(code) * (1.0 / 255.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_come_back() {
        for code in 0..=u8::MAX {
            assert_eq!(encode_share(decode_share(code)), code, "code");
            assert!((0.0..=1.0).contains(&decode_share(code)), "{code}");
        }
        assert_eq!(encode_share(f32::NAN), 0, "not a number");
    }
}
