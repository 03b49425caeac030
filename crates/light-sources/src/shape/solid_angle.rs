use core::f32::consts::FRAC_1_PI;

use crate::glam::Vec3;

/// The solid angle in sr below which shapes with straight edges are sampled by area: the remaining
/// variance costs less than sampling by solid angle.
pub(super) const SMALL: f32 = 3e-4;

/// The density below which rounding has moved a receiver into the plane of a flat shape: it looks
/// small, though it covers up to the half space over which this is uniform.
pub(super) const LEAST_DENSITY: f32 = 0.5 * FRAC_1_PI;

/// Density per solid angle of a point that was chosen with density `pdf_area` on a surface with
/// unit normal `n`, seen along `to_light` (not of unit length); `None` edge-on, where the density
/// is infinite, and within 1e-19.
#[inline]
pub(super) fn area_to_solid_angle(pdf_area: f32, to_light: Vec3, n: Vec3) -> Option<(Vec3, f32)> {
    let dist_sq = to_light.length_squared();
    // The square of a shorter distance loses digits, and no density of it holds.
    if !(dist_sq >= f32::MIN_POSITIVE) {
        return None;
    }
    let wi = to_light.try_normalize()?;
    let pdf = pdf_area * dist_sq / n.dot(wi).abs();
    (pdf > 0.0 && pdf.is_finite()).then_some((wi, pdf))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_seen_from_their_edge_have_no_density() {
        let seen = |to| area_to_solid_angle(0.5, to, Vec3::Z);
        assert_eq!(seen(Vec3::Z * 2.0), Some((Vec3::Z, 2.0)), "d^2 / A");
        assert_eq!(
            seen(Vec3::NEG_Z * 2.0),
            Some((Vec3::NEG_Z, 2.0)),
            "from behind"
        );
        for none in [
            Vec3::X,
            Vec3::ZERO,
            Vec3::NAN,
            Vec3::Z * 1e-30,
            Vec3::Z * 2e-22,
            Vec3::Z * 1e30,
        ] {
            assert_eq!(seen(none), None, "{none}");
        }
    }
}
