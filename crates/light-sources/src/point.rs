use core::error::Error;
use core::f32::consts::PI;
use core::fmt;

use crate::amount::IntensityAmount;
use crate::color::ColorModel;
use crate::glam::{Vec2, Vec3};
use crate::light_power::LightPower;
use crate::medium_interface::MediumInterface;
use crate::point_source::{DirectionSample, PointSource};
use crate::scaled_emission::{EmissionError, ScaledEmission};
use light_bounds::LightBounds;
use light_math::Aabb;
use light_math::warp::uniform_sphere;

/// A [`PointLight`] as a user describes it.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub struct PointLightDesc<C: ColorModel> {
    /// Position, in scene units.
    pub position: Vec3,
    /// Colour of the light.
    pub emission: C::Emission,
    /// Amount of light.
    pub amount: IntensityAmount,
    /// The medium around it, `outside`.
    pub media: MediumInterface,
}

impl<C: ColorModel> PointLightDesc<C> {
    /// A light at `position`, in scene units, in vacuum.
    #[must_use]
    pub fn new(position: Vec3, emission: C::Emission, amount: IntensityAmount) -> Self {
        Self {
            position,
            emission,
            amount,
            media: MediumInterface::default(),
        }
    }
}

/// An isotropic point light.
///
/// # Source
/// `[PBRT4]`, section 12.2.
#[derive(Clone, Debug)]
pub struct PointLight<C: ColorModel> {
    position: Vec3,
    intensity: ScaledEmission<C>,
    media: MediumInterface,
}

/// Why the description of a point light is invalid; each variant names a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PointLightError {
    /// `position` is not finite.
    Position,
    /// `emission` or `amount` is invalid.
    Emission(EmissionError),
}

impl<C: ColorModel> PointLight<C> {
    /// The light that `desc` describes.
    ///
    /// # Errors
    /// When a field of `desc` is invalid.
    pub fn new(desc: PointLightDesc<C>) -> Result<Self, PointLightError> {
        if !desc.position.is_finite() {
            return Err(PointLightError::Position);
        }
        let intensity = C::flux(&desc.emission);
        let scale = desc.amount.scale(intensity, intensity * (4.0 * PI))?;
        Ok(Self {
            position: desc.position,
            intensity: ScaledEmission::new(desc.emission, scale)?.with_solid_angle(4.0 * PI)?,
            media: desc.media,
        })
    }
}

impl<C: ColorModel> PointLight<C> {
    pub(crate) fn light_power(&self) -> LightPower<'_, C> {
        LightPower::of_emission(&self.intensity, 4.0 * PI)
    }
}

impl<C: ColorModel> PointSource for PointLight<C> {
    type Color = C;

    fn position(&self) -> Vec3 {
        self.position
    }

    fn intensity(&self, _w: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.intensity.at(wavelengths)
    }

    fn power(&self, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.light_power().at(wavelengths)
    }

    fn sample_direction(
        &self,
        u1: Vec2,
        _u2: Vec2,
        wavelengths: &C::Wavelengths,
    ) -> Option<DirectionSample<C::Radiance>> {
        Some(DirectionSample {
            w: uniform_sphere::sample(u1),
            intensity: self.intensity.at(wavelengths),
            pdf: uniform_sphere::pdf(),
        })
    }

    fn direction_pdf(&self, _w: Vec3) -> f32 {
        uniform_sphere::pdf()
    }

    fn point_bounds(&self) -> LightBounds {
        LightBounds {
            bounds: Aabb::from_point(self.position),
            w: Vec3::Z,
            phi: 4.0 * PI * self.intensity.maximum(),
            cos_theta_o: -1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        }
    }

    fn surroundings(&self) -> MediumInterface {
        self.media
    }
}

impl fmt::Display for PointLightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Position => f.write_str("position: must be finite"),
            Self::Emission(error) => error.fmt(f),
        }
    }
}

impl From<EmissionError> for PointLightError {
    fn from(error: EmissionError) -> Self {
        Self::Emission(error)
    }
}

impl Error for PointLightError {}
