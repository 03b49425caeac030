//! Edges whose ends are seen in nearly opposite directions.
//!
//! What counts there is how far the edge passes from the point, which is small; differences of
//! rounded products lose its digits. A multiple of one end that is added to the other leaves just
//! that, and its products are exact.

use glam::Vec3;

/// Whether vectors at this cosine cancel so far that rounding their products loses more than one
/// binary digit of their sine.
pub(crate) fn are_opposite(cos: f32) -> bool {
    cos < -0.9
}

/// The sum of the unit vectors along `r0` and `r1`, where `edge = r1 - r0`.
///
/// Opposite directions leave a small sum: what counts then is how far the edge passes from the
/// origin.
pub(crate) fn direction_sum(r0: Vec3, r1: Vec3, edge: Vec3) -> Vec3 {
    let (l0, l1) = (r0.length(), r1.length());
    if r0.dot(r1) > 0.0 {
        return r0 / l0 + r1 / l1;
    }
    let along = edge.normalize();
    let near = if are_opposite(r0.dot(r1) / (l0 * l1)) {
        let multiple = multiple_across(l0, l1);
        plus_multiple(r1, r0, multiple) / (1.0 + multiple)
    } else if l0 < l1 {
        r0
    } else {
        r1
    };
    let foot = near - along * near.dot(along);
    let foot = foot - along * foot.dot(along);
    // Both ends lie beyond the foot, each seen at 1 - cos = foot^2 / (l (l + s)) from the edge's
    // own direction.
    let (s0, s1) = (-r0.dot(along), r1.dot(along));
    let excess = 1.0 / (l0 * (l0 + s0)) - 1.0 / (l1 * (l1 + s1));
    foot * (1.0 / l0 + 1.0 / l1) + along * (foot.length_squared() * excess)
}

/// `r1` plus a multiple of `r0`, which leaves little along `r0` where both are opposite.
pub(crate) fn difference_across(r0: Vec3, r1: Vec3) -> Vec3 {
    plus_multiple(r1, r0, multiple_across(r0.length(), r1.length()))
}

/// The quotient of two lengths with half of its digits, so that products with it are exact.
fn multiple_across(l0: f32, l1: f32) -> f32 {
    // Any multiple is right; this one is finite where a length is subnormal.
    upper_half((l1 / l0).min(1e30))
}

/// `v + multiple * axis` up to a rounding of the result and not of its terms, for a multiple of
/// half the digits.
///
/// Opposite vectors cancel to the part of `v` across `axis`. Both halves of the digits of `axis`
/// have exact products, and the sum with the first one is exact where it cancels.
fn plus_multiple(v: Vec3, axis: Vec3, multiple: f32) -> Vec3 {
    let upper = axis.map(upper_half);
    (v + upper * multiple) + (axis - upper) * multiple
}

/// `x` with the upper 12 of its 24 digits.
fn upper_half(x: f32) -> f32 {
    f32::from_bits(x.to_bits() & !0xfff)
}
