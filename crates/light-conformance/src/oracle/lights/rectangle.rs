use super::area::{At, Cosines, SMALL, Shape};
use super::by_solid_angle::{self, BySolidAngle};
use super::exact_light::Receiver;
use crate::oracle::{ExactRectangle, Jitter};
use glam::{DVec2, DVec3};

/// A rectangle, sampled by solid angle, or by area where it is small.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rectangle {
    corner: DVec3,
    edges: [DVec3; 2],
}

impl Rectangle {
    /// The rectangle with these corners at (0, 0), (1, 0), (0, 1), (1, 1), if they are one.
    pub(super) fn new([p00, p10, p01, p11]: [DVec3; 4]) -> Option<Self> {
        let edges = [p10 - p00, p01 - p00];
        let off = p11 - (p00 + edges[0] + edges[1]);
        let is_parallelogram = off.length() <= 1e-5 * (edges[0] + edges[1]).length();
        let cos = edges[0].normalize().dot(edges[1].normalize());
        (is_parallelogram && cos.abs() <= 1e-4).then(|| Self {
            corner: p00,
            edges: [edges[0], edges[1].reject_from(edges[0])],
        })
    }

    fn corners(&self) -> [DVec3; 4] {
        let [x, y] = self.edges;
        [DVec3::ZERO, x, y, x + y].map(|d| self.corner + d)
    }
}

impl Shape for Rectangle {
    fn area(&self) -> f64 {
        self.edges[0].length() * self.edges[1].length()
    }

    fn bounds(&self) -> [DVec3; 2] {
        let [a, b, c, d] = self.corners();
        [a.min(b).min(c).min(d), a.max(b).max(c).max(d)]
    }

    fn normals(&self) -> (DVec3, f64) {
        (self.at(DVec2::ZERO).n, 1.0)
    }

    fn sample(&self, u: DVec2, _jitter: &mut Jitter) -> Option<At> {
        Some(self.at(u))
    }

    fn toward(&self, from: &Receiver, u: DVec2, jitter: &mut Jitter) -> Option<(At, f64)> {
        by_solid_angle::toward(self, from, u, jitter)
    }

    fn pdf_toward(&self, from: &Receiver, wi: DVec3, jitter: &mut Jitter) -> f64 {
        by_solid_angle::pdf_toward(self, from, wi, jitter)
    }
}

impl BySolidAngle for Rectangle {
    type Seen = ExactRectangle;

    fn at(&self, uv: DVec2) -> At {
        let [x, y] = self.edges;
        At {
            p: self.corner + x * uv.x + y * uv.y,
            n: x.cross(y).normalize(),
            uv,
        }
    }

    fn seen(&self, from: &Receiver, jitter: &mut Jitter) -> Option<(ExactRectangle, Cosines)> {
        let [x, y] = self.edges;
        let seen = ExactRectangle::new(self.corner, x, y, from.p);
        let omega = seen.solid_angle();
        let cosines = Cosines::new(from, self.corners());
        (jitter.by(omega, 1e-5 * omega) > SMALL).then_some((seen, cosines))
    }

    fn hit(&self, o: DVec3, d: DVec3) -> Option<DVec2> {
        let [x, y] = self.edges;
        let n = x.cross(y);
        let t = (self.corner - o).dot(n) / d.dot(n);
        let p = o + d * t - self.corner;
        let uv = DVec2::new(p.dot(x) / x.length_squared(), p.dot(y) / y.length_squared());
        let is_inside = uv.cmpge(DVec2::ZERO).all() && uv.cmple(DVec2::ONE).all();
        (t > 0.0 && is_inside).then_some(uv)
    }
}
