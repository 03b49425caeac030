use light_math::float::{inverse_power_of_two, safe_acos};

use super::{COS_SLACK, EDGE_SLACK, MIN_IMPORTANCE, SIN_GROWTH, in_range};
use crate::LightBounds;
use crate::angle::Angle;
use crate::glam::Vec3;

/// Cosine factor of a light that emits beside the segment. Not zero, so that no rounding of the
/// directions to a segment loses light.
const COS_ASIDE: f32 = COS_SLACK * COS_SLACK;

/// Sine below which the ends of a segment on both sides of a light are in one line with it.
const IN_LINE: f32 = 1e-3;

impl LightBounds {
    /// The importance for a ray segment from `p` to `p + extent`: the power, times the mean of the
    /// inverse squared distance, times the cosine factor of the point that has the largest.
    ///
    /// The mean along the segment is `angle / (sin(angle) |a| |b|)` for the vectors `a` and `b` from
    /// the light to its ends and the angle between them. It is at most the inverse squared distance
    /// of the nearest point, clamped as that of a point is.
    pub(super) fn importance_along(&self, p: Vec3, extent: Vec3) -> f32 {
        let center = self.bounds.center();
        let (a, b) = (p - center, p + extent - center);
        let half = (self.bounds.max - center).max(center - self.bounds.min);
        let scale = inverse_power_of_two(a.abs().max(b.abs()).max(half).max_element());
        let (a, b, half) = (a * scale, b * scale, half * scale);
        if !(a.length_squared() + b.length_squared() + half.length_squared()).is_finite() {
            return MIN_IMPORTANCE;
        }

        let along = b - a;
        // Written so that 0/0 becomes the start.
        let t = (-a.dot(along) / along.length_squared()).min(1.0);
        let nearest = if t > 0.0 { a + along * t } else { a };
        let half_diagonal = 0.5 * (self.bounds.diagonal() * scale).length();
        let clamped_dist_sq = nearest.length_squared().max(half_diagonal * scale);

        let product = a.length() * b.length();
        let (cross, cos) = (a.cross(b), a.dot(b) / product);
        let sin = cross.length() / product;
        let stretch = if cos > 0.0 && sin < IN_LINE {
            1.0
        } else {
            safe_acos(cos) / sin
        };
        // Written so that NaN, next to the light, becomes the largest.
        let largest = 1.0 / clamped_dist_sq;
        let mean = (stretch / product).min(largest);

        let sin_b = half.length() * SIN_GROWTH / nearest.length();
        let through = cos < 0.0 && sin < IN_LINE;
        let cosine = if sin_b < 1.0 && !through {
            self.cosine_along(a, b, cross, Angle::from_sin(sin_b))
        } else {
            1.0
        };
        in_range(self.phi * scale * mean * scale * cosine)
    }

    /// The largest cosine factor between the directions `a` and `b`: at one of them, or at the
    /// direction between them that is nearest to the axis.
    fn cosine_along(&self, a: Vec3, b: Vec3, normal: Vec3, subtended: Angle) -> f32 {
        let axis = normal.cross(self.w).cross(normal);
        let between = |w: Vec3| a.cross(w).dot(normal) > 0.0 && w.cross(b).dot(normal) > 0.0;
        let inside = [axis, -axis].into_iter().find(|&w| between(w));
        let directions = [a, b, inside.unwrap_or(a)];
        let cosines = directions.map(|w| match w.try_normalize() {
            Some(w) => self.cos_emission(w, subtended),
            None => 1.0,
        });
        let largest = cosines[0].max(cosines[1]).max(cosines[2]);
        if largest < self.cos_theta_e - EDGE_SLACK {
            COS_ASIDE
        } else {
            largest.max(COS_SLACK)
        }
    }
}
