use core::f32::consts::FRAC_1_PI;

use lights::glam::{Vec2, Vec3};
use lights::math::warp::cosine_hemisphere;

use super::bsdf_sample::BsdfSample;

/// Lambertian scattering: paint where it reflects, paper where it transmits too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lambert {
    /// Reflectance.
    pub reflectance: Vec3,
    /// Transmittance.
    pub transmittance: Vec3,
}

impl Lambert {
    /// An opaque surface that reflects on both sides; `reflectance` is in `[0, 1]`.
    #[must_use]
    pub(crate) const fn opaque(reflectance: Vec3) -> Self {
        Self {
            reflectance,
            transmittance: Vec3::ZERO,
        }
    }

    /// The scattering function times `|cos theta_i|`, in sr^-1, for unit vectors in the frame of
    /// the surface.
    #[inline]
    #[must_use]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        self.share(wo.z * wi.z > 0.0) * (wi.z.abs() * FRAC_1_PI)
    }

    /// The density of [`sample`](Self::sample), in sr^-1.
    #[inline]
    #[must_use]
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        let p = self.reflection_probability();
        let side = if wo.z * wi.z > 0.0 { p } else { 1.0 - p };
        side * cosine_hemisphere::pdf(wi.z.abs())
    }

    /// A direction in proportion to its cosine, on a side chosen in proportion to its share.
    #[inline]
    #[must_use]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        let p = self.reflection_probability();
        let reflects = u_lobe < p;
        let side = if reflects { p } else { 1.0 - p };
        let mut wi = cosine_hemisphere::sample(u);
        let pdf = side * cosine_hemisphere::pdf(wi.z);
        let weight = self.share(reflects) / side;
        if !(pdf > 0.0) || weight == Vec3::ZERO {
            return None;
        }
        if (wo.z > 0.0) != reflects {
            wi.z = -wi.z;
        }
        Some(BsdfSample {
            wi,
            weight,
            pdf: Some(pdf),
            eta: 1.0,
        })
    }

    fn share(&self, reflects: bool) -> Vec3 {
        if reflects {
            self.reflectance
        } else {
            self.transmittance
        }
    }

    fn reflection_probability(&self) -> f32 {
        let (r, t) = (
            self.reflectance.max_element(),
            self.transmittance.max_element(),
        );
        if t > 0.0 { r / (r + t) } else { 1.0 }
    }
}
