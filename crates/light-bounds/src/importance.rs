use light_math::float::{inverse_power_of_two, sqrt};

use crate::angle::Angle;
use crate::glam::Vec3;
use crate::light_bounds::AXIS_TOLERANCE;
use crate::{LightBounds, LightSampleContext, ReceiverKind};

mod segment;

/// Least importance where light may arrive, so that contributions too small for a float keep a
/// positive probability.
const MIN_IMPORTANCE: f32 = f32::MIN_POSITIVE;

/// Largest importance: a sum of two stays finite.
const MAX_IMPORTANCE: f32 = f32::MAX / 4.0;

/// Least value of a cosine factor where light may arrive: more than the rounding of the cosines
/// below, and of a light that evaluates its own emission in single precision.
const COS_SLACK: f32 = 2e-6;

/// Margin, as a cosine, beyond the edge of emission within which a light still counts: rounding,
/// plus three times the allowed error of the length of an axis, which lowers the cosine and may
/// understate each of two angles.
const EDGE_SLACK: f32 = COS_SLACK + 1.5 * AXIS_TOLERANCE;

/// Factor on the sine of the angle that a box subtends, more than its rounding.
const SIN_GROWTH: f32 = 1.0 + 3.0 * f32::EPSILON;

/// The numbers in [`LightBounds::importance`], by name, for ports of it to another language.
pub const IMPORTANCE_CONSTANTS: [(&str, f32); 3] = [
    ("COS_SLACK", COS_SLACK),
    ("EDGE_SLACK", EDGE_SLACK),
    ("SIN_GROWTH", SIN_GROWTH),
];

impl LightBounds {
    /// The importance of the bounded lights at `ctx`, relative to other bounds; no absolute scale.
    ///
    /// Zero only where none of them can contribute. Otherwise positive and finite, for any finite
    /// bounds and any context: also at a box centre, on a point light, and at coordinates whose
    /// squares overflow or underflow. Reads `ctx.p` and `ctx.ns()`. At a surface light counts
    /// from both sides. For a ray segment the mean along it counts, and no light with power has the
    /// importance zero.
    ///
    /// Costs six square roots, seven at a surface, and no trigonometric function.
    ///
    /// # Source
    /// `[PBRT4]`, section 12.6.3: `phi cos theta' cos theta_i' / d^2` with
    /// `theta' = max(0, theta_w - theta_o - theta_b)`. The clamp `d^2 >= |diagonal| / 2` compares a
    /// squared length with a length; it is kept, because this is the baseline. The differences:
    /// sines come from cross products, rounding always errs toward a larger importance, and
    /// the light at the edge of its emission (`theta' = theta_e`) counts, so that a spot without
    /// falloff is found.
    #[inline(always)]
    #[must_use]
    pub fn importance(&self, ctx: &LightSampleContext) -> f32 {
        if self.phi == 0.0 {
            return 0.0;
        }
        if let ReceiverKind::Segment { extent } = *ctx.kind() {
            return self.importance_along(ctx.p, extent);
        }

        // Vector from the centre, and a half box that contains both corners although the centre is
        // rounded; scaled by a power of two so that squares stay in range.
        let center = self.bounds.center();
        let to_p = ctx.p - center;
        let half = (self.bounds.max - center).max(center - self.bounds.min);
        let scale = inverse_power_of_two(to_p.abs().max(half).max_element());
        let (to_p, half) = (to_p * scale, half * scale);
        let dist_sq = to_p.length_squared();
        let radius_sq = half.length_squared();
        if !(dist_sq + radius_sq).is_finite() {
            return MIN_IMPORTANCE;
        }

        // The angle that the box subtends: all directions from within its bounding sphere.
        let dist = sqrt(dist_sq);
        let radius = sqrt(radius_sq);
        let sin_b = radius * SIN_GROWTH / dist;
        let cosines = if sin_b < 1.0 {
            let from_light = to_p / dist;
            let subtended = Angle::from_sin(sin_b);
            let cos_emission = self.cos_emission(from_light, subtended);
            if cos_emission < self.cos_theta_e - EDGE_SLACK {
                return 0.0;
            }
            let cos_incidence = cos_incidence(ctx, from_light, subtended);
            cos_emission.max(COS_SLACK) * cos_incidence.max(COS_SLACK)
        } else {
            1.0
        };

        let half_diagonal = 0.5 * (self.bounds.diagonal() * scale).length();
        let clamped_dist_sq = dist_sq.max(half_diagonal * scale);
        in_range(self.phi * scale / clamped_dist_sq * scale * cosines)
    }

    /// Cosine of the least angle between `from_light` and a normal in the cone, seen from any point
    /// of the box.
    #[inline(always)]
    fn cos_emission(&self, from_light: Vec3, subtended: Angle) -> f32 {
        let cos_w = self.w.dot(from_light);
        let to_axis = Angle {
            sin: self.w.cross(from_light).length(),
            cos: if self.two_sided { cos_w.abs() } else { cos_w },
        };
        let normals = Angle::from_cos(self.cos_theta_o);
        (to_axis - normals - subtended).cos
    }
}

/// Cosine of the least angle between the normal's line and a direction to the box; 1 in a medium.
#[inline(always)]
fn cos_incidence(ctx: &LightSampleContext, from_light: Vec3, subtended: Angle) -> f32 {
    let Some(ns) = ctx.ns() else {
        return 1.0;
    };
    let to_normal = Angle::from_cos(ns.dot(from_light).abs().min(1.0));
    (to_normal - subtended).cos
}

/// An importance above 0 within the range of those; NaN becomes the least.
#[inline(always)]
fn in_range(importance: f32) -> f32 {
    if importance >= MIN_IMPORTANCE {
        importance.min(MAX_IMPORTANCE)
    } else {
        MIN_IMPORTANCE
    }
}

#[cfg(test)]
mod tests;
