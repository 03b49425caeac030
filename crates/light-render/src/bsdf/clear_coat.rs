use lights::glam::{Vec2, Vec3};

use super::conductor::reflect;
use super::fresnel;
use super::microfacets::Microfacets;

/// The coat of a coated material: a dielectric boundary whose roughness affects its reflection, not
/// its transmission.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ClearCoat {
    /// Index of refraction relative to the outside.
    pub(super) eta: f32,
    pub(super) facets: Microfacets,
}

impl ClearCoat {
    /// The share of light along `w` that a smooth coat reflects.
    #[inline]
    pub(super) fn reflects(&self, w: Vec3) -> f32 {
        fresnel::dielectric(w.z.abs(), self.eta)
    }

    /// The share of light along `w` that passes.
    #[inline]
    pub(super) fn passes(&self, w: Vec3) -> f32 {
        1.0 - self.reflects(w)
    }

    /// The reflection of a rough coat, times `|cos theta_i|`; 0 of a smooth one, which is a Dirac.
    #[inline]
    pub(super) fn eval(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.facet(wo, wi).map_or(0.0, |wm| {
            let share = fresnel::dielectric(wo.dot(wm).abs(), self.eta);
            share * self.facets.d(wm) * self.facets.g(wo, wi) / (4.0 * wo.z.abs())
        })
    }

    /// The density of [`sample`](Self::sample); 0 of a smooth coat.
    #[inline]
    pub(super) fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.facet(wo, wi).map_or(0.0, |wm| {
            self.facets.visible_pdf(wo, wm) / (4.0 * wo.dot(wm).abs())
        })
    }

    /// A reflection by the facets of a rough coat; `side` is the sign of `wo.z`.
    #[inline]
    pub(super) fn sample(&self, wo: Vec3, side: f32, u: Vec2) -> Vec3 {
        reflect(wo, self.facets.sample_visible(wo * side, u) * side)
    }

    /// The probability with which the coat is chosen over a base that reflects the share `base`.
    #[inline]
    pub(super) fn probability(&self, wo: Vec3, base: f32) -> f32 {
        let coat = self.reflects(wo);
        let base = (1.0 - coat) * base;
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
