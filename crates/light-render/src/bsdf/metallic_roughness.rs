use core::f32::consts::FRAC_1_PI;

use lights::glam::{Vec2, Vec3};
use lights::math::warp::cosine_hemisphere;

use super::albedo::Albedo;
use super::bsdf_sample::BsdfSample;
use super::conductor::reflect;
use super::fresnel;
use super::microfacets::Microfacets;

/// A mixture of a metal and of a diffuse base below a dielectric, as glTF describes surfaces, and a
/// clear coat above both. Opaque, the same on both sides.
///
/// Metal and dielectric have the same facets, so that their mixture is one reflection with the
/// mixture of their Fresnel factors. What the dielectric does not reflect, over all directions,
/// reaches the base: a white one reflects all light at every roughness.
///
/// # Source
/// `[GLTF]`, appendix B, with the coupling of diffuse and specular reflection by albedos of
/// `[Kulla2017]`, which keeps energy at grazing angles; KHR_materials_clearcoat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetallicRoughness {
    /// Reflectance of the base, by the share that is no metal, over the mean that the dielectric
    /// lets through.
    base: Vec3,
    /// The largest reflectance of the dielectric at normal incidence, and at grazing incidence.
    dielectric: Vec2,
    /// Of metal and dielectric at normal incidence.
    f0: Vec3,
    /// Of metal and dielectric at grazing incidence.
    f90: f32,
    facets: Microfacets,
    albedo: Albedo,
    coat: Option<Coat>,
}

/// What a surface is made of at one point. All shares are in `[0, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetallicRoughnessParameters {
    /// Reflectance of the metal at normal incidence, and of the base below the dielectric.
    pub base_color: Vec3,
    /// The share of metal.
    pub metallic: f32,
    /// The root of the width of the facets.
    pub roughness: f32,
    /// Reflectance of the dielectric at normal incidence.
    pub f0: Vec3,
    /// Reflectance of the dielectric at grazing incidence.
    pub f90: f32,
    /// The share of the clear coat, and its roughness.
    pub clearcoat: Option<[f32; 2]>,
}

/// A clear coat of index 1.5.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Coat {
    weight: f32,
    facets: Microfacets,
    albedo: Albedo,
}

/// The reflectance of the coat at normal incidence.
const COAT_F0: f32 = 0.04;

/// How likely each lobe is chosen.
struct Lobes {
    base: f32,
    facets: f32,
    coat: f32,
}

impl MetallicRoughness {
    /// The scattering function of these parameters, each clamped to its domain.
    #[must_use]
    pub fn new(parameters: &MetallicRoughnessParameters) -> Self {
        let unit = |x: f32| x.clamp(0.0, 1.0);
        let unit3 = |v: Vec3| v.clamp(Vec3::ZERO, Vec3::ONE);
        let [metallic, roughness, edge] =
            [parameters.metallic, parameters.roughness, parameters.f90].map(unit);
        let color = unit3(parameters.base_color);
        let f0 = unit3(parameters.f0);
        let albedo = Albedo::new(roughness);
        let dielectric = Vec2::new(f0.max_element(), edge);
        let base = color * (1.0 - metallic) / (1.0 - dielectric.dot(albedo.mean())).max(1e-3);
        let coat = parameters.clearcoat.and_then(|coat| {
            let [weight, roughness] = coat.map(unit);
            (weight > 0.0).then(|| Coat {
                weight,
                facets: facets(roughness),
                albedo: Albedo::new(roughness),
            })
        });
        Self {
            base,
            dielectric,
            f0: f0.lerp(color, metallic),
            f90: edge + (1.0 - edge) * metallic,
            facets: facets(roughness),
            albedo,
            coat,
        }
    }

    /// Whether all light is scattered into single directions.
    #[inline]
    #[must_use]
    pub(super) fn is_dirac(&self) -> bool {
        self.base == Vec3::ZERO
            && self.facets.is_smooth()
            && self.coat.is_none_or(|coat| coat.facets.is_smooth())
    }

    /// The width of the facets, and about the share of the reflected light that the base reflects.
    #[inline]
    #[must_use]
    pub(super) fn gloss(&self) -> (f32, f32) {
        let base = self.base.element_sum() / 3.0;
        let reflected = self.f0.element_sum() / 3.0;
        let alpha = match self.coat {
            Some(coat) => coat.facets.alpha().max(self.facets.alpha()),
            None => self.facets.alpha(),
        };
        (alpha, base / (base + reflected).max(f32::MIN_POSITIVE))
    }

    /// The scattering function times `|cos theta_i|`, without its Diracs.
    #[inline]
    #[must_use]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if !(wo.z * wi.z > 0.0) {
            return Vec3::ZERO;
        }
        let [o, i] = [wo.z.abs(), wi.z.abs()];
        let mut f = self.base * (self.passes(o) * self.passes(i) * i * FRAC_1_PI);
        let Some(wm) = (wo + wi).try_normalize() else {
            return f;
        };
        if !self.facets.is_smooth() {
            let fresnel = fresnel::schlick(wo.dot(wm).abs(), self.f0, self.f90);
            f += fresnel * (self.facets.d(wm) * self.facets.g(wo, wi) / (4.0 * o));
        }
        if let Some(coat) = &self.coat {
            f *= coat.passes(o) * coat.passes(i);
            if !coat.facets.is_smooth() {
                let share = coat.reflects(wo.dot(wm).abs());
                f += share * coat.facets.d(wm) * coat.facets.g(wo, wi) / (4.0 * o);
            }
        }
        f
    }

    /// The density of [`sample`](Self::sample), its Diracs left out.
    #[inline]
    #[must_use]
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if !(wo.z * wi.z > 0.0) {
            return 0.0;
        }
        let Some(lobes) = self.lobes(wo.z.abs()) else {
            return 0.0;
        };
        let mut pdf = lobes.base * cosine_hemisphere::pdf(wi.z.abs());
        let Some(wm) = (wo + wi).try_normalize() else {
            return pdf;
        };
        let of = |facets: &Microfacets| facets.visible_pdf(wo, wm) / (4.0 * wo.dot(wm).abs());
        if !self.facets.is_smooth() {
            pdf += lobes.facets * of(&self.facets);
        }
        if let Some(coat) = self.coat.filter(|coat| !coat.facets.is_smooth()) {
            pdf += lobes.coat * of(&coat.facets);
        }
        pdf
    }

    /// Samples a reflection by the base, by the facets or by the coat, about in proportion to
    /// their brightness.
    #[inline]
    #[must_use]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        let o = wo.z.abs();
        let lobes = self.lobes(o)?;
        let side = if wo.z < 0.0 { -1.0 } else { 1.0 };
        let mirrored = |weight: Vec3| BsdfSample {
            wi: Vec3::new(-wo.x, -wo.y, wo.z),
            weight,
            pdf: None,
            eta: 1.0,
        };
        let by = |facets: &Microfacets| reflect(wo, facets.sample_visible(wo * side, u) * side);
        let wi = if u_lobe < lobes.base {
            cosine_hemisphere::sample(u) * side
        } else if u_lobe < lobes.base + lobes.facets || self.coat.is_none() {
            if self.facets.is_smooth() {
                let coat = self.coat.map_or(1.0, |coat| coat.passes(o).powi(2));
                let fresnel = fresnel::schlick(o, self.f0, self.f90);
                return Some(mirrored(fresnel * (coat / lobes.facets)));
            }
            by(&self.facets)
        } else {
            let coat = self.coat?;
            if coat.facets.is_smooth() {
                return Some(mirrored(Vec3::splat(coat.reflects(o) / lobes.coat)));
            }
            by(&coat.facets)
        };
        let pdf = self.pdf(wo, wi);
        BsdfSample::reflected(wi, || self.eval(wo, wi), pdf)
    }

    /// The share of light that passes the dielectric, under the cosine `cos`.
    #[inline]
    fn passes(&self, cos: f32) -> f32 {
        1.0 - self.dielectric.dot(self.albedo.at(cos))
    }

    /// The probabilities of the lobes under the viewer's cosine `cos`; `None` for a black surface.
    #[inline]
    fn lobes(&self, cos: f32) -> Option<Lobes> {
        let below = self.coat.map_or(1.0, |coat| coat.passes(cos));
        let base = below * self.base.max_element() * self.passes(cos);
        let seen = Vec2::new(self.f0.max_element(), self.f90);
        let facets = below * seen.dot(self.albedo.at(cos));
        let coat = 1.0 - below;
        let total = base + facets + coat;
        if !(total > 0.0) {
            return None;
        }
        // Each lobe that reflects anything has a good chance: estimates of brightness may be off.
        let chance = |x: f32| if x > 0.0 { (x / total).max(0.1) } else { 0.0 };
        let [base, facets, coat] = [base, facets, coat].map(chance);
        let total = base + facets + coat;
        Some(Lobes {
            base: base / total,
            facets: facets / total,
            coat: coat / total,
        })
    }
}

impl Coat {
    #[inline]
    fn passes(&self, cos: f32) -> f32 {
        1.0 - self.weight * Vec2::new(COAT_F0, 1.0).dot(self.albedo.at(cos))
    }

    #[inline]
    fn reflects(&self, cos: f32) -> f32 {
        self.weight * fresnel::schlick(cos, Vec3::splat(COAT_F0), 1.0).x
    }
}

fn facets(roughness: f32) -> Microfacets {
    Microfacets::new(Vec2::splat(roughness * roughness))
}

#[cfg(test)]
mod tests;
