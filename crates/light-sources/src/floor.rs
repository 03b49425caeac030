/// The largest whole number that is not above `x`, which `core` lacks in double precision.
#[expect(
    clippy::cast_possible_truncation,
    reason = "saturates, far beyond where a place has a fraction"
)]
pub(crate) fn floor(x: f64) -> f64 {
    let toward_zero = (x as i64) as f64;
    if toward_zero > x {
        toward_zero - 1.0
    } else {
        toward_zero
    }
}
