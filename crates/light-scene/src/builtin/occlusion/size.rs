//! How the size of a place grows with its lamps.

/// How much longer a place is than that of a hundred lamps, if its area grows as the power
/// `2 * exponent` of the number of lamps.
pub(super) fn growth(lamps: usize, exponent: f32) -> f32 {
    (lamps.max(100) as f32 / 100.0).powf(exponent)
}

/// `x` as a count, rounded.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "saturates at the ends"
)]
pub(super) fn count(x: f32) -> u16 {
    x.round() as u16
}
