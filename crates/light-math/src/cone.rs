use core::f32::consts::PI;

use glam::Vec3;

use crate::Aabb;
use crate::float::{cos, inverse_power_of_two, safe_acos, safe_asin, sin_cos, sqrt};

/// Round-off of the dot product of two unit vectors, each known to half a unit in the last place.
const DOT_ERROR: f32 = 4.0 * f32::EPSILON;

/// Enlargement of the squared sine of the angle that a box subtends, against its rounding error: 12
/// half units in the last place.
///
/// A squared length of three rounded differences is known to 5 of them: 2 by the difference, 1 by
/// the square, 2 by the sums. The squares of radius and distance make 10, and the product with this
/// constant 1. Scaling is exact. What is rounded later, the difference of the squares, their
/// quotient and its root, is relative to the cosine.
const SUBTENDED_GROWTH: f32 = 1.0 + 6.0 * f32::EPSILON;

/// All directions within an angle of an axis.
///
/// Directions are unit vectors, angles radians. A cone is empty, a single direction, wider, or the
/// whole sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DirectionCone {
    /// Unit axis; without meaning when the cone is empty or the whole sphere.
    pub w: Vec3,
    /// Cosine of the half angle; infinite when the cone is empty, -1 for the whole sphere.
    pub cos_theta: f32,
}

impl DirectionCone {
    /// The cone that holds no direction and is neutral under [`union`](Self::union).
    pub const EMPTY: Self = Self {
        w: Vec3::Z,
        cos_theta: f32::INFINITY,
    };

    /// The cone that holds every direction.
    pub const WHOLE_SPHERE: Self = Self {
        w: Vec3::Z,
        cos_theta: -1.0,
    };

    /// The cone of the directions whose angle with the unit vector `w` has a cosine of at least
    /// `cos_theta`.
    #[inline]
    #[must_use]
    pub const fn new(w: Vec3, cos_theta: f32) -> Self {
        Self { w, cos_theta }
    }

    /// The cone that holds the unit vector `w` alone.
    #[inline]
    #[must_use]
    pub const fn from_direction(w: Vec3) -> Self {
        Self::new(w, 1.0)
    }

    /// Whether the cone holds no direction at all.
    #[inline]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.cos_theta > 1.0
    }

    /// Whether the cone holds every direction.
    #[inline]
    #[must_use]
    pub fn is_whole_sphere(&self) -> bool {
        self.cos_theta <= -1.0
    }

    /// The half angle in `[0, pi]`; 0 for the empty cone.
    #[inline]
    #[must_use]
    pub fn theta(&self) -> f32 {
        safe_acos(self.cos_theta)
    }

    /// Whether the unit vector `w` lies in the closed cone.
    ///
    /// Generous by the rounding error of a dot product, so that no direction that lies in the cone
    /// is denied: a cone holds its own axis, however narrow it is.
    #[inline]
    #[must_use]
    pub fn contains(&self, w: Vec3) -> bool {
        self.is_whole_sphere() || self.w.dot(w) >= self.cos_theta - DOT_ERROR
    }

    /// A cone that holds both cones, the narrowest one unless rounding error interferes.
    ///
    /// # Source
    /// `[PBRT4]`, section 3.8.4. The cross product is taken with the difference (or sum) of the
    /// axes, which keeps its digits when they are nearly parallel.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        if self.is_empty() {
            return other;
        }
        if other.is_empty() {
            return self;
        }

        // One cone may hold the other.
        let theta_a = self.theta();
        let theta_b = other.theta();
        let theta_d = angle_between(self.w, other.w);
        if (theta_d + theta_b).min(PI) <= theta_a {
            return self;
        }
        if (theta_d + theta_a).min(PI) <= theta_b {
            return other;
        }

        // The spread from the far side of one to the far side of the other.
        let theta_o = 0.5 * (theta_a + theta_d + theta_b);
        if theta_o >= PI {
            return Self::WHOLE_SPHERE;
        }
        let Some(toward_other) = tangent_toward(self.w, other.w) else {
            return Self::WHOLE_SPHERE;
        };
        let (sin_r, cos_r) = sin_cos(theta_o - theta_a);
        let w = self.w * cos_r + toward_other * sin_r;
        Self::new(w.normalize(), cos(theta_o))
    }

    /// A cone that holds the directions from `p` to every point of `bounds`, through the box's
    /// bounding sphere.
    ///
    /// The whole sphere when `p` lies inside that sphere or, up to rounding, on it, so wherever it
    /// lies in the box; empty when the box is. Lengths are in scene units of any scale: nothing
    /// over- or underflows as long as the differences of the coordinates do not.
    ///
    /// # Source
    /// `[PBRT4]`, section 3.8.4: `sin^2 theta_max = r^2 / d^2`.
    #[must_use]
    pub fn bound_subtended_directions(bounds: &Aabb, p: Vec3) -> Self {
        if bounds.is_empty() {
            return Self::EMPTY;
        }
        let center = bounds.center();
        let to_center = center - p;
        // To both corners, wherever rounding has put the centre of a box that is a few units in the
        // last place wide.
        let half_diagonal = (bounds.max - center).max(center - bounds.min);

        // Scaled so that squares stay in range.
        let scale = inverse_power_of_two(to_center.abs().max(half_diagonal).max_element());
        let to_center = to_center * scale;
        let radius_sq = (half_diagonal * scale).length_squared() * SUBTENDED_GROWTH;
        let dist_sq = to_center.length_squared();
        // NaN and infinite differences fail the guard, and a point at its own box.
        if !(radius_sq < dist_sq && dist_sq < f32::INFINITY) {
            return Self::WHOLE_SPHERE;
        }
        Self::new(
            to_center / sqrt(dist_sq),
            sqrt((dist_sq - radius_sq) / dist_sq),
        )
    }
}

impl Default for DirectionCone {
    fn default() -> Self {
        Self::EMPTY
    }
}

/// The angle between unit vectors, in `[0, pi]`, accurate near both ends.
#[inline]
fn angle_between(a: Vec3, b: Vec3) -> f32 {
    if a.dot(b) < 0.0 {
        PI - 2.0 * safe_asin(0.5 * (a + b).length())
    } else {
        2.0 * safe_asin(0.5 * (b - a).length())
    }
}

/// The unit vector perpendicular to `a` on the way to `b`; `None` when they are the same or
/// opposite.
#[inline]
fn tangent_toward(a: Vec3, b: Vec3) -> Option<Vec3> {
    let near = if a.dot(b) < 0.0 { b + a } else { b - a };
    a.cross(near).cross(a).try_normalize()
}

#[cfg(test)]
mod tests;
