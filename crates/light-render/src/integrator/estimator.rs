use lights::math::mis;
use lights::sources::{LightType, PdfCoverage};

/// Which strategies find the light that arrives at a surface.
///
/// Of lights that rays can hit all have the same mean, and differ in noise. What no ray hits
/// (points, spots, distant lights, and emitters that are [invisible](light_scene::Alpha)) is
/// missing from [`Bsdf`](Self::Bsdf), and has the same mean by the others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Estimator {
    /// Light samples and material samples, weighted against each other.
    #[default]
    Mis,
    /// Light samples alone; only Dirac materials (mirrors) find lights by the way they scatter.
    Light,
    /// Material samples alone.
    Bsdf,
}

impl Estimator {
    /// Whether lights are sampled.
    #[must_use]
    pub const fn samples_lights(self) -> bool {
        matches!(self, Self::Mis | Self::Light)
    }

    /// The directions that light samples must cover: all, unless material samples cover the rest.
    #[must_use]
    pub const fn coverage(self) -> PdfCoverage {
        match self {
            Self::Mis => PdfCoverage::Incomplete,
            Self::Light | Self::Bsdf => PdfCoverage::Complete,
        }
    }

    /// The weight of a light sample of density `light`, where the material has density `bsdf`; both
    /// in sr^-1. It is 1 for a `kind` of light that rays cannot find.
    #[inline]
    #[must_use]
    pub(crate) fn light_weight(
        self,
        kind: LightType,
        light: f32,
        bsdf: impl FnOnce() -> f32,
    ) -> f32 {
        if kind.is_delta() {
            return 1.0;
        }
        match self {
            Self::Mis => mis::power(light, bsdf()),
            Self::Light => 1.0,
            Self::Bsdf => 0.0,
        }
    }

    /// The weight of a material sample of density `bsdf` that found a light, where light samples
    /// have the density `light`; both in sr^-1.
    #[inline]
    #[must_use]
    pub(crate) fn bsdf_weight(self, bsdf: f32, light: impl FnOnce() -> f32) -> f32 {
        match self {
            Self::Mis => mis::power(bsdf, light()),
            Self::Light => 0.0,
            Self::Bsdf => 1.0,
        }
    }
}
