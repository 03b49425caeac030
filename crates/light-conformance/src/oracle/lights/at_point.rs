use super::super::warp::{SPHERE_PDF, uniform_sphere};
use super::exact_light::{Arriving, ExactBounds, ExactLight, Leaving, RayPdf, Receiver};
use super::fields::{number, transform};
use crate::oracle::Jitter;
use crate::{Case, Malformed};
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::PI;

/// What leaves a point: intensity by direction of the light's own space.
pub(super) trait Directional {
    fn intensity(&self, w: DVec3) -> DVec3;

    fn power(&self) -> DVec3;

    fn sample(&self, u1: DVec2, u2: DVec2, jitter: &mut Jitter) -> Option<DVec3>;

    /// Density per solid angle.
    fn pdf(&self, w: DVec3) -> f64;

    /// `phi`, `cos_theta_o` and `cos_theta_e` of the bounds, and whether the axis is that of the
    /// light's own space.
    fn bounds(&self) -> ([f64; 3], bool);
}

/// A light at a point.
pub(super) struct AtPoint<D> {
    to_scene: DMat3,
    position: DVec3,
    emission: D,
}

impl<D: Directional> AtPoint<D> {
    pub(super) fn new(case: &Case<'_>, emission: D) -> Result<Self, Malformed> {
        let (to_scene, position) = transform(&case.get("render_from_light")?)?;
        Ok(Self {
            to_scene,
            position,
            emission,
        })
    }

    fn own(&self, w: DVec3, jitter: &mut Jitter) -> DVec3 {
        jitter
            .vector(self.to_scene.transpose() * w, 1.0)
            .normalize()
    }
}

impl<D: Directional> ExactLight for AtPoint<D> {
    fn phi(&self) -> DVec3 {
        self.emission.power()
    }

    fn bounds(&self) -> Option<ExactBounds> {
        let ([phi, cos_theta_o, cos_theta_e], is_turned) = self.emission.bounds();
        Some(ExactBounds {
            min: self.position,
            max: self.position,
            w: if is_turned {
                self.to_scene.z_axis
            } else {
                DVec3::Z
            },
            phi,
            cos_theta_o,
            cos_theta_e,
            two_sided: false,
        })
    }

    fn sample_li(&self, at: &Receiver, _u: DVec2, jitter: &mut Jitter) -> Option<Arriving> {
        let magnitude = at.p.abs().max(self.position.abs()).max_element();
        let to_light = jitter.vector(self.position - at.p, magnitude);
        let wi = to_light.try_normalize()?;
        let l = self.emission.intensity(self.own(-wi, jitter)) / to_light.length_squared();
        (l != DVec3::ZERO).then_some(Arriving {
            wi,
            p: self.position,
            n: DVec3::ZERO,
            uv: DVec2::ZERO,
            pdf: 1.0,
            l,
        })
    }

    fn pdf_li(&self, _at: &Receiver, _wi: DVec3, _jitter: &mut Jitter) -> f64 {
        0.0
    }

    fn sample_le(&self, u1: DVec2, u2: DVec2, jitter: &mut Jitter) -> Option<Leaving> {
        let w = self.emission.sample(u1, u2, jitter)?;
        Some(Leaving {
            o: self.position,
            d: self.to_scene * w,
            n: DVec3::ZERO,
            uv: DVec2::ZERO,
        })
    }

    fn sent(&self, ray: &Leaving, jitter: &mut Jitter) -> (DVec3, RayPdf) {
        let w = self.own(ray.d, jitter);
        (self.emission.intensity(w), [1.0, self.emission.pdf(w)])
    }

    fn pdf_le(&self, ray: &Leaving, jitter: &mut Jitter) -> RayPdf {
        [0.0, self.sent(ray, jitter).1[1]]
    }

    fn radiance(&self, _ray: &Leaving, _jitter: &mut Jitter) -> DVec3 {
        DVec3::ZERO
    }
}

/// The same intensity in all directions.
pub(super) struct Isotropic(f64);

pub(super) fn isotropic(case: &Case<'_>) -> Result<AtPoint<Isotropic>, Malformed> {
    let light = AtPoint::new(case, Isotropic(number(case, "scale")?))?;
    // A rotation makes no difference, and the numbers stand for directions of the scene.
    Ok(AtPoint {
        to_scene: DMat3::IDENTITY,
        ..light
    })
}

impl Directional for Isotropic {
    fn intensity(&self, _w: DVec3) -> DVec3 {
        DVec3::splat(self.0)
    }

    fn power(&self) -> DVec3 {
        DVec3::splat(4.0 * PI * self.0)
    }

    fn sample(&self, u1: DVec2, _u2: DVec2, jitter: &mut Jitter) -> Option<DVec3> {
        Some(uniform_sphere(jitter.numbers(u1)))
    }

    fn pdf(&self, _w: DVec3) -> f64 {
        SPHERE_PDF
    }

    fn bounds(&self) -> ([f64; 3], bool) {
        ([4.0 * PI * self.0, -1.0, 0.0], false)
    }
}
