use core::f32::consts::FRAC_1_PI;

use lights::glam::{Vec2, Vec3};
use lights::math::warp::cosine_hemisphere;

use super::bsdf_sample::BsdfSample;
use super::clear_coat::ClearCoat;
use super::fresnel;
use super::microfacets::Microfacets;

/// A diffuse base under a clear coat: lacquered wood, plastic. Opaque, the same on both sides.
///
/// Light passes the coat, is scattered by the base, and is partly reflected back inside by the
/// coat, any number of times. The roughness of the coat affects its reflection, not its
/// transmission.
///
/// # Source
/// `[Weidlich2007]`, section 3, for a Lambertian base, with the geometric series of reflections
/// inside of the coat. Mitsuba's `plastic` leaves the reflectance out of that series unless
/// `nonlinear` is set, and keeps middle tones brighter than light that goes to and fro leaves them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoatedDiffuse {
    /// Reflectance of the base, with all reflections inside of the coat, divided by pi.
    base: Vec3,
    coat: ClearCoat,
}

impl CoatedDiffuse {
    /// A base of the given reflectance in `[0, 1]` under a coat with index of refraction `eta`,
    /// relative to the outside, and roughness `facets`.
    #[must_use]
    pub fn new(reflectance: Vec3, eta: f32, facets: Microfacets) -> Self {
        let kept = fresnel::diffuse_internal_reflectance(eta);
        Self {
            base: reflectance / (1.0 - reflectance * kept) / (eta * eta),
            coat: ClearCoat { eta, facets },
        }
    }

    /// The coat's roughness, and about the share of the reflected light that the base reflects.
    #[inline]
    #[must_use]
    pub(super) fn gloss(&self) -> (f32, f32) {
        let coat = fresnel::dielectric(1.0, self.coat.eta);
        let base = self.base.element_sum() / 3.0;
        (self.coat.facets.alpha(), base / (base + coat))
    }

    /// The scattering function times `|cos theta_i|`.
    #[inline]
    #[must_use]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if !(wo.z * wi.z > 0.0) {
            return Vec3::ZERO;
        }
        let base =
            self.base * (self.coat.passes(wo) * self.coat.passes(wi) * wi.z.abs() * FRAC_1_PI);
        base + self.coat.eval(wo, wi)
    }

    /// The density of [`sample`](Self::sample), the Dirac of a smooth coat left out.
    #[inline]
    #[must_use]
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if !(wo.z * wi.z > 0.0) {
            return 0.0;
        }
        let p = self.coat_probability(wo);
        let coat = self.coat.pdf(wo, wi);
        p * coat + (1.0 - p) * cosine_hemisphere::pdf(wi.z.abs())
    }

    /// Samples a reflection by the coat or by the base, about in proportion to their brightness.
    #[inline]
    #[must_use]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        let p = self.coat_probability(wo);
        let side = if wo.z < 0.0 { -1.0 } else { 1.0 };
        let wi = if u_lobe < p {
            if self.coat.facets.is_smooth() {
                return Some(BsdfSample {
                    wi: Vec3::new(-wo.x, -wo.y, wo.z),
                    weight: Vec3::splat(self.coat.reflects(wo) / p),
                    pdf: None,
                    eta: 1.0,
                });
            }
            self.coat.sample(wo, side, u)
        } else {
            cosine_hemisphere::sample(u) * side
        };
        let pdf = self.pdf(wo, wi);
        BsdfSample::reflected(wi, || self.eval(wo, wi), pdf)
    }

    #[inline]
    fn coat_probability(&self, wo: Vec3) -> f32 {
        self.coat.probability(wo, self.base.max_element())
    }
}
