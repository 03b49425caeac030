use super::super::warp::{around, bilinear, bilinear_pdf, cosine_hemisphere};
use super::exact_light::{Arriving, ExactBounds, ExactLight, Leaving, RayPdf, Receiver};
use super::fields::number;
use crate::oracle::Jitter;
use crate::{Case, Malformed};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// A point of a surface with its front normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct At {
    pub(super) p: DVec3,
    pub(super) n: DVec3,
    pub(super) uv: DVec2,
}

/// A surface.
pub(super) trait Shape {
    fn area(&self) -> f64;

    /// The smallest box.
    fn bounds(&self) -> [DVec3; 2];

    /// Axis and cosine of the cone of normals.
    fn normals(&self) -> (DVec3, f64);

    /// A point for light that leaves.
    fn sample(&self, u: DVec2, jitter: &mut Jitter) -> Option<At>;

    /// Its density per area.
    fn pdf(&self, _uv: DVec2) -> f64 {
        1.0 / self.area()
    }

    /// A point as seen from a receiver, with its density per solid angle.
    fn toward(&self, from: &Receiver, u: DVec2, jitter: &mut Jitter) -> Option<(At, f64)>;

    /// The density of a direction, 0 where it misses.
    fn pdf_toward(&self, from: &Receiver, wi: DVec3, jitter: &mut Jitter) -> f64;
}

/// The same radiance from all of a surface.
pub(super) struct Area<S> {
    shape: S,
    scale: f64,
    /// 0 for both sides, else the side that shines.
    side: f64,
}

/// The solid angle below which shapes with straight edges are sampled by area.
pub(super) const SMALL: f64 = 3e-4;

impl<S> Area<S> {
    pub(super) fn new(case: &Case<'_>, shape: S) -> Result<Self, Malformed> {
        let is_reversed = case
            .find("reverse_orientation")
            .is_some_and(|flag| flag.flag().unwrap_or(false));
        Ok(Self {
            shape,
            scale: number(case, "scale")?,
            side: match (case.get("two_sided")?.flag()?, is_reversed) {
                (true, _) => 0.0,
                (false, true) => -1.0,
                (false, false) => 1.0,
            },
        })
    }

    fn l(&self, n: DVec3, w: DVec3) -> DVec3 {
        if self.side == 0.0 || self.side * n.dot(w) > 0.0 {
            DVec3::splat(self.scale)
        } else {
            DVec3::ZERO
        }
    }
}

impl<S: Shape> ExactLight for Area<S> {
    fn phi(&self) -> DVec3 {
        let sides = if self.side == 0.0 { 2.0 } else { 1.0 };
        DVec3::splat(sides * PI * self.scale * self.shape.area())
    }

    fn bounds(&self) -> Option<ExactBounds> {
        let [min, max] = self.shape.bounds();
        let (w, cos_theta_o) = self.shape.normals();
        Some(ExactBounds {
            min,
            max,
            w: if self.side < 0.0 && cos_theta_o > -1.0 {
                -w
            } else {
                w
            },
            phi: PI * self.scale * self.shape.area(),
            cos_theta_o,
            cos_theta_e: 0.0,
            two_sided: self.side == 0.0,
        })
    }

    fn sample_li(&self, from: &Receiver, u: DVec2, jitter: &mut Jitter) -> Option<Arriving> {
        let (At { p, n, uv }, pdf) = self.shape.toward(from, u, jitter)?;
        let wi = jitter.vector(p - from.p, p.abs().max(from.p.abs()).max_element());
        let wi = wi.try_normalize()?;
        let l = self.l(n, -wi);
        (l != DVec3::ZERO).then_some(Arriving {
            wi,
            p,
            n,
            uv,
            pdf,
            l,
        })
    }

    fn pdf_li(&self, from: &Receiver, wi: DVec3, jitter: &mut Jitter) -> f64 {
        self.shape.pdf_toward(from, wi, jitter)
    }

    fn sample_le(&self, u1: DVec2, u2: DVec2, jitter: &mut Jitter) -> Option<Leaving> {
        let At { p, n, uv } = self.shape.sample(u1, jitter)?;
        let mut u = jitter.numbers(u2);
        let d = if self.side == 0.0 {
            // The first number picks the side and is used again. The difference and the double of
            // it are exact, so numbers that are not moved are as right, while others are: one half
            // then stands for the rim itself.
            u = jitter.either(u2, u);
            let side = if u.x < 0.5 { 1.0 } else { -1.0 };
            u.x = 2.0 * if u.x < 0.5 { u.x } else { u.x - 0.5 };
            let w = cosine_hemisphere(u.min(DVec2::splat(1.0)));
            around(n, w.truncate().extend(side * w.z), jitter)
        } else {
            around(self.side * n, cosine_hemisphere(u), jitter)
        };
        // The cosine is a sum of products of at most 1, which rounding may cancel to 0 as it moves
        // any such sum. Rays without a cosine have no density, so there may be no sample then.
        let is_lost = n.dot(d).abs() < jitter.at_scale(0.0, 1.0).abs();
        (!is_lost).then_some(Leaving { o: p, d, n, uv })
    }

    fn sent(&self, ray: &Leaving, jitter: &mut Jitter) -> (DVec3, RayPdf) {
        let cos = jitter.at_scale(ray.n.dot(ray.d), 1.0);
        let l = self.l(ray.n, cos.signum() * ray.n);
        let sides = if self.side == 0.0 { 2.0 } else { 1.0 };
        let dir = if l == DVec3::ZERO {
            0.0
        } else {
            cos.abs() / (PI * sides)
        };
        (l, [self.shape.pdf(ray.uv), dir])
    }

    fn radiance(&self, ray: &Leaving, jitter: &mut Jitter) -> DVec3 {
        let cos = jitter.at_scale(ray.n.dot(ray.d), 1.0);
        self.l(ray.n, cos * ray.n)
    }
}

/// A density per area as one per solid angle; none where the surface is seen from its edge. The
/// place is rounded before the receiver is subtracted, which turns a direction along the surface,
/// and the normal is a rounded unit vector.
pub(super) fn per_solid_angle(
    pdf_area: f64,
    from: &Receiver,
    at: &At,
    jitter: &mut Jitter,
) -> Option<f64> {
    let magnitude = at.p.abs().max(from.p.abs()).max_element();
    let to_light = jitter.vector(at.p - from.p, magnitude);
    let cos = jitter.at_scale(at.n.dot(to_light.normalize()), 1.0);
    let pdf = pdf_area * to_light.length_squared() / cos.abs();
    (pdf > 0.0 && pdf.is_finite()).then_some(pdf)
}

/// The map of random numbers toward large cosines at a receiver (Hart et al. 2020): bilinear
/// between the corners of the square, which stand for directions, and none below 1/100.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cosines(Option<[f64; 4]>);

impl Cosines {
    pub(super) fn new(from: &Receiver, corners: [DVec3; 4]) -> Self {
        let cosine = |p: DVec3| (p - from.p).normalize().dot(from.ns).abs().max(0.01);
        Self((from.ns != DVec3::ZERO).then(|| corners.map(cosine)))
    }

    pub(super) fn mean(&self) -> f64 {
        self.0.map_or(1.0, |w| 0.25 * w.iter().sum::<f64>())
    }

    /// Where a random number goes, and the density there.
    pub(super) fn sample(&self, u: DVec2) -> (DVec2, f64) {
        self.0.map_or((u, 1.0), |w| {
            let p = bilinear(u, w);
            (p, bilinear_pdf(p, w))
        })
    }

    pub(super) fn pdf(&self, p: DVec2) -> f64 {
        self.0.map_or(1.0, |w| bilinear_pdf(p, w))
    }
}
