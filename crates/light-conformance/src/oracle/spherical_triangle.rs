use super::warp::bisect;
use glam::{DVec2, DVec3};

/// A triangle seen from a point, as Arvo 1995 cuts it: by an arc from the second corner to the
/// opposite side.
///
/// The cut is found by bisection on areas and not by Arvo's formula, which subtracts angles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ExactTriangle {
    /// Corners from the point.
    r: [DVec3; 3],
}

impl ExactTriangle {
    pub(crate) fn new(v: [DVec3; 3], p: DVec3) -> Self {
        Self {
            r: v.map(|v| v - p),
        }
    }

    pub(crate) fn solid_angle(&self) -> f64 {
        let [a, b, c] = self.r;
        solid_angle(a, b, c)
    }

    /// Barycentric coordinates for `u`.
    pub(crate) fn sample(&self, u: DVec2) -> DVec3 {
        let [a, b, c] = self.r;
        let area = u.x * self.solid_angle();
        let cut = bisect(|s| solid_angle(a, b, a + s * (c - a)) - area);
        let edge = a + cut * (c - a) - b;
        // sin^2 of half the angle from b grows evenly.
        let half = 0.5 * (edge + b).normalize().distance(b.normalize());
        let (sin, cos) = (2.0 * (u.y.sqrt() * half).min(1.0).asin()).sin_cos();
        let (along, across) = parts(edge, b);
        let walked = b.length() * sin / (across * cos - along * sin);
        let walked = if walked >= 0.0 { walked.min(1.0) } else { 1.0 };
        DVec3::new((1.0 - cut) * walked, 1.0 - walked, cut * walked)
    }

    /// The `u` of barycentric coordinates.
    pub(crate) fn invert(&self, weights: DVec3) -> DVec2 {
        let [a, b, c] = self.r;
        let walked = weights.x + weights.z;
        let end = a + weights.z / walked * (c - a);
        let at = b + walked * (end - b);
        let chord_sq = |p: DVec3| p.normalize().distance_squared(b.normalize());
        DVec2::new(
            solid_angle(a, b, end) / self.solid_angle(),
            chord_sq(at) / chord_sq(end),
        )
    }
}

/// What `v` adds along `axis` and at right angles to it.
fn parts(v: DVec3, axis: DVec3) -> (f64, f64) {
    let axis = axis.normalize();
    (v.dot(axis), v.cross(axis).length())
}

/// The solid angle of a triangle by van Oosterom and Strackee 1983, with differences of corners in
/// the volume.
fn solid_angle(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let volume = a.dot((b - a).cross(c - a)).abs();
    let [la, lb, lc] = [a, b, c].map(DVec3::length);
    let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * f64::atan2(volume, below)
}
