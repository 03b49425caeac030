use lights::glam::{Vec2, Vec3};

use super::bsdf_sample::BsdfSample;
use super::fresnel;
use super::microfacets::Microfacets;

/// A metal: microfacets that reflect with the Fresnel factor of a conductor.
///
/// # Source
/// `[PBRT4]`, section 9.6.5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    /// Real part of the index of refraction, per channel.
    pub eta: Vec3,
    /// Imaginary part (absorption), per channel.
    pub k: Vec3,
    /// The microfacet distribution.
    pub facets: Microfacets,
}

impl Conductor {
    /// The scattering function times `|cos theta_i|`.
    #[inline]
    #[must_use]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        let Some(wm) = self.facet(wo, wi) else {
            return Vec3::ZERO;
        };
        let fresnel = fresnel::conductor(wo.dot(wm).abs(), self.eta, self.k);
        fresnel * (self.facets.d(wm) * self.facets.g(wo, wi) / (4.0 * wo.z.abs()))
    }

    /// The density of [`sample`](Self::sample).
    #[inline]
    #[must_use]
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.facet(wo, wi).map_or(0.0, |wm| {
            self.facets.visible_pdf(wo, wm) / (4.0 * wo.dot(wm).abs())
        })
    }

    /// Samples a reflection by one of the facets visible from `wo`.
    #[inline]
    #[must_use]
    pub fn sample(&self, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
        if self.facets.is_smooth() {
            return Some(BsdfSample {
                wi: Vec3::new(-wo.x, -wo.y, wo.z),
                weight: fresnel::conductor(wo.z.abs(), self.eta, self.k),
                pdf: None,
                eta: 1.0,
            });
        }
        let side = if wo.z < 0.0 { -1.0 } else { 1.0 };
        let wm = self.facets.sample_visible(wo * side, u) * side;
        let wi = reflect(wo, wm);
        let pdf = self.pdf(wo, wi);
        if !(wo.z * wi.z > 0.0 && pdf > 0.0) {
            return None;
        }
        let fresnel = fresnel::conductor(wo.dot(wm).abs(), self.eta, self.k);
        Some(BsdfSample {
            wi,
            weight: fresnel * (self.facets.g(wo, wi) / self.facets.g1(wo)),
            pdf: Some(pdf),
            eta: 1.0,
        })
    }

    /// The normal of the facets that reflect `wi` to `wo`, on the upper side.
    #[inline]
    fn facet(&self, wo: Vec3, wi: Vec3) -> Option<Vec3> {
        if !(wo.z * wi.z > 0.0) || self.facets.is_smooth() {
            return None;
        }
        (wo + wi).try_normalize()
    }
}

/// The mirror image of `wo` about the unit vector `n`.
#[inline]
pub(super) fn reflect(wo: Vec3, n: Vec3) -> Vec3 {
    -wo + n * (2.0 * wo.dot(n))
}
