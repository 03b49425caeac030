//! Solid angles of flat shapes, in steradians.
//!
//! They are exact to a few roundings for shapes of any size, however small, far away or near:
//! differences are taken between corners, never between directions or angles. What is left is the
//! rounding of the corners themselves where the point lies almost in the plane of the shape.

use crate::float::{atan2, inverse_power_of_two};
use glam::Vec3;

/// The solid angle of the triangle `v` seen from `p`, from 0 to `2 pi`; 0 if it has no area or `p`
/// lies in its plane.
///
/// # Source
/// `[VanOosterom1983]`, with the volume from the triangle's own edges.
#[must_use]
pub fn triangle(v: [Vec3; 3], p: Vec3) -> f32 {
    positive(SeenTriangle::new(v, p).half_angle().doubled())
}

/// The solid angle of the convex quadrilateral with the corners `v` in order around it, seen from
/// `p`.
///
/// A quadrilateral that is not planar counts as two triangles, on both sides of the diagonal that
/// looks shorter; where these face opposite ways their solid angles have opposite signs.
///
/// # Source
/// As for [`triangle`]; half angles add up by multiplying complex numbers.
#[must_use]
pub fn quad(v: [Vec3; 4], p: Vec3) -> f32 {
    let r = v.map(|corner| (corner - p).normalize_or_zero());
    let v = if r[0].dot(r[2]) < r[1].dot(r[3]) {
        [v[1], v[2], v[3], v[0]]
    } else {
        v
    };
    let half = |v: [Vec3; 3]| SeenTriangle::new(v, p).half_angle();
    let sum = half([v[0], v[1], v[2]]).plus(half([v[0], v[2], v[3]]));
    positive(sum.doubled())
}

/// Zero for NaN, which represents corners that are not finite.
fn positive(omega: f32) -> f32 {
    if omega > 0.0 { omega } else { 0.0 }
}

/// Half of a signed solid angle, as a complex number of any length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HalfAngle {
    pub(crate) cos: f32,
    pub(crate) sin: f32,
}

impl HalfAngle {
    /// The solid angle without its sign.
    #[inline]
    pub(crate) fn doubled(self) -> f32 {
        let sin = self.sin.abs();
        if sin < 0.1 * self.cos {
            // The arc tangent to the last digit, without a call: most triangles look small.
            let x = sin / self.cos;
            let sq = x * x;
            2.0 * x * (1.0 - sq * (1.0 / 3.0 - sq * (1.0 / 5.0 - sq * (1.0 / 7.0))))
        } else {
            2.0 * atan2(sin, self.cos)
        }
    }

    /// Half the sum of two solid angles.
    fn plus(self, other: Self) -> Self {
        Self {
            cos: self.cos * other.cos - self.sin * other.sin,
            sin: self.cos * other.sin + self.sin * other.cos,
        }
    }
}

/// A triangle seen from a point, in a unit in which no product of three lengths overflows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SeenTriangle {
    /// The corners relative to the second one.
    pub(crate) v: [Vec3; 3],
    /// Distances of the corners from the point, and the unit vectors toward them.
    pub(crate) dist: [f32; 3],
    pub(crate) directions: [Vec3; 3],
    /// The corners relative to the point.
    r: [Vec3; 3],
    /// Of the angles at which the edges are seen: opposite to the first corner, to the second, to
    /// the third.
    cosines: [f32; 3],
}

impl SeenTriangle {
    #[inline]
    pub(crate) fn new(v: [Vec3; 3], p: Vec3) -> Self {
        let r = v.map(|corner| corner - p);
        let farthest = r[0].abs().max(r[1].abs()).max(r[2].abs());
        let scale = inverse_power_of_two(farthest.max_element());
        let r = r.map(|r| r * scale);
        let dist = r.map(Vec3::length);
        let directions = [r[0] / dist[0], r[1] / dist[1], r[2] / dist[2]];
        let [a, b, c] = directions;
        Self {
            v: v.map(|corner| (corner - v[1]) * scale),
            dist,
            directions,
            r,
            cosines: [b.dot(c), c.dot(a), a.dot(b)],
        }
    }

    /// Half the solid angle, positive if the corners run counter-clockwise seen from outside the
    /// sphere.
    ///
    /// With unit vectors a, b, c the cosine is `1 + ab + bc + ca = (a + b)(a + c)`, for any of the
    /// corners as a. Where a term is negative, the opposite pair should be the one with the largest
    /// sum: the product then has no cancellation of its own.
    #[inline]
    pub(crate) fn half_angle(&self) -> HalfAngle {
        let [l0, l1, l2] = self.dist;
        let sin = nearest(self.r, self.dist).dot(normal(self.v)) / (l0 * l1 * l2);
        let [a, b, c] = self.cosines;
        if a > 0.0 && b > 0.0 && c > 0.0 {
            let cos = 1.0 + ((a + b) + c);
            return HalfAngle { cos, sin };
        }
        let sums = [self.sum(1, 2), self.sum(2, 0), self.sum(0, 1)];
        let [a, b, c] = sums.map(Vec3::length_squared);
        let cos = if a >= b && a >= c {
            sums[1].dot(sums[2])
        } else if b >= c {
            sums[2].dot(sums[0])
        } else {
            sums[0].dot(sums[1])
        };
        // From within the plane there is nothing to see, inside of the triangle or not.
        let cos = if sin == 0.0 { cos.abs() } else { cos };
        HalfAngle { cos, sin }
    }

    /// `1 + cos` of the angle at which the edge between the first two corners is seen.
    #[inline]
    pub(crate) fn one_plus_first_cosine(&self) -> f32 {
        let [_, _, cos] = self.cosines;
        if cos > 0.0 {
            1.0 + cos
        } else {
            0.5 * self.sum(0, 1).length_squared()
        }
    }

    /// The sum of the directions toward two corners.
    fn sum(&self, i: usize, j: usize) -> Vec3 {
        direction_sum(self.r[i], self.r[j], self.v[j] - self.v[i])
    }
}

/// The sum of the unit vectors along `r0` and `r1`, where `edge = r1 - r0`.
///
/// Opposite directions leave a small sum: what counts then is how far the edge passes from the
/// origin.
fn direction_sum(r0: Vec3, r1: Vec3, edge: Vec3) -> Vec3 {
    let (l0, l1) = (r0.length(), r1.length());
    if r0.dot(r1) > 0.0 {
        return r0 / l0 + r1 / l1;
    }
    let along = edge.normalize();
    let near = if l0 < l1 { r0 } else { r1 };
    let foot = near - along * near.dot(along);
    let foot = foot - along * foot.dot(along);
    // Both ends lie beyond the foot, each seen at 1 - cos = foot^2 / (l (l + s)) from the edge's
    // own direction.
    let (s0, s1) = (-r0.dot(along), r1.dot(along));
    let excess = 1.0 / (l0 * (l0 + s0)) - 1.0 / (l1 * (l1 + s1));
    foot * (1.0 / l0 + 1.0 / l1) + along * (foot.length_squared() * excess)
}

/// The nearest corner, whose rounding matters least.
#[inline]
fn nearest(r: [Vec3; 3], l: [f32; 3]) -> Vec3 {
    if l[0] <= l[1] && l[0] <= l[2] {
        r[0]
    } else if l[1] <= l[2] {
        r[1]
    } else {
        r[2]
    }
}

/// The normal of the triangle, as long as twice its area, by the two shorter of its edges.
#[inline]
fn normal(v: [Vec3; 3]) -> Vec3 {
    let edges = [v[1] - v[0], v[2] - v[1], v[0] - v[2]];
    let l = edges.map(Vec3::length_squared);
    if l[0] >= l[1] && l[0] >= l[2] {
        edges[1].cross(edges[2])
    } else if l[1] >= l[2] {
        edges[2].cross(edges[0])
    } else {
        edges[0].cross(edges[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f32::consts::{FRAC_PI_2, PI, TAU};

    #[test]
    fn fixed_points() {
        let octant = triangle([Vec3::X, Vec3::Y, Vec3::Z], Vec3::ZERO);
        assert!((octant - FRAC_PI_2).abs() < 1e-6, "octant {octant}");
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let face = quad(corners.map(|(x, y)| Vec3::new(x, y, 1.0)), Vec3::ZERO);
        assert!(
            (face - 2.0 * TAU / 6.0).abs() < 1e-6,
            "face of a cube {face}"
        );
        let wide = quad(
            corners.map(|(x, y)| Vec3::new(1e4 * x, 1e4 * y, 1e-2)),
            Vec3::ZERO,
        );
        assert!((wide - TAU).abs() < 1e-5, "half space {wide}");
    }

    #[test]
    fn nothing_to_see() {
        let v = [Vec3::X, Vec3::Y, Vec3::Z];
        assert_eq!(triangle([Vec3::X; 3], Vec3::ZERO), 0.0, "a point");
        assert_eq!(triangle(v, Vec3::X), 0.0, "at a corner");
        assert_eq!(
            triangle([Vec3::X, Vec3::Y, -Vec3::X], Vec3::ZERO),
            0.0,
            "in its plane"
        );
        assert_eq!(triangle(v, Vec3::NAN), 0.0, "NaN");
        assert_eq!(triangle([Vec3::ZERO; 3], Vec3::ZERO), 0.0, "nothing at all");
        assert!(triangle(v.map(|v| v * 1e30), Vec3::ZERO) > 1.5, "huge");
    }

    #[test]
    fn quads_are_sums_and_winding_does_not_matter() {
        let v = [(0.0, 0.0), (2.0, 0.1), (2.2, 1.5), (0.3, 1.0)].map(|(x, y)| Vec3::new(x, y, 0.7));
        let p = Vec3::new(1.0, 0.4, 0.0);
        let sum = triangle([v[0], v[1], v[2]], p) + triangle([v[0], v[2], v[3]], p);
        assert!((quad(v, p) - sum).abs() < 1e-6, "sum");
        assert!(
            (quad([v[3], v[2], v[1], v[0]], p) - sum).abs() < 1e-6,
            "other way round"
        );
        assert!(
            quad(v, Vec3::new(1.0, 0.5, 0.7)).rem_euclid(PI) < 1e-6,
            "in its plane"
        );
    }

    #[test]
    fn normals_are_those_of_f64_whichever_edge_is_longest() {
        let mut rng = light_testkit::Rng::new(31);
        for _ in 0..1000 {
            let v = [(); 3].map(|()| rng.vec3());
            let edge = |to: usize| [0, 1, 2].map(|i| f64::from(v[to][i]) - f64::from(v[0][i]));
            let ([ax, ay, az], [bx, by, bz]) = (edge(1), edge(2));
            let exact = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
            let normal = normal(v).to_array();
            let error = (0..3).fold(0.0, |e, i| (f64::from(normal[i]) - exact[i]).abs().max(e));
            assert!(error < 1e-5, "{v:?}: {error}");
        }
    }

    /// Seen from close to an edge, the directions to its ends nearly cancel: whichever corners
    /// these are.
    #[test]
    fn beside_an_edge_the_angle_is_that_of_f64() {
        let corners = [(-1.0, 0.0), (2.0, 0.0), (0.3, 1.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
        for turn in 0..3 {
            let v = [0, 1, 2].map(|i| corners[(i + turn) % 3]);
            for (x, y, z) in [(-0.8, 1e-5, 1e-5), (0.1, -1e-5, 2e-5), (1.9, 1e-5, 3e-5)] {
                let p = Vec3::new(x, y, z);
                let (omega, exact) = (triangle(v, p), by_f64(v, p));
                assert!(
                    (f64::from(omega) - exact).abs() < 1e-5,
                    "corner {turn} first, from {p}: {omega}, not {exact}"
                );
            }
        }
    }

    /// The solid angle by the same formula in double precision, where cancellation does not matter.
    fn by_f64(v: [Vec3; 3], p: Vec3) -> f64 {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let [a, b, c] = v.map(|v| {
            let r = [0, 1, 2].map(|i| f64::from(v[i]) - f64::from(p[i]));
            r.map(|x| x / dot(r, r).sqrt())
        });
        let normal = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| b[i] * c[j] - b[j] * c[i]);
        let cos = 1.0 + dot(a, b) + dot(b, c) + dot(c, a);
        2.0 * dot(a, normal).abs().atan2(cos)
    }
}
