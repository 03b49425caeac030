//! A triangle seen from a point, and half of its solid angle.

use crate::float::{atan2, inverse_power_of_two};
use crate::opposite::{are_opposite, difference_across, direction_sum};
use glam::Vec3;

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
    pub(crate) fn plus(self, other: Self) -> Self {
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
        let sin = self.volume() / (l0 * l1 * l2);
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

    /// A vector with the same part at right angles to the first corner as the edge from there to
    /// corner `i`, which is short where both are opposite.
    #[inline]
    pub(crate) fn across_first(&self, i: usize) -> Vec3 {
        if are_opposite(self.cosines[3 - i]) {
            difference_across(self.r[0], self.r[i])
        } else {
            self.v[i] - self.v[0]
        }
    }

    /// Six times the volume between the point and the corners, with its sign.
    #[inline]
    fn volume(&self) -> f32 {
        let [a, b, c] = self.cosines;
        if !are_opposite(a.min(b).min(c)) {
            return nearest(self.r, self.dist).dot(normal(self.v));
        }
        // The corner that is not of the closest pair is opposite to one of it, or to both.
        let i = if a > b && a > c {
            0
        } else if b > c {
            1
        } else {
            2
        };
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let across = |j: usize, cos: f32| match are_opposite(cos) {
            true => difference_across(self.r[i], self.r[j]),
            false => self.r[j],
        };
        let [to_j, to_k] = [across(j, self.cosines[k]), across(k, self.cosines[j])];
        self.r[i].dot(to_j.cross(to_k))
    }

    /// The sum of the directions toward two corners.
    fn sum(&self, i: usize, j: usize) -> Vec3 {
        direction_sum(self.r[i], self.r[j], self.v[j] - self.v[i])
    }
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
}
