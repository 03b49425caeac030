use lights::glam::{Vec2, Vec3};

use super::bsdf_sample::BsdfSample;
use super::conductor::reflect;
use super::fresnel;
use super::microfacets::Microfacets;

/// Glass or water: microfacets that reflect and refract.
///
/// Radiance is scaled by the squared ratio of the indices when it crosses the boundary, as it is
/// squeezed into a smaller solid angle.
///
/// # Source
/// `[PBRT4]`, section 9.7 (equations 9.36 and 9.40).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric {
    /// Index of refraction behind the surface over that in front.
    pub eta: f32,
    /// The microfacet distribution.
    pub facets: Microfacets,
}

/// A pair of directions and the facet that links them.
struct Link {
    wm: Vec3,
    reflects: bool,
    /// Index on the side of `wi` over that on the side of `wo`; 1 for reflection.
    eta: f32,
}

impl Dielectric {
    /// Whether all scattering is Dirac.
    #[inline]
    #[must_use]
    pub fn is_dirac(&self) -> bool {
        self.eta == 1.0 || self.facets.is_smooth()
    }

    /// The scattering function times `|cos theta_i|`.
    #[inline]
    #[must_use]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        let Some(link) = self.link(wo, wi) else {
            return Vec3::ZERO;
        };
        let Link { wm, reflects, eta } = link;
        let share = fresnel::dielectric(wo.dot(wm), self.eta);
        let common = self.facets.d(wm) * self.facets.g(wo, wi);
        let f = if reflects {
            share * common / (4.0 * wo.z.abs())
        } else {
            let denominator = wi.dot(wm) + wo.dot(wm) / eta;
            let bend = (wi.dot(wm) * wo.dot(wm)).abs() / (wo.z.abs() * denominator * denominator);
            (1.0 - share) * common * bend / (eta * eta)
        };
        Vec3::splat(f)
    }

    /// The density of [`sample`](Self::sample).
    #[inline]
    #[must_use]
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.link(wo, wi).map_or(0.0, |link| {
            let share = fresnel::dielectric(wo.dot(link.wm), self.eta);
            self.link_pdf(wo, wi, &link, share)
        })
    }

    /// Samples a reflection or a refraction, in proportion to the Fresnel factor.
    #[inline]
    #[must_use]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        let is_dirac = self.is_dirac();
        let wm = if is_dirac {
            Vec3::Z
        } else {
            // Normals of facets point to the front, whichever side they are seen from.
            let side = if wo.z < 0.0 { -1.0 } else { 1.0 };
            self.facets.sample_visible(wo * side, u)
        };
        let share = fresnel::dielectric(wo.dot(wm), self.eta);
        let reflects = u_lobe < share;
        let (wi, eta) = if reflects {
            (reflect(wo, wm), 1.0)
        } else {
            fresnel::refract(wo, wm, self.eta)?
        };
        if (wo.z * wi.z > 0.0) != reflects || wi.z == 0.0 {
            return None;
        }
        let squeeze = 1.0 / (eta * eta);
        if is_dirac {
            return Some(BsdfSample {
                wi,
                weight: Vec3::splat(squeeze),
                pdf: None,
                eta,
            });
        }
        let link = Link { wm, reflects, eta };
        let pdf = self.link_pdf(wo, wi, &link, share);
        let weight = squeeze * self.facets.g(wo, wi) / self.facets.g1(wo);
        (pdf > 0.0).then_some(BsdfSample {
            wi,
            weight: Vec3::splat(weight),
            pdf: Some(pdf),
            eta,
        })
    }

    #[inline]
    fn link_pdf(&self, wo: Vec3, wi: Vec3, link: &Link, share: f32) -> f32 {
        let &Link { wm, reflects, eta } = link;
        let visible = self.facets.visible_pdf(wo, wm);
        if reflects {
            share * visible / (4.0 * wo.dot(wm).abs())
        } else {
            let denominator = wi.dot(wm) + wo.dot(wm) / eta;
            (1.0 - share) * visible * wi.dot(wm).abs() / (denominator * denominator)
        }
    }

    /// The facet that sends light from `wi` to `wo`; `None` where there is none that both sides
    /// see.
    #[inline]
    fn link(&self, wo: Vec3, wi: Vec3) -> Option<Link> {
        if self.is_dirac() || wo.z * wi.z == 0.0 {
            return None;
        }
        let reflects = wo.z * wi.z > 0.0;
        let eta = match (reflects, wo.z > 0.0) {
            (true, _) => 1.0,
            (false, true) => self.eta,
            (false, false) => 1.0 / self.eta,
        };
        let wm = (wi * eta + wo).try_normalize()?;
        let wm = if wm.z < 0.0 { -wm } else { wm };
        let seen = wm.dot(wi) * wi.z > 0.0 && wm.dot(wo) * wo.z > 0.0;
        seen.then_some(Link { wm, reflects, eta })
    }
}
