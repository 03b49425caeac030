//! The cone that a box subtends, through its bounding sphere: the range that single precision
//! leaves it.

use super::Certainty;
use crate::Findings;
use glam::DVec3;
use lights::math::glam::Vec3;
use lights::math::{Aabb, DirectionCone};

/// Half a unit in the last place.
const UNIT: f64 = 0.5 * f32::EPSILON as f64;

/// A box seen from a point, and what is true of its cone wherever in the box rounding puts the
/// centre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Subtended {
    to_corners: [DVec3; 2],
    to_center: DVec3,
    /// How far rounding moves the centre.
    moved: f64,
    /// The least and the largest squared cosine: the least is zero on the sphere,
    /// the largest below it inside.
    cos_sq: [f64; 2],
}

impl Subtended {
    /// Of `bounds` from `p`.
    pub(crate) fn new(bounds: &Aabb, p: Vec3) -> Self {
        let [min, max, p] = [bounds.min, bounds.max, p].map(|v| v.as_dvec3());
        let center = 0.5 * (min + max);
        let (to_center, radius) = (center - p, 0.5 * (max - min).length());
        let (dist, moved) = (to_center.length(), 1.01 * UNIT * center.length());
        // 12 units by which the sine grows on purpose, 12 that its rounding may add, and a few of
        // the cosine's own.
        let least = if dist > moved {
            let sin = (radius + moved) / (dist - moved);
            (1.0 - sin * sin * (1.0 + 24.0 * UNIT)) * (1.0 - 8.0 * UNIT)
        } else {
            0.0
        };
        let sin = radius / (dist + moved);
        let largest = (1.0 - sin * sin * (1.0 - 2.0 * UNIT)) * (1.0 + 8.0 * UNIT);
        // A point of the box sees it all around.
        let is_in_box = min.cmple(p).all() && p.cmple(max).all();
        Self {
            to_corners: [min - p, max - p],
            to_center,
            moved,
            cos_sq: if is_in_box {
                [0.0, -1.0]
            } else {
                [least.max(0.0), largest]
            },
        }
    }

    /// Whether a cosine of `cos_theta`, ours, can be told from its half and its double.
    pub(crate) fn certainty(&self, cos_theta: f32) -> Certainty {
        let cos_sq = f64::from(cos_theta).powi(2);
        if cos_theta > 0.0 && (0.25 * cos_sq >= self.cos_sq[0] || 4.0 * cos_sq <= self.cos_sq[1]) {
            Certainty::Undetermined
        } else {
            Certainty::Determined
        }
    }

    /// From zero on the cosine is in the range; below it there is only -1, where the sphere is
    /// reached.
    pub(crate) fn check_cosine(&self, cos_theta: f32, findings: &mut Findings) {
        let [least, largest] = self.cos_sq;
        let cos_sq = f64::from(cos_theta).powi(2);
        let is_right = if cos_theta >= 0.0 {
            least <= cos_sq && cos_sq <= largest
        } else {
            cos_theta == -1.0 && least == 0.0
        };
        findings.check(is_right, || {
            format!("cosine {cos_theta}, its square exactly {least} to {largest}")
        });
    }

    /// The axis is a unit vector toward the centre.
    pub(crate) fn check_axis(&self, w: Vec3, findings: &mut Findings) {
        let (w, exact) = (w.as_dvec3(), self.to_center.normalize_or_zero());
        let tolerance = 2.0 * self.moved / self.to_center.length() + 8.0 * UNIT;
        let is_unit = (w.length() - 1.0).abs() <= 8.0 * UNIT;
        findings.check(is_unit && w.distance(exact) <= tolerance, || {
            format!("axis {w}, exactly {exact}")
        });
    }

    /// All corners are in the cone, up to the round-off of a dot product.
    pub(crate) fn check_corners(&self, cone: DirectionCone, findings: &mut Findings) {
        let (w, cos_theta) = (cone.w.as_dvec3(), f64::from(cone.cos_theta));
        for i in 0..8 {
            let corner = [0, 1, 2].map(|axis| self.to_corners[i >> axis & 1][axis]);
            let corner = DVec3::from_array(corner);
            let is_in = w.dot(corner) >= (cos_theta - 8.0 * UNIT) * corner.length();
            findings.check(cone.is_whole_sphere() || is_in, || {
                format!("{cone:?} lacks {corner}")
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube() -> Aabb {
        Aabb::new(Vec3::splat(-1.0), Vec3::ONE)
    }

    fn fails(check: impl Fn(&mut Findings)) -> bool {
        let mut findings = Findings::default();
        check(&mut findings);
        !findings.failures.is_empty()
    }

    #[test]
    fn a_cube_by_hand() {
        // The sphere of radius sqrt 3, seen from a distance of 2.
        let exact = Subtended::new(&cube(), Vec3::X * 2.0);
        for (cos_theta, is_wrong) in [
            (0.5, false),
            (0.500_01, true),
            (0.499_99, true),
            (-1.0, true),
        ] {
            let fails = fails(|findings| exact.check_cosine(cos_theta, findings));
            assert_eq!(fails, is_wrong, "{cos_theta}");
        }
        for (w, is_wrong) in [(-Vec3::X, false), (Vec3::X, true), (-2.0 * Vec3::X, true)] {
            let fails = fails(|findings| exact.check_axis(w, findings));
            assert_eq!(fails, is_wrong, "{w}");
        }
        // The nearest corners are 1 away along the axis and sqrt 2 across.
        for (cos_sq, is_wrong) in [(0.333f32, false), (0.334, true)] {
            let cone = DirectionCone::new(-Vec3::X, cos_sq.sqrt());
            let fails = fails(|findings| exact.check_corners(cone, findings));
            assert_eq!(fails, is_wrong, "{cos_sq}");
        }
    }

    #[test]
    fn a_point_of_the_box_or_its_sphere_sees_all() {
        for (p, is_wrong) in [
            (Vec3::ONE, true),
            (Vec3::X * 1.5, true),
            (Vec3::X * 3.0, false),
        ] {
            let exact = Subtended::new(&cube(), p);
            let cos_theta = (1.0 - 3.0 / p.length_squared()).max(0.0).sqrt();
            let half = |findings: &mut Findings| exact.check_cosine(cos_theta, findings);
            let all = |findings: &mut Findings| exact.check_cosine(-1.0, findings);
            assert_eq!((fails(half), fails(all)), (is_wrong, !is_wrong), "{p}");
        }
    }
}
