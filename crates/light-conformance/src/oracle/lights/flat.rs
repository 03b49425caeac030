use super::area::{At, Cosines, SMALL, Shape};
use super::exact_light::Receiver;
use super::triangle::Triangle;
use crate::oracle::{ExactTriangle, Jitter};
use glam::{DVec2, DVec3};

/// A flat convex quadrilateral as a receiver sees it: two triangles, chosen by solid angle times
/// mean cosine.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flat {
    triangles: [Triangle; 2],
    /// The chance of the first.
    first: f64,
}

impl Flat {
    /// None where it is small.
    pub(super) fn new(
        from: &Receiver,
        [p00, p10, p01, p11]: [DVec3; 4],
        jitter: &mut Jitter,
    ) -> Option<Self> {
        let corners = [[p00, p10, p11], [p00, p11, p01]];
        let angles = corners.map(|v| ExactTriangle::new(v, from.p).solid_angle());
        let sum = angles[0] + angles[1];
        if jitter.by(sum, 1e-5 * sum) <= SMALL {
            return None;
        }
        let cosine = |[a, b, c]: [DVec3; 3]| Cosines::new(from, [b, b, a, c]).mean();
        let [first, second] = [0, 1].map(|i| angles[i] * cosine(corners[i]));
        Some(Self {
            triangles: corners.map(Triangle),
            first: first / (first + second),
        })
    }

    pub(super) fn sample(
        &self,
        from: &Receiver,
        u: DVec2,
        jitter: &mut Jitter,
    ) -> Option<(At, f64)> {
        let u = jitter.numbers(u);
        let (i, start, chance) = if u.x < self.first {
            (0, 0.0, self.first)
        } else {
            (1, self.first, 1.0 - self.first)
        };
        let x = ((u.x - start) / chance).min(1.0);
        let (at, pdf) = self.triangles[i].toward(from, DVec2::new(x, u.y), jitter)?;
        Some((at, pdf * chance))
    }

    pub(super) fn pdf(&self, from: &Receiver, wi: DVec3, jitter: &mut Jitter) -> f64 {
        let [first, second] = &self.triangles;
        let pdf = first.pdf_toward(from, wi, jitter);
        if pdf > 0.0 {
            pdf * self.first
        } else {
            second.pdf_toward(from, wi, jitter) * (1.0 - self.first)
        }
    }
}
