use core::error::Error;
use core::f32::consts::{PI, TAU};
use core::fmt;

use crate::color::{ColorModel, Radiance};
use crate::distant::ray_through_scene;
use crate::glam::{Vec2, Vec3};
use crate::light::{InfiniteLight, Light};
use crate::light_power::LightPower;
use crate::light_sample::{EmittedRay, LePdf, LightLeSample, LightLiSample};
use crate::light_type::LightType;
use crate::pdf_coverage::PdfCoverage;
use crate::scaled_emission::{EmissionError, ScaledEmission};
use crate::scene_sphere::SceneSphere;
use crate::sun_desc::{SunAmount, SunLightDesc};
use light_bounds::{InfiniteBounds, LightExtent, LightSampleContext};
use light_math::float::{one_minus_rounded_down, sin};
use light_math::warp::uniform_cone;
use light_math::{DirectionCone, Frame, direction};

/// A disk of constant radiance at infinity. Unlike a [`DistantLight`](crate::DistantLight), it
/// casts soft shadows, is visible, and takes part in multiple importance sampling.
#[derive(Clone, Debug)]
pub struct SunLight<C: ColorModel> {
    frame: Frame,
    sin_theta: f32,
    one_minus_cos_theta: f32,
    radiance: ScaledEmission<C>,
    scene: SceneSphere,
}

/// Why the description of a sun is invalid; each variant names a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SunLightError {
    /// `direction` is zero or not finite.
    Direction,
    /// `angular_diameter` does not lie in `(0, pi]`, or is so small that single precision has no
    /// number for its solid angle.
    AngularDiameter,
    /// `emission` or `amount` is invalid.
    Emission(EmissionError),
}

/// The relative rounding error of a sine, and by how much the rounding of a sampled direction moves
/// it at most.
const ROUNDING: f32 = 2.0 * f32::EPSILON;

impl<C: ColorModel> SunLight<C> {
    /// The light that `desc` describes, over the given scene.
    ///
    /// # Errors
    /// When a field of `desc` is invalid.
    pub fn new(desc: SunLightDesc<C>, scene: SceneSphere) -> Result<Self, SunLightError> {
        let direction = direction(desc.direction).map(Vec3::normalize);
        let direction = direction.ok_or(SunLightError::Direction)?;
        let sin_theta = sin(0.5 * desc.angular_diameter);
        let sin_half = sin(0.25 * desc.angular_diameter);
        let one_minus_cos_theta = 2.0 * sin_half * sin_half;
        let is_angle = desc.angular_diameter > 0.0 && desc.angular_diameter <= PI;
        if !(is_angle && (1.0 / one_minus_cos_theta).is_finite()) {
            return Err(SunLightError::AngularDiameter);
        }
        let unit = C::flux(&desc.emission);
        let scale = match desc.amount {
            SunAmount::Radiance(radiance) => radiance.scale(unit)?,
            // The integral of the cosine over the disk is pi sin^2.
            SunAmount::Irradiance(irradiance) => {
                irradiance.scale(unit)? / (PI * sin_theta * sin_theta)
            }
        };
        let radiance = ScaledEmission::new(desc.emission, scale)?;
        Ok(Self {
            frame: Frame::from_z(direction),
            sin_theta,
            one_minus_cos_theta,
            radiance: radiance.with_solid_angle(TAU * one_minus_cos_theta)?,
            scene,
        })
    }

    fn solid_angle(&self) -> f32 {
        TAU * self.one_minus_cos_theta
    }

    fn contains(&self, wi: Vec3) -> bool {
        let z = self.frame.z;
        // The difference of near directions is exact, and its part along z has no cross product.
        let sin = z.cross(wi - z).length();
        z.dot(wi) > 0.0 && sin <= self.sin_theta * (1.0 + 2.0 * ROUNDING)
    }

    fn pdf(&self, wi: Vec3) -> f32 {
        if self.contains(wi) {
            uniform_cone::pdf(self.one_minus_cos_theta)
        } else {
            0.0
        }
    }

    fn sample(&self, u: Vec2) -> Vec3 {
        let local = uniform_cone::sample(u, self.one_minus_cos_theta);
        let wi = self.frame.from_local(local);
        if self.contains(wi) {
            return wi;
        }
        // Rounding has moved it over the rim: back by as much.
        let inward = (1.0 - ROUNDING / self.sin_theta).max(0.0);
        let within = (local.truncate() * inward).extend(local.z + ROUNDING);
        self.frame.from_local(within)
    }
}

impl<C: ColorModel> SunLight<C> {
    pub(crate) fn light_power(&self) -> LightPower<'_, C> {
        let etendue = self.solid_angle() * self.scene.disk_area();
        LightPower::of_emission(&self.radiance, etendue)
    }
}

impl<C: ColorModel> Light<C> for SunLight<C> {
    fn light_type(&self) -> LightType {
        LightType::Infinite
    }

    fn phi(&self, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.light_power().at(wavelengths)
    }

    fn sample_li(
        &self,
        ctx: &LightSampleContext,
        u: Vec2,
        wavelengths: &C::Wavelengths,
        _coverage: PdfCoverage,
    ) -> Option<LightLiSample<C::Radiance>> {
        let wi = self.sample(u);
        Some(LightLiSample {
            l: self.radiance.at(wavelengths),
            wi,
            pdf: uniform_cone::pdf(self.one_minus_cos_theta),
            p_light: self.scene.beyond(ctx.p, wi),
            n_light: Vec3::ZERO,
            uv: Vec2::ZERO,
        })
    }

    fn pdf_li(&self, _ctx: &LightSampleContext, wi: Vec3, _coverage: PdfCoverage) -> f32 {
        self.pdf(wi)
    }

    /// The direction is chosen by `u1`, the point on a disk of the scene's radius by `u2`.
    fn sample_le(
        &self,
        u1: Vec2,
        u2: Vec2,
        wavelengths: &C::Wavelengths,
    ) -> Option<LightLeSample<C::Radiance>> {
        Some(LightLeSample {
            l: self.radiance.at(wavelengths),
            ray: ray_through_scene(&self.scene, -self.sample(u1), u2),
            pdf: LePdf {
                pos: 1.0 / self.scene.disk_area(),
                dir: uniform_cone::pdf(self.one_minus_cos_theta),
            },
        })
    }

    fn pdf_le(&self, ray: &EmittedRay) -> LePdf {
        LePdf {
            pos: 1.0 / self.scene.disk_area(),
            dir: self.pdf(-ray.direction),
        }
    }

    fn extent(&self) -> LightExtent {
        let cos_theta = one_minus_rounded_down(self.one_minus_cos_theta);
        LightExtent::Infinite(InfiniteBounds {
            fluence: self.radiance.maximum() * self.solid_angle(),
            mean: self.frame.z * (0.5 * (1.0 + cos_theta)),
            cone: DirectionCone::new(self.frame.z, cos_theta),
        })
    }
}

impl<C: ColorModel> InfiniteLight<C> for SunLight<C> {
    fn le(&self, _origin: Vec3, direction: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        if self.contains(direction) {
            self.radiance.at(wavelengths)
        } else {
            C::Radiance::BLACK
        }
    }
}

impl fmt::Display for SunLightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Direction => f.write_str("direction: must be finite and not zero"),
            Self::AngularDiameter => f.write_str(
                "angular_diameter: must lie in (0, pi], with a solid angle that is a number",
            ),
            Self::Emission(error) => error.fmt(f),
        }
    }
}

impl Error for SunLightError {}

impl From<EmissionError> for SunLightError {
    fn from(error: EmissionError) -> Self {
        Self::Emission(error)
    }
}

#[cfg(test)]
mod tests;
