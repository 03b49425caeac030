use core::error::Error;
use core::fmt;

use crate::amount::IrradianceAmount;
use crate::color::ColorModel;
use crate::glam::{Vec2, Vec3};
use crate::light::Light;
use crate::light_power::LightPower;
use crate::light_sample::{EmittedRay, LePdf, LightLeSample, LightLiSample};
use crate::light_type::LightType;
use crate::pdf_coverage::PdfCoverage;
use crate::scaled_emission::{EmissionError, ScaledEmission};
use crate::scene_sphere::SceneSphere;
use light_bounds::{InfiniteBounds, LightExtent, LightSampleContext};
use light_math::warp::concentric_disk;
use light_math::{Frame, direction};

/// A [`DistantLight`] as a user describes it.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub struct DistantLightDesc<C: ColorModel> {
    /// Direction toward the light, of any length above 0.
    pub direction: Vec3,
    /// Colour of the light.
    pub emission: C::Emission,
    /// Amount of light.
    pub amount: IrradianceAmount,
}

impl<C: ColorModel> DistantLightDesc<C> {
    /// A light from `direction`, which points toward it and has any length above 0.
    #[must_use]
    pub const fn new(direction: Vec3, emission: C::Emission, amount: IrradianceAmount) -> Self {
        Self {
            direction,
            emission,
            amount,
        }
    }
}

/// A light that arrives everywhere from one direction.
///
/// Its radiance is a Dirac in direction, `E delta(w - d)`, where `E` is the irradiance of a plane
/// that faces the light. An estimator is `f |cos| E`, without an inverse square.
///
/// # Source
/// `[PBRT4]`, section 12.3.
#[derive(Clone, Debug)]
pub struct DistantLight<C: ColorModel> {
    direction: Vec3,
    irradiance: ScaledEmission<C>,
    scene: SceneSphere,
}

/// Why the description of a distant light is invalid; each variant names a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DistantLightError {
    /// `direction` is zero or not finite.
    Direction,
    /// `emission` or `amount` is invalid.
    Emission(EmissionError),
}

impl<C: ColorModel> DistantLight<C> {
    /// The light that `desc` describes, over the given scene.
    ///
    /// # Errors
    /// When a field of `desc` is invalid.
    pub fn new(desc: DistantLightDesc<C>, scene: SceneSphere) -> Result<Self, DistantLightError> {
        let scale = desc.amount.scale(C::flux(&desc.emission))?;
        let direction = direction(desc.direction).map(Vec3::normalize);
        let direction = direction.ok_or(DistantLightError::Direction)?;
        Ok(Self {
            direction,
            irradiance: ScaledEmission::new(desc.emission, scale)?,
            scene,
        })
    }
}

impl<C: ColorModel> DistantLight<C> {
    pub(crate) fn light_power(&self) -> LightPower<'_, C> {
        LightPower::of_emission(&self.irradiance, self.scene.disk_area())
    }
}

impl<C: ColorModel> Light<C> for DistantLight<C> {
    fn light_type(&self) -> LightType {
        LightType::DeltaDirection
    }

    fn phi(&self, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.light_power().at(wavelengths)
    }

    fn sample_li(
        &self,
        ctx: &LightSampleContext,
        _u: Vec2,
        wavelengths: &C::Wavelengths,
        _coverage: PdfCoverage,
    ) -> Option<LightLiSample<C::Radiance>> {
        Some(LightLiSample {
            l: self.irradiance.at(wavelengths),
            wi: self.direction,
            pdf: 1.0,
            p_light: self.scene.beyond(ctx.p, self.direction),
            n_light: Vec3::ZERO,
            uv: Vec2::ZERO,
        })
    }

    fn pdf_li(&self, _ctx: &LightSampleContext, _wi: Vec3, _coverage: PdfCoverage) -> f32 {
        0.0
    }

    /// The ray starts on a disk of the scene's radius, chosen by `u1`.
    fn sample_le(
        &self,
        u1: Vec2,
        _u2: Vec2,
        wavelengths: &C::Wavelengths,
    ) -> Option<LightLeSample<C::Radiance>> {
        Some(LightLeSample {
            l: self.irradiance.at(wavelengths),
            ray: ray_through_scene(&self.scene, -self.direction, u1),
            pdf: LePdf {
                pos: 1.0 / self.scene.disk_area(),
                dir: 1.0,
            },
        })
    }

    fn pdf_le(&self, _ray: &EmittedRay) -> LePdf {
        LePdf {
            pos: 1.0 / self.scene.disk_area(),
            dir: 0.0,
        }
    }

    fn extent(&self) -> LightExtent {
        InfiniteBounds::distant(self.irradiance.maximum(), self.direction).into()
    }
}

/// The ray in `direction` that starts outside of the scene and passes through a disk of the scene's
/// radius around its centre, at the point that `u` chooses uniformly.
pub(crate) fn ray_through_scene(scene: &SceneSphere, direction: Vec3, u: Vec2) -> EmittedRay {
    let disk = concentric_disk::sample(u) * scene.radius();
    let on_disk = Frame::from_z(-direction).from_local(disk.extend(scene.radius()));
    EmittedRay::from_point(scene.center() + on_disk, direction)
}

impl fmt::Display for DistantLightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Direction => f.write_str("direction: must be finite and not zero"),
            Self::Emission(error) => error.fmt(f),
        }
    }
}

impl From<EmissionError> for DistantLightError {
    fn from(error: EmissionError) -> Self {
        Self::Emission(error)
    }
}

impl Error for DistantLightError {}
