use super::super::warp::{bilinear, bilinear_pdf};
use super::area::{Area, At, Shape, per_solid_angle};
use super::exact_light::{ExactLight, Receiver};
use super::fields::point;
use super::flat::Flat;
use super::rectangle::Rectangle;
use crate::oracle::Jitter;
use crate::{Case, Malformed};
use glam::{DVec2, DVec3};

/// A bilinear patch that is no rectangle. Points are chosen by area, nearly: bilinear between the
/// corners.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    corners: [DVec3; 4],
    is_flat: bool,
}

const CORNERS: [DVec2; 4] = [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE];

/// The light of a line with a patch or a rectangle.
pub(super) fn light(case: &Case<'_>) -> Result<Box<dyn ExactLight>, Malformed> {
    let corner = |name| point(&case.get(name)?);
    let corners = [
        corner("p00")?,
        corner("p10")?,
        corner("p01")?,
        corner("p11")?,
    ];
    Ok(match Rectangle::new(corners) {
        Some(rectangle) => Box::new(Area::new(case, rectangle)?),
        None => Box::new(Area::new(case, Patch::new(corners))?),
    })
}

impl Patch {
    fn new(corners: [DVec3; 4]) -> Self {
        let mut patch = Self {
            corners,
            is_flat: false,
        };
        let normals = CORNERS.map(|uv| patch.scaled_normal(uv).normalize());
        patch.is_flat = normals.iter().all(|n| n.distance(normals[0]) <= 1e-6);
        patch
    }

    fn derivatives(&self) -> [DVec3; 3] {
        let [p00, p10, p01, p11] = self.corners;
        [p10 - p00, p01 - p00, (p11 - p01) - (p10 - p00)]
    }

    fn point(&self, uv: DVec2) -> DVec3 {
        let [p00, p10, p01, p11] = self.corners;
        p00.lerp(p10, uv.x).lerp(p01.lerp(p11, uv.x), uv.y)
    }

    fn scaled_normal(&self, uv: DVec2) -> DVec3 {
        let [du, dv, duv] = self.derivatives();
        (du + duv * uv.y).cross(dv + duv * uv.x)
    }

    fn at(&self, uv: DVec2) -> At {
        At {
            p: self.point(uv),
            n: self.scaled_normal(uv).normalize(),
            uv,
        }
    }

    fn weights(&self) -> [f64; 4] {
        CORNERS.map(|uv| self.scaled_normal(uv).length())
    }

    /// Parameters and distance of all points that a ray meets: the patch in the plane across the
    /// ray is a quadrilateral, whose inverse is a quadratic equation.
    fn crossings(&self, o: DVec3, d: DVec3) -> impl Iterator<Item = (DVec2, f64)> {
        let [du, dv, duv] = self.derivatives();
        let from = self.corners[0] - o;
        let volume = |a: DVec3, b: DVec3| d.dot(a.cross(b));
        let a = volume(du, duv);
        let b = volume(from, duv) + volume(du, dv);
        let c = volume(from, dv);
        let root = (b * b - 4.0 * a * c).sqrt();
        let q = -0.5 * (b + root.copysign(b));
        let this = *self;
        [q / a, c / q].into_iter().filter_map(move |u| {
            let (start, line) = (from + du * u, dv + duv * u);
            let across = line - d * line.dot(d);
            let uv = DVec2::new(u, -start.dot(across) / across.length_squared());
            let t = (this.point(uv) - o).dot(d);
            let is_inside = uv.cmpge(DVec2::ZERO).all() && uv.cmple(DVec2::ONE).all();
            (is_inside && t > 0.0).then_some((uv, t))
        })
    }

    fn hit(&self, o: DVec3, d: DVec3) -> Option<(DVec2, f64)> {
        let crossings = self.crossings(o, d);
        crossings.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The edge that a ray passes at a distance that the inputs round off; none where they are not
    /// moved.
    fn hit_edge(&self, o: DVec3, d: DVec3, jitter: &mut Jitter) -> Option<(DVec2, f64)> {
        let [p00, _, _, p11] = self.corners;
        let magnitude = o.abs().max(p00.abs()).max(p11.abs()).max_element();
        let slack = jitter.at_scale(0.0, magnitude + o.distance(p00));
        let edges = [[0, 1], [2, 3], [0, 2], [1, 3]].map(|edge| edge.map(|i: usize| CORNERS[i]));
        let passes = edges.into_iter().filter_map(|[a, b]| {
            let (start, line) = (self.point(a) - o, self.point(b) - self.point(a));
            let across = line - d * line.dot(d);
            let s = (-start.dot(across) / across.length_squared()).clamp(0.0, 1.0);
            let to = start + line * s;
            let t = to.dot(d);
            (t > 0.0 && to.distance(d * t) < slack).then(|| (a.lerp(b, s), t))
        });
        passes.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    fn seen(&self, from: &Receiver, jitter: &mut Jitter) -> Option<Flat> {
        self.is_flat
            .then(|| Flat::new(from, self.corners, jitter))
            .flatten()
    }
}

impl Shape for Patch {
    /// Gauss's rule with two points in each of 64 by 64 pieces.
    fn area(&self) -> f64 {
        const N: u32 = 64;
        let place = |i: u32| {
            let side = if i % 2 == 0 { -1.0 } else { 1.0 };
            (f64::from(i / 2) + 0.5 + side * 0.5 / 3f64.sqrt()) / f64::from(N)
        };
        let mut sum = 0.0;
        for x in 0..2 * N {
            for y in 0..2 * N {
                sum += self.scaled_normal(DVec2::new(place(x), place(y))).length();
            }
        }
        sum / f64::from(4 * N * N)
    }

    fn bounds(&self) -> [DVec3; 2] {
        let [a, b, c, d] = self.corners;
        [a.min(b).min(c).min(d), a.max(b).max(c).max(d)]
    }

    /// Normals are means of those at the corners, so a cone that is convex holds them all.
    fn normals(&self) -> (DVec3, f64) {
        let normals = CORNERS.map(|uv| self.scaled_normal(uv).normalize());
        let axis = normals.iter().sum::<DVec3>().normalize();
        let cos = normals.iter().map(|n| n.dot(axis)).fold(1.0, f64::min);
        if cos > 0.0 {
            (axis, cos)
        } else {
            (DVec3::Z, -1.0)
        }
    }

    fn sample(&self, u: DVec2, jitter: &mut Jitter) -> Option<At> {
        Some(self.at(bilinear(jitter.numbers(u), self.weights())))
    }

    fn pdf(&self, uv: DVec2) -> f64 {
        bilinear_pdf(uv, self.weights()) / self.scaled_normal(uv).length()
    }

    fn toward(&self, from: &Receiver, u: DVec2, jitter: &mut Jitter) -> Option<(At, f64)> {
        if let Some(flat) = self.seen(from, jitter) {
            let (at, pdf) = flat.sample(from, u, jitter)?;
            let wi = (at.p - from.p).normalize();
            let (uv, _) = self.hit(from.p, jitter.vector(wi, 1.0))?;
            return Some((At { uv, ..at }, pdf));
        }
        let at = self.sample(u, jitter)?;
        let pdf = per_solid_angle(self.pdf(at.uv), from, &at, jitter)?;
        let dist = at.p.distance(from.p);
        // Another part of the patch may be in the way.
        let wi = jitter.vector((at.p - from.p) / dist, 1.0);
        let nearest = self.hit(from.p, wi);
        let is_hidden =
            !self.is_flat && nearest.is_some_and(|(_, t)| t < jitter.by(0.9988, 7e-4) * dist);
        (!is_hidden).then_some((at, pdf))
    }

    fn pdf_toward(&self, from: &Receiver, wi: DVec3, jitter: &mut Jitter) -> f64 {
        let wi = jitter.vector(wi, 1.0);
        if let Some(flat) = self.seen(from, jitter) {
            return flat.pdf(from, wi, jitter);
        }
        let hit = self.hit(from.p, wi);
        let edge = self.hit_edge(from.p, wi, jitter);
        // A ray that comes in low may hit far inside of an edge that it passes within rounding.
        let Some((uv, _)) = jitter.either(hit.or(edge), edge.or(hit)) else {
            return 0.0;
        };
        per_solid_angle(self.pdf(uv), from, &self.at(uv), jitter).unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Tolerance;
    use crate::oracle::{Conditioning, Ours, confirm};

    /// A ray that comes in at a cosine of 4e-4 and passes an edge within rounding, and hits within
    /// it if it is moved by a rounding.
    #[test]
    fn the_density_of_an_edge_is_an_answer_for_a_ray_that_passes_it() {
        let patch = Patch::new([
            DVec3::new(0.688975811, 0.967900097, 0.977546394),
            DVec3::new(0.688975811, 1.13450205, 1.15488505),
            DVec3::new(-0.647135973, 1.11064816, 0.838239849),
            DVec3::new(-0.512135804, 1.35980141, 1.09613264),
        ]);
        let from = Receiver {
            p: DVec3::new(3.32811737, 1.64074194, 2.15287018),
            ns: DVec3::new(0.255481452, 0.966069341, -0.0379376635),
            is_incomplete: false,
        };
        let wi = DVec3::new(-0.935041249, -0.141503543, -0.325076282);
        let exact = {
            let at = patch.at(DVec2::new(0.0, 0.792729735));
            let jitter = &mut Jitter::default();
            per_solid_angle(patch.pdf(at.uv), &from, &at, jitter).expect("a density")
        };
        assert!((exact - 113_271.6).abs() < 20.0, "{exact}");
        let is_confirmed = |pdf: f64| {
            let ours = Ours {
                answer: DVec3::new(pdf, 0.0, 0.0),
                tolerance: Tolerance::new(1e-4, 1e-6),
                conditioning: Conditioning::Well,
            };
            let truth = |jitter: &mut Jitter| {
                let pdf = patch.pdf_toward(&from, wi, jitter);
                Some(vec![DVec3::new(pdf, 0.0, 0.0)])
            };
            confirm(&[ours], truth).is_ok()
        };
        assert!(is_confirmed(exact), "{exact}");
        for wrong in [0.5, 0.6, 1.05, 2.0] {
            assert!(!is_confirmed(wrong * exact), "{wrong}");
        }
    }
}
