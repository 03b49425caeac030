//! The area of a bilinear patch: the integral of the length of its normal over the unit square.

use crate::glam::Vec2;

/// Tolerance of the difference between a piece and the sum of its quarters, relative to the whole.
const TOLERANCE: f32 = 1e-6;

/// The largest depth of subdivision: the length of a normal that passes zero has a kink.
const DEPTH: u32 = 6;

/// The integral of `length`, of the normal, over the unit square.
///
/// Gauss's rule with adaptive subdivision into quarters.
pub(super) fn integrate(length: impl Fn(Vec2) -> f32) -> f32 {
    let whole = piece(&length, Vec2::ZERO, 1.0);
    refine(&length, Vec2::ZERO, 1.0, whole, TOLERANCE * whole, DEPTH)
}

fn refine(
    length: &impl Fn(Vec2) -> f32,
    low: Vec2,
    size: f32,
    whole: f32,
    tolerance: f32,
    depth: u32,
) -> f32 {
    let half = 0.5 * size;
    let corners = [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE].map(|corner| low + corner * half);
    let quarters = corners.map(|low| piece(length, low, half));
    let sum = quarters.iter().sum::<f32>();
    // NaN ends the search too.
    if depth == 0 || !((sum - whole).abs() > tolerance) {
        return sum;
    }
    let refined = |i: usize| refine(length, corners[i], half, quarters[i], tolerance, depth - 1);
    refined(0) + refined(1) + refined(2) + refined(3)
}

/// The integral over the square with the corner `low`.
fn piece(length: &impl Fn(Vec2) -> f32, low: Vec2, size: f32) -> f32 {
    let mut sum = 0.0;
    for (x, wx) in GAUSS {
        for (y, wy) in GAUSS {
            sum += length(low + Vec2::new(x, y) * size) * (wx * wy);
        }
    }
    sum * size * size
}

/// Nodes and weights on [0, 1] that integrate polynomials up to degree 11 exactly.
///
/// # Source
/// `[DLMF]`, table 3.5.2, moved from [-1, 1].
const GAUSS: [(f32, f32); 6] = [
    (0.033_765_243, 0.085_662_246),
    (0.169_395_307, 0.180_380_787),
    (0.380_690_407, 0.233_956_967),
    (0.619_309_593, 0.233_956_967),
    (0.830_604_693, 0.180_380_787),
    (0.966_234_757, 0.085_662_246),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_and_kinked_lengths() {
        let flat = integrate(|_| 5.0);
        assert!((flat - 5.0).abs() < 1e-5, "{flat}");
        // The normal of a flat bow tie passes zero along a line.
        let kinked = integrate(|uv| (1.0 - 3.0 * uv.x).abs());
        assert!((kinked / (5.0 / 6.0) - 1.0).abs() < 2e-5, "{kinked}");
        // And the one of a saddle at a point: the mean distance from the centre of a square.
        let at_point = integrate(|uv| (uv - 0.5).length());
        let mean_distance = 0.382_597_86;
        assert!((at_point / mean_distance - 1.0).abs() < 1e-5, "{at_point}");
    }
}
