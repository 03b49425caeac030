use super::super::warp::uniform_triangle;
use super::area::{At, Cosines, SMALL, Shape};
use super::by_solid_angle::{self, BySolidAngle};
use super::exact_light::Receiver;
use super::fields::point;
use crate::oracle::{ExactTriangle, Jitter};
use crate::{Case, Malformed};
use glam::{DVec2, DVec3};

/// Half of the distance between two floats near 1: what one operation may round.
const HALF_ULP: f64 = 0.5 * f32::EPSILON as f64;

/// How far single precision may move the product `d . (v x e)` that says on which side of an edge
/// `e` a ray `d` passes, in roundings of `|v| |e|`: 1 of `v`, the corner seen from the origin; 2 of
/// the ends of `e`, as `v` is no farther from such a ray than `|e|`; `1 + sqrt(2)` of the cross
/// product; 3 of the scalar product.
const SIDE: f64 = 7.0 + std::f64::consts::SQRT_2;

/// How far rounding turns a direction toward a point: its difference and its division by the
/// length.
const TURN: f64 = 2.0;

/// How far a point of the triangle is rounded, a sum of three products, over its coordinates.
const PLACE: f64 = 3.0;

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

    /// So that directions toward its own points hit, a triangle may be enlarged by what rounding
    /// moves those points, directions and sides; and sides are rounded when they are compared.
    fn hit_edge(&self, o: DVec3, d: DVec3, jitter: &mut Jitter) -> Option<DVec3> {
        let (v, d) = (self.0.map(|v| v - o), d.normalize());
        let farthest = |v: [DVec3; 3]| v.map(DVec3::length).into_iter().fold(0.0, f64::max);
        let slack = (2.0 * SIDE + TURN) * farthest(v) + PLACE * farthest(self.0);
        let slack = jitter.by(0.0, HALF_ULP * slack).abs();
        let edges = [[0, 1], [1, 2], [2, 0]];
        let sides = edges.map(|[i, j]| d.dot(v[i].cross(v[j])) / v[i].distance(v[j]));
        let is_passed = sides.iter().all(|&s| s > -slack) || sides.iter().all(|&s| s < slack);
        let nearest = edges.map(|[i, j]| {
            let line = v[j] - v[i];
            let across = line.reject_from_normalized(d);
            let s = (-v[i].dot(across) / across.length_squared()).clamp(0.0, 1.0);
            let mut weights = DVec3::ZERO;
            (weights[i], weights[j]) = (1.0 - s, s);
            let p = v[i] + line * s;
            (weights, p, p.reject_from_normalized(d).length())
        });
        let nearest = nearest.into_iter().min_by(|a, b| a.2.total_cmp(&b.2));
        let nearest = nearest.filter(|(_, p, _)| is_passed && p.dot(d) > 0.0);
        nearest.map(|(weights, ..)| weights)
    }
}

#[cfg(test)]
mod tests {
    use super::super::area::per_solid_angle;
    use super::*;
    use crate::Tolerance;
    use crate::oracle::{Conditioning, Ours, confirm};

    /// A ray that passes a small triangle at a distance of six roundings of its length.
    #[test]
    fn the_density_of_an_edge_is_an_answer_for_a_ray_that_passes_it_within_rounding() {
        let triangle = Triangle([
            DVec3::new(3.92103553, -3.01745653, 0.502956808),
            DVec3::new(3.94441581, -3.03400469, 0.536599755),
            DVec3::new(3.89083719, -3.01969361, 0.474181503),
        ]);
        let from = Receiver {
            p: DVec3::new(-0.451996982, 2.69381905, -4.77830982),
            ns: DVec3::new(-0.520806789, -0.606330931, -0.600935161),
            is_incomplete: false,
        };
        let wi = DVec3::new(0.489289761, -0.640736759, 0.591651857);
        let is_confirmed = |pdf: f64, wi: DVec3| {
            let ours = Ours {
                answer: DVec3::new(pdf, 0.0, 0.0),
                tolerance: Tolerance::new(1e-4, 1e-6),
                conditioning: Conditioning::Well,
            };
            let truth = |jitter: &mut Jitter| {
                let pdf = triangle.pdf_toward(&from, wi, jitter);
                Some(vec![DVec3::new(pdf, 0.0, 0.0)])
            };
            confirm(&[ours], truth).is_ok()
        };
        let place = triangle.hit_edge(from.p, wi, &mut Jitter::new(1));
        let at = triangle.at(place.expect("near an edge"));
        let (pdf, jitter) = (1.0 / triangle.area(), &mut Jitter::default());
        let edge = per_solid_angle(pdf, &from, &at, jitter).expect("a density");
        assert!((edge / 977_386.0 - 1.0).abs() < 1e-4, "{edge}");
        assert!(is_confirmed(edge, wi), "{edge}");
        for wrong in [0.5, 0.9, 1.1, 2.0] {
            assert!(!is_confirmed(wrong * edge, wi), "{wrong}");
        }
        // Ten times as far from the edge, which is seen at a slant.
        let off = wi.normalize() - (at.p - from.p).normalize();
        let apart = wi + 9.0 * off;
        assert!(is_confirmed(0.0, apart), "a miss");
        assert!(!is_confirmed(edge, apart), "too far");
    }
}
