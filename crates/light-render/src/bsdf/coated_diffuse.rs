use core::f32::consts::FRAC_1_PI;

use lights::glam::{Vec2, Vec3};
use lights::math::warp::cosine_hemisphere;

use super::conductor::reflect;
use super::microfacets::Microfacets;
use super::{BsdfSample, fresnel};

/// A diffuse base under a clear coat: lacquered wood, plastic. Opaque, the same on both sides.
///
/// Light passes the coat, is scattered by the base, and is partly reflected back inside by the
/// coat, any number of times. The roughness of the coat affects its reflection, not its
/// transmission.
///
/// # Source
/// `[Weidlich2007]`, section 3, for a Lambertian base, with the geometric series of reflections
/// inside of the coat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoatedDiffuse {
    /// Reflectance of the base, with all reflections inside of the coat, divided by pi.
    base: Vec3,
    eta: f32,
    facets: Microfacets,
}

impl CoatedDiffuse {
    /// A base of the given reflectance in `[0, 1]` under a coat with index of refraction `eta`,
    /// relative to the outside, and roughness `facets`.
    #[must_use]
    pub fn new(reflectance: Vec3, eta: f32, facets: Microfacets) -> Self {
        let kept = fresnel::diffuse_internal_reflectance(eta);
        Self {
            base: reflectance / (1.0 - reflectance * kept) / (eta * eta),
            eta,
            facets,
        }
    }

    /// The coat's roughness, and about the share of the reflected light that the base reflects.
    #[inline]
    #[must_use]
    pub(super) fn gloss(&self) -> (f32, f32) {
        let coat = fresnel::dielectric(1.0, self.eta);
        let base = self.base.element_sum() / 3.0;
        (self.facets.alpha(), base / (base + coat))
    }

    /// The scattering function times `|cos theta_i|`.
    #[inline]
    #[must_use]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if !(wo.z * wi.z > 0.0) {
            return Vec3::ZERO;
        }
        let base = self.base * (self.passes(wo) * self.passes(wi) * wi.z.abs() * FRAC_1_PI);
        let Some(wm) = self.facet(wo, wi) else {
            return base;
        };
        let share = fresnel::dielectric(wo.dot(wm).abs(), self.eta);
        base + share * self.facets.d(wm) * self.facets.g(wo, wi) / (4.0 * wo.z.abs())
    }

    /// The density of [`sample`](Self::sample), the Dirac of a smooth coat left out.
    #[inline]
    #[must_use]
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if !(wo.z * wi.z > 0.0) {
            return 0.0;
        }
        let p = self.coat_probability(wo);
        let coat = self.facet(wo, wi).map_or(0.0, |wm| {
            self.facets.visible_pdf(wo, wm) / (4.0 * wo.dot(wm).abs())
        });
        p * coat + (1.0 - p) * cosine_hemisphere::pdf(wi.z.abs())
    }

    /// Samples a reflection by the coat or by the base, about in proportion to their brightness.
    #[inline]
    #[must_use]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        let p = self.coat_probability(wo);
        let side = if wo.z < 0.0 { -1.0 } else { 1.0 };
        let wi = if u_lobe < p {
            if self.facets.is_smooth() {
                return Some(BsdfSample {
                    wi: Vec3::new(-wo.x, -wo.y, wo.z),
                    weight: Vec3::splat(fresnel::dielectric(wo.z.abs(), self.eta) / p),
                    pdf: None,
                    eta: 1.0,
                });
            }
            reflect(wo, self.facets.sample_visible(wo * side, u) * side)
        } else {
            cosine_hemisphere::sample(u) * side
        };
        let pdf = self.pdf(wo, wi);
        (pdf > 0.0).then(|| BsdfSample {
            wi,
            weight: self.eval(wo, wi) / pdf,
            pdf: Some(pdf),
            eta: 1.0,
        })
    }

    #[inline]
    fn passes(&self, w: Vec3) -> f32 {
        1.0 - fresnel::dielectric(w.z.abs(), self.eta)
    }

    #[inline]
    fn coat_probability(&self, wo: Vec3) -> f32 {
        let coat = fresnel::dielectric(wo.z.abs(), self.eta);
        let base = (1.0 - coat) * self.base.max_element();
        // Both have a positive probability, so that no direction is lost.
        (coat / (coat + base)).clamp(0.1, 0.9)
    }

    #[inline]
    fn facet(&self, wo: Vec3, wi: Vec3) -> Option<Vec3> {
        if self.facets.is_smooth() {
            return None;
        }
        let wm = (wo + wi).try_normalize()?;
        Some(if wm.z < 0.0 { -wm } else { wm })
    }
}
