//! A share of lights in a byte: its root, since factors are roots of shares. A child of which one ray
//! in a thousand sees a light keeps a share that is not 0.

use light_math::float::sqrt;

/// The code with the nearest root, a multiple of 1/255; 0 of what is not a number.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast truncates on purpose and saturates"
)]
pub(super) fn encode_share(share: f32) -> u8 {
    (sqrt(share) * 255.0 + 0.5) as u8
}

/// The share of a code.
pub(super) fn decode_share(code: u8) -> f32 {
    let root = f32::from(code) * (1.0 / 255.0);
    root * root
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

    #[test]
    fn small_shares_are_not_lost() {
        let least = 1.0 / 4096.0;
        let share = decode_share(encode_share(least));
        assert!((0.9..1.1).contains(&(share / least)), "{share}");
    }
}
