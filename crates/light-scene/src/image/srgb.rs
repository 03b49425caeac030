//! The transfer function of sRGB, IEC 61966-2-1.

/// The linear value of an encoded one; both in [0, 1].
pub(super) fn decode(encoded: f32) -> f32 {
    if encoded <= 0.04045 {
        encoded / 12.92
    } else {
        ((encoded + 0.055) / 1.055).powf(2.4)
    }
}

/// The encoded value of a linear one; both in [0, 1].
fn encode(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

/// The encoded value of a linear one as a byte; clamped, NaN becomes 0.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the value was clamped to 0..=255, and the cast makes 0 of NaN"
)]
pub(super) fn encode_byte(linear: f32) -> u8 {
    let clamped = linear.clamp(0.0, 1.0);
    (encode(clamped) * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_survives_the_round_trip() {
        for byte in 0..=u8::MAX {
            let linear = decode(f32::from(byte) / 255.0);
            assert_eq!(encode_byte(linear), byte, "byte {byte}");
        }
        assert_eq!(encode_byte(f32::NAN), 0, "NaN is black");
        assert_eq!(encode_byte(7.0), 255, "clamped");
    }
}
