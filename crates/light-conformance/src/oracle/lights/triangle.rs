use super::super::warp::uniform_triangle;
use super::area::{At, Cosines, SMALL, Shape};
use super::by_solid_angle::{self, BySolidAngle};
use super::{Receiver, point};
use crate::oracle::{ExactTriangle, Jitter};
use crate::{Case, Malformed};
use glam::{DVec2, DVec3};

/// A triangle, sampled by solid angle, or by area where it is small.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle(pub(super) [DVec3; 3]);

impl Triangle {
    pub(super) fn read(case: &Case<'_>) -> Result<Self, Malformed> {
        let v = case.get("v")?;
        Ok(Self([
            point(&v.at(0)?)?,
            point(&v.at(1)?)?,
            point(&v.at(2)?)?,
        ]))
    }

    fn scaled_normal(&self) -> DVec3 {
        let [a, b, c] = self.0;
        (b - a).cross(c - a)
    }
}

impl Shape for Triangle {
    fn area(&self) -> f64 {
        0.5 * self.scaled_normal().length()
    }

    fn bounds(&self) -> [DVec3; 2] {
        let [a, b, c] = self.0;
        [a.min(b).min(c), a.max(b).max(c)]
    }

    fn normals(&self) -> (DVec3, f64) {
        (self.scaled_normal().normalize(), 1.0)
    }

    fn sample(&self, u: DVec2, jitter: &mut Jitter) -> Option<At> {
        Some(self.at(uniform_triangle(jitter.numbers(u))))
    }

    fn toward(&self, from: &Receiver, u: DVec2, jitter: &mut Jitter) -> Option<(At, f64)> {
        by_solid_angle::toward(self, from, u, jitter)
    }

    fn pdf_toward(&self, from: &Receiver, wi: DVec3, jitter: &mut Jitter) -> f64 {
        by_solid_angle::pdf_toward(self, from, wi, jitter)
    }
}

impl BySolidAngle for Triangle {
    type Seen = ExactTriangle;

    fn at(&self, b: DVec3) -> At {
        let [p0, p1, p2] = self.0;
        At {
            p: p0 * b.x + p1 * b.y + p2 * b.z,
            n: self.scaled_normal().normalize(),
            uv: DVec2::X * b.y + DVec2::ONE * b.z,
        }
    }

    fn seen(&self, from: &Receiver, jitter: &mut Jitter) -> Option<(ExactTriangle, Cosines)> {
        let seen = ExactTriangle::new(self.0, from.p);
        let omega = seen.solid_angle();
        let [a, b, c] = self.0;
        // The second corner is a whole side of the square.
        let cosines = Cosines::new(from, [b, b, a, c]);
        (jitter.by(omega, 1e-5 * omega) > SMALL).then_some((seen, cosines))
    }

    fn hit(&self, o: DVec3, d: DVec3) -> Option<DVec3> {
        let [a, b, c] = self.0.map(|v| v - o);
        let sides = DVec3::new(d.dot(b.cross(c)), d.dot(c.cross(a)), d.dot(a.cross(b)));
        let is_hit = sides.cmpge(DVec3::ZERO).all() || sides.cmple(DVec3::ZERO).all();
        let weights = sides / sides.element_sum();
        let p = a * weights.x + b * weights.y + c * weights.z;
        (is_hit && p.dot(d) > 0.0).then_some(weights)
    }
}
