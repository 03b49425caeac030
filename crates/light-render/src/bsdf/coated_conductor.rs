use lights::glam::{Vec2, Vec3};

use super::bsdf_sample::BsdfSample;
use super::clear_coat::ClearCoat;
use super::conductor::Conductor;
use super::fresnel;
use super::microfacets::Microfacets;

/// A metal under a clear coat: lacquered brass, car paint. Opaque, the same on both sides.
///
/// Light is refracted by the coat, reflected by the metal, and partly reflected back inside by the
/// coat, any number of times. The roughness of the coat affects its reflection, not its
/// transmission.
///
/// # Source
/// `[Weidlich2007]`, section 3, for a base of microfacets, with the geometric series of reflections
/// inside of the coat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoatedConductor {
    /// The metal, with an index of refraction relative to the coat.
    base: Conductor,
    coat: ClearCoat,
}

impl CoatedConductor {
    /// A metal with index of refraction `base.eta` and absorption `base.k` relative to the outside,
    /// under a coat with index of refraction `eta` and roughness `facets`.
    #[must_use]
    pub fn new(base: Conductor, eta: f32, facets: Microfacets) -> Self {
        let base = Conductor {
            eta: base.eta / eta,
            k: base.k / eta,
            ..base
        };
        let coat = ClearCoat { eta, facets };
        Self { base, coat }
    }

    /// The larger roughness of both layers: of the reflected light nothing is diffuse.
    #[inline]
    #[must_use]
    pub(super) fn gloss(&self) -> (f32, f32) {
        let alpha = self.coat.facets.alpha().max(self.base.facets.alpha());
        (alpha, 0.0)
    }

    /// Whether both layers are smooth.
    #[inline]
    #[must_use]
    pub(super) fn is_dirac(&self) -> bool {
        self.coat.facets.is_smooth() && self.base.facets.is_smooth()
    }

    /// The scattering function times `|cos theta_i|`.
    #[inline]
    #[must_use]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if !(wo.z * wi.z > 0.0) {
            return Vec3::ZERO;
        }
        let base = self.base_eval(wo, wi);
        base + self.coat.eval(wo, wi)
    }

    /// The density of [`sample`](Self::sample), Diracs of smooth layers left out.
    #[inline]
    #[must_use]
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if !(wo.z * wi.z > 0.0) {
            return 0.0;
        }
        let p = self.coat_probability(wo);
        let coat = self.coat.pdf(wo, wi);
        let (inner_wo, inner_wi) = (self.refracted(wo), self.refracted(wi));
        let base = self.base.pdf(inner_wo, inner_wi) * self.squeezed(wi, inner_wi);
        p * coat + (1.0 - p) * base
    }

    /// Samples a reflection by the coat or by the metal, about in proportion to their brightness.
    #[inline]
    #[must_use]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        let p = self.coat_probability(wo);
        let side = if wo.z < 0.0 { -1.0 } else { 1.0 };
        let mirrored = |weight| {
            Some(BsdfSample {
                wi: Vec3::new(-wo.x, -wo.y, wo.z),
                weight,
                pdf: None,
                eta: 1.0,
            })
        };
        let wi = if u_lobe < p {
            if self.coat.facets.is_smooth() {
                return mirrored(Vec3::splat(self.coat.reflects(wo) / p));
            }
            self.coat.sample(wo, side, u)
        } else {
            let inner_wo = self.refracted(wo);
            let inner = self.base.sample(inner_wo, u)?;
            if inner.pdf.is_none() {
                let passes = self.coat.passes(wo) * self.coat.passes(wo);
                let weight = inner.weight * passes * self.again(inner.weight, wo, wo);
                return mirrored(weight / (1.0 - p));
            }
            self.leaving(inner.wi)?
        };
        let pdf = self.pdf(wo, wi);
        BsdfSample::reflected(wi, || self.eval(wo, wi), pdf)
    }

    /// What the metal reflects through the coat, times `|cos theta_i|`.
    #[inline]
    fn base_eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        let (inner_wo, inner_wi) = (self.refracted(wo), self.refracted(wi));
        let reflected = self.base.eval(inner_wo, inner_wi);
        if reflected == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let middle = (inner_wo + inner_wi).normalize_or_zero();
        let metal = fresnel::conductor(inner_wo.dot(middle).abs(), self.base.eta, self.base.k);
        let passes = self.coat.passes(wo) * self.coat.passes(wi) * self.squeezed(wi, inner_wi);
        reflected * self.again(metal, wo, wi) * passes
    }

    /// The factor of light that the coat sends back to the metal, which reflects the share `metal`
    /// each time.
    #[inline]
    fn again(&self, metal: Vec3, wo: Vec3, wi: Vec3) -> Vec3 {
        let kept = 1.0 - 0.5 * (self.coat.passes(wo) + self.coat.passes(wi));
        1.0 / (1.0 - metal * kept)
    }

    /// Solid angle inside of the coat over that outside of it.
    #[inline]
    fn squeezed(&self, w: Vec3, inner: Vec3) -> f32 {
        (w.z / inner.z).abs() / (self.coat.eta * self.coat.eta)
    }

    /// The direction inside of the coat of one outside, both away from the metal.
    #[inline]
    fn refracted(&self, w: Vec3) -> Vec3 {
        let (x, y) = (w.x / self.coat.eta, w.y / self.coat.eta);
        // No sine exceeds 1 on the way into what is denser; into what is thinner the way is
        // grazing.
        let z = (1.0 - x * x - y * y).max(1e-6).sqrt();
        Vec3::new(x, y, if w.z < 0.0 { -z } else { z }).normalize()
    }

    /// The direction outside of one inside; `None` where all of the light stays inside.
    #[inline]
    fn leaving(&self, inner: Vec3) -> Option<Vec3> {
        let (x, y) = (inner.x * self.coat.eta, inner.y * self.coat.eta);
        let cos_squared = 1.0 - x * x - y * y;
        (cos_squared > 0.0).then(|| {
            let z = cos_squared.sqrt();
            Vec3::new(x, y, if inner.z < 0.0 { -z } else { z })
        })
    }

    #[inline]
    fn coat_probability(&self, wo: Vec3) -> f32 {
        let metal = fresnel::conductor(wo.z.abs(), self.base.eta, self.base.k);
        self.coat.probability(wo, metal.max_element())
    }
}
