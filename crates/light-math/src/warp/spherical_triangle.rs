//! Directions toward a triangle, uniform in solid angle.

use crate::float::{atan2, inverse_power_of_two, sin_cos, sqrt};
use crate::seen_triangle::SeenTriangle;
use glam::{Vec2, Vec3};

/// A triangle projected to the unit sphere around a point.
///
/// Samples are barycentric coordinates; the direction is from the point to the place on the
/// triangle. The density is the same everywhere, so the pdf needs no argument.
///
/// # Source
/// `[Arvo1995]`: `u.x` cuts off a part of the area by an arc from the second corner to the opposite
/// side, `u.y` walks along that arc, even in the cosine. Arvo solves for the cut with the angles of
/// the triangle, whose sum loses all digits for a small one. With the tangents of half angles (see
/// `[VanOosterom1983]`) the equation for the cut is linear, and places on edges follow from the
/// edges themselves, so a triangle of 1e-12 steradians is sampled as well as one of 6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalTriangle {
    /// The side from the first to the third corner, and the edge from the second corner to the
    /// first.
    opposite: Side,
    second_to_first: Vec3,
    /// Unit vectors toward the corners, and the distance of the second one.
    directions: [Vec3; 3],
    second_dist: f32,
    /// In the frame of the first corner, where the side opposite to the second one starts along a
    /// tangent: the volume of both directions and the tangent, the second direction along the
    /// tangent, and `1 + cos` of the angle between both directions.
    volume: f32,
    along_tangent: f32,
    one_plus_cos: f32,
    solid_angle: f32,
}

impl SphericalTriangle {
    /// The triangle `v` seen from `p`; `None` if it covers no solid angle there.
    #[inline]
    #[must_use]
    pub fn new(v: [Vec3; 3], p: Vec3) -> Option<Self> {
        let seen = SeenTriangle::new(v, p);
        let half = seen.half_angle();
        let solid_angle = half.doubled();
        let ([l0, l1, l2], [first, ..]) = (seen.dist, seen.directions);

        let first_to_second = seen.v[1] - seen.v[0];
        let side = seen.v[2] - seen.v[0];
        let rejected = rejection(seen.across_first(2), first);
        let opposite = Side::new(side, side.dot(first), rejected, l0);
        let this = Self {
            opposite,
            second_to_first: -first_to_second,
            directions: seen.directions,
            second_dist: l1,
            volume: half.sin.abs() * l2 / opposite.across,
            along_tangent: seen.across_first(1).dot(rejected) / (l1 * opposite.across),
            one_plus_cos: seen.one_plus_first_cosine(),
            solid_angle,
        };
        let is_usable = solid_angle > 0.0 && this.volume > 0.0 && this.volume.is_finite();
        is_usable.then_some(this)
    }

    /// The solid angle in steradians, above 0 and at most `2 pi`.
    #[inline]
    #[must_use]
    pub fn solid_angle(&self) -> f32 {
        self.solid_angle
    }

    /// The unit vectors toward the corners.
    #[inline]
    #[must_use]
    pub fn directions(&self) -> [Vec3; 3] {
        self.directions
    }

    /// Barycentric coordinates for `u`, not negative and of sum 1.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: Vec2) -> Vec3 {
        let (sin_half, cos_half) = sin_cos_of_small(0.5 * u.x * self.solid_angle);
        let cut = self.opposite.place_of_half_angle(
            sin_half * self.one_plus_cos,
            cos_half * self.volume - sin_half * self.along_tangent,
        );
        let arc = self.arc_to(cut);
        let (sin_sq, cos_sq) = arc.half_angle_squares(1.0);
        let (sin_sq, cos_sq) = (u.y * sin_sq, (1.0 - u.y) + u.y * cos_sq);
        let walked = arc.place_of_angle(2.0 * sqrt(sin_sq * cos_sq), cos_sq - sin_sq);
        Vec3::new((1.0 - cut) * walked, 1.0 - walked, cut * walked)
    }

    /// The density per solid angle of all samples, `1 / solid_angle`.
    #[inline]
    #[must_use]
    pub fn pdf(&self) -> f32 {
        1.0 / self.solid_angle
    }

    /// The `u` in `[0, 1]^2` that [`sample`](Self::sample) takes to the coordinates; `u.x` is 0 at
    /// the second corner, where it is not determined.
    #[must_use]
    pub fn invert(&self, barycentric: Vec3) -> Vec2 {
        let walked = barycentric.x + barycentric.z;
        if !(walked > 0.0) {
            return Vec2::ZERO;
        }
        let cut = barycentric.z / walked;
        let (sin_half, cos_half) = self.opposite.half_angle(cut);
        let half = atan2(
            sin_half * self.volume,
            cos_half * self.one_plus_cos + sin_half * self.along_tangent,
        );
        let arc = self.arc_to(cut);
        let share = arc.half_angle_squares(walked).0 / arc.half_angle_squares(1.0).0;
        Vec2::new(2.0 * half / self.solid_angle, share).clamp(Vec2::ZERO, Vec2::ONE)
    }

    /// The side from the second corner to a place on the opposite one.
    #[inline]
    fn arc_to(&self, cut: f32) -> Side {
        let edge = self.second_to_first + self.opposite.edge * cut;
        let [_, second, _] = self.directions;
        let along = edge.dot(second);
        Side::new(edge, along, rejection(edge, second), self.second_dist)
    }
}

/// An edge seen from a point: places on it are fractions, from 0 at its start to 1 at its end.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Side {
    /// The edge as a vector, the distance of its start, and what it adds along that direction and
    /// at right angles.
    edge: Vec3,
    start_dist: f32,
    along: f32,
    across: f32,
}

impl Side {
    /// The edge with its part along the direction of its start, what is `rejected` from there, and
    /// the distance of its start.
    #[inline]
    fn new(edge: Vec3, along: f32, rejected: Vec3, start_dist: f32) -> Self {
        Self {
            edge,
            start_dist,
            along,
            across: rejected.length(),
        }
    }

    /// Coordinates of a place in the frame of the start: along its direction, and across.
    #[inline]
    fn coordinates(&self, place: f32) -> Vec2 {
        Vec2::new(self.start_dist + place * self.along, place * self.across)
    }

    /// Sine and cosine, up to a factor, of half the angle between the start and a place.
    #[inline]
    fn half_angle(&self, place: f32) -> (f32, f32) {
        let Vec2 { x, y } = self.coordinates(place);
        let dist = sqrt(x * x + y * y);
        if x > 0.0 {
            (y, dist + x)
        } else {
            (dist - x, y)
        }
    }

    /// The squares of sine and cosine of half the angle between the start and a place.
    #[inline]
    fn half_angle_squares(&self, place: f32) -> (f32, f32) {
        let (sin_half, cos_half) = self.half_angle(place);
        let (sin_sq, cos_sq) = (sin_half * sin_half, cos_half * cos_half);
        let scale = 1.0 / (sin_sq + cos_sq);
        (sin_sq * scale, cos_sq * scale)
    }

    /// The place that [`half_angle`](Self::half_angle) takes to these two.
    #[inline]
    fn place_of_half_angle(&self, sin_half: f32, cos_half: f32) -> f32 {
        // Near 1, so that neither square overflows nor both vanish.
        let scale = inverse_power_of_two(sin_half.max(cos_half));
        let (sin_half, cos_half) = (sin_half * scale, cos_half.max(0.0) * scale);
        let sin = 2.0 * sin_half * cos_half;
        let cos = (cos_half - sin_half) * (cos_half + sin_half);
        self.place_of_angle(sin, cos)
    }

    /// The place seen at an angle from the start, given its sine and cosine up to a factor.
    #[inline]
    fn place_of_angle(&self, sin: f32, cos: f32) -> f32 {
        let place = self.start_dist * sin / (self.across * cos - self.along * sin);
        if place >= 0.0 {
            place.min(1.0)
        } else if sin > 0.0 {
            // Just beyond the angle at which the edge is never met.
            1.0
        } else {
            0.0
        }
    }
}

/// Sine and cosine of `x`, which is mostly small and not negative.
#[inline]
fn sin_cos_of_small(x: f32) -> (f32, f32) {
    if !(x < 0.1) {
        return sin_cos(x);
    }
    let sq = x * x;
    (
        x * (1.0 - sq * (1.0 / 6.0 - sq * (1.0 / 120.0))),
        1.0 - sq * (0.5 - sq * (1.0 / 24.0)),
    )
}

/// What is left of `v` at right angles to the unit vector `axis`; twice, for the digits that the
/// first time loses.
#[inline]
fn rejection(v: Vec3, axis: Vec3) -> Vec3 {
    let once = v - axis * axis.dot(v);
    once - axis * axis.dot(once)
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f32::consts::FRAC_PI_2;

    const OCTANT: [Vec3; 3] = [Vec3::X, Vec3::Y, Vec3::Z];

    #[test]
    fn fixed_points() {
        let octant = SphericalTriangle::new(OCTANT, Vec3::ZERO).expect("a solid angle");
        assert!(
            (octant.solid_angle() - FRAC_PI_2).abs() < 1e-6,
            "an eighth of the sphere"
        );
        let near = SphericalTriangle::new(OCTANT.map(|v| Vec3::ONE + 4.0 * v), Vec3::ONE);
        let near = near.expect("the same solid angle");
        assert_eq!(near.directions(), OCTANT, "toward the corners");
        let corners = [
            (0.0, 0.0, Vec3::Y),
            (0.0, 1.0, Vec3::X),
            (1.0, 1.0, Vec3::Z),
        ];
        for (x, y, corner) in corners {
            let b = octant.sample(Vec2::new(x, y));
            assert!(b.distance(corner) < 1e-6, "corner of {x} {y}: {b}");
        }
        let middle = octant.sample(Vec2::new(0.5, 1.0));
        assert!(
            middle.distance(Vec3::new(0.5, 0.0, 0.5)) < 1e-6,
            "middle of a side {middle}"
        );
    }

    #[test]
    fn nothing_to_sample() {
        let new = SphericalTriangle::new;
        assert_eq!(new([Vec3::X; 3], Vec3::ZERO), None, "a point");
        assert_eq!(
            new([Vec3::X, Vec3::X * 2.0, Vec3::X * 3.0], Vec3::Y),
            None,
            "a line"
        );
        assert_eq!(new(OCTANT, Vec3::X), None, "at a corner");
        assert_eq!(new(OCTANT, Vec3::NAN), None, "nowhere");
        assert_eq!(
            new(OCTANT.map(|v| v * f32::INFINITY), Vec3::ZERO),
            None,
            "infinite"
        );
    }

    #[test]
    fn winding_and_scale_do_not_matter() {
        let [a, b, c] = OCTANT;
        let u = Vec2::new(0.3, 0.6);
        for v in [
            [c, b, a],
            OCTANT.map(|v| v * 1e18),
            OCTANT.map(|v| v * 1e-18),
        ] {
            let triangle = SphericalTriangle::new(v, Vec3::ZERO).expect("a solid angle");
            let back = triangle.invert(triangle.sample(u));
            assert!(back.distance(u) < 1e-6, "round trip {back} for {v:?}");
        }
    }
}
