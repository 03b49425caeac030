//! How surfaces scatter light.
//!
//! Directions here are unit vectors in the frame of the shading normal: `z` is the cosine to the
//! normal. `wo` points to where the light goes (the viewer), `wi` to where it comes from; both away
//! from the surface.

mod albedo;
mod bsdf_sample;
mod clear_coat;
mod coated_conductor;
mod coated_diffuse;
mod conductor;
mod dielectric;
mod fresnel;
mod lambert;
mod metallic_roughness;
mod microfacets;
mod mirror;
mod scattering;
mod thin_dielectric;

pub use bsdf_sample::BsdfSample;
pub use coated_conductor::CoatedConductor;
pub use coated_diffuse::CoatedDiffuse;
pub use conductor::Conductor;
pub use dielectric::Dielectric;
pub use lambert::Lambert;
pub use metallic_roughness::{MetallicRoughness, MetallicRoughnessParameters};
pub use microfacets::Microfacets;
pub use mirror::Mirror;
pub use scattering::Scattering;
pub use thin_dielectric::ThinDielectric;

use lights::glam::{Vec2, Vec3};

/// A surface's scattering function at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Bsdf {
    /// Lambertian paint or paper.
    Lambert(Lambert),
    /// A plane mirror.
    Mirror(Mirror),
    /// A metal.
    Conductor(Conductor),
    /// Glass or water.
    Dielectric(Dielectric),
    /// A thin pane of glass.
    ThinDielectric(ThinDielectric),
    /// Paint under a clear coat.
    CoatedDiffuse(CoatedDiffuse),
    /// A metal, a coated dielectric, or a mixture of both.
    MetallicRoughness(MetallicRoughness),
    /// A metal under a clear coat.
    CoatedConductor(CoatedConductor),
}

impl Bsdf {
    /// The scattering function times `|cos theta_i|`, in sr^-1, without its Diracs.
    #[inline]
    #[must_use]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        match self {
            Self::Lambert(bsdf) => bsdf.eval(wo, wi),
            Self::Conductor(bsdf) => bsdf.eval(wo, wi),
            Self::Dielectric(bsdf) => bsdf.eval(wo, wi),
            Self::CoatedDiffuse(bsdf) => bsdf.eval(wo, wi),
            Self::MetallicRoughness(bsdf) => bsdf.eval(wo, wi),
            Self::CoatedConductor(bsdf) => bsdf.eval(wo, wi),
            Self::Mirror(_) | Self::ThinDielectric(_) => Vec3::ZERO,
        }
    }

    /// The density in sr^-1 with which [`sample`](Self::sample) chooses `wi`, its Diracs left out.
    #[inline]
    #[must_use]
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        match self {
            Self::Lambert(bsdf) => bsdf.pdf(wo, wi),
            Self::Conductor(bsdf) => bsdf.pdf(wo, wi),
            Self::Dielectric(bsdf) => bsdf.pdf(wo, wi),
            Self::CoatedDiffuse(bsdf) => bsdf.pdf(wo, wi),
            Self::MetallicRoughness(bsdf) => bsdf.pdf(wo, wi),
            Self::CoatedConductor(bsdf) => bsdf.pdf(wo, wi),
            Self::Mirror(_) | Self::ThinDielectric(_) => 0.0,
        }
    }

    /// A direction of incidence, the lobe chosen by `u_lobe`, the direction by `u`, all in
    /// `[0, 1)`; `None` where nothing is scattered.
    #[inline]
    #[must_use]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        match self {
            Self::Lambert(bsdf) => bsdf.sample(wo, u_lobe, u),
            Self::Mirror(bsdf) => bsdf.sample(wo),
            Self::Conductor(bsdf) => bsdf.sample(wo, u),
            Self::Dielectric(bsdf) => bsdf.sample(wo, u_lobe, u),
            Self::ThinDielectric(bsdf) => Some(bsdf.sample(wo, u_lobe)),
            Self::CoatedDiffuse(bsdf) => bsdf.sample(wo, u_lobe, u),
            Self::MetallicRoughness(bsdf) => bsdf.sample(wo, u_lobe, u),
            Self::CoatedConductor(bsdf) => bsdf.sample(wo, u_lobe, u),
        }
    }

    /// Whether all light is scattered into single directions, so that light samples cannot
    /// contribute.
    #[inline]
    #[must_use]
    pub fn is_dirac(&self) -> bool {
        match self {
            Self::Mirror(_) | Self::ThinDielectric(_) => true,
            Self::Conductor(bsdf) => bsdf.facets.is_smooth(),
            Self::Dielectric(bsdf) => bsdf.is_dirac(),
            Self::MetallicRoughness(bsdf) => bsdf.is_dirac(),
            Self::CoatedConductor(bsdf) => bsdf.is_dirac(),
            Self::Lambert(_) | Self::CoatedDiffuse(_) => false,
        }
    }

    /// Whether light that arrives from behind is scattered to the front.
    #[inline]
    #[must_use]
    pub fn transmits(&self) -> bool {
        match self {
            Self::Lambert(bsdf) => bsdf.transmittance != Vec3::ZERO,
            Self::Dielectric(_) | Self::ThinDielectric(_) => true,
            Self::Mirror(_)
            | Self::Conductor(_)
            | Self::CoatedDiffuse(_)
            | Self::CoatedConductor(_)
            | Self::MetallicRoughness(_) => false,
        }
    }

    /// Roughness and diffuse share of an opaque glossy surface; `None` for all others.
    #[inline]
    #[must_use]
    pub fn gloss(&self) -> Option<(f32, f32)> {
        match self {
            Self::Conductor(bsdf) => Some((bsdf.facets.alpha(), 0.0)),
            Self::CoatedDiffuse(bsdf) => Some(bsdf.gloss()),
            Self::MetallicRoughness(bsdf) => Some(bsdf.gloss()),
            Self::CoatedConductor(bsdf) => Some(bsdf.gloss()),
            Self::Lambert(_) | Self::Mirror(_) | Self::Dielectric(_) | Self::ThinDielectric(_) => {
                None
            }
        }
    }
}

#[cfg(test)]
mod tests;
