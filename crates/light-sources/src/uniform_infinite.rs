use core::f32::consts::PI;

use crate::amount::RadianceAmount;
use crate::color::ColorModel;
use crate::distant::ray_through_scene;
use crate::glam::{Vec2, Vec3};
use crate::light::{InfiniteLight, Light};
use crate::light_power::LightPower;
use crate::light_sample::{EmittedRay, LePdf, LightLeSample, LightLiSample};
use crate::light_type::LightType;
use crate::pdf_coverage::PdfCoverage;
use crate::scaled_emission::{EmissionError, ScaledEmission};
use crate::scene_sphere::SceneSphere;
use light_bounds::{InfiniteBounds, LightExtent, LightSampleContext};
use light_math::warp::uniform_sphere;

/// A [`UniformInfiniteLight`] as a user describes it.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub struct UniformInfiniteLightDesc<C: ColorModel> {
    /// Colour of the sky.
    pub emission: C::Emission,
    /// Amount of light.
    pub amount: RadianceAmount,
}

impl<C: ColorModel> UniformInfiniteLightDesc<C> {
    /// A sky of one colour.
    #[must_use]
    pub const fn new(emission: C::Emission, amount: RadianceAmount) -> Self {
        Self { emission, amount }
    }
}

/// The same radiance from all directions.
///
/// # Source
/// `[PBRT4]`, section 12.5.1.
#[derive(Clone, Debug)]
pub struct UniformInfiniteLight<C: ColorModel> {
    radiance: ScaledEmission<C>,
    scene: SceneSphere,
}

impl<C: ColorModel> UniformInfiniteLight<C> {
    /// The light that `desc` describes, over the given scene.
    ///
    /// # Errors
    /// When a field of `desc` is invalid.
    pub fn new(
        desc: UniformInfiniteLightDesc<C>,
        scene: SceneSphere,
    ) -> Result<Self, EmissionError> {
        let scale = desc.amount.scale(C::flux(&desc.emission))?;
        let radiance = ScaledEmission::new(desc.emission, scale)?;
        Ok(Self {
            radiance: radiance.with_solid_angle(4.0 * PI)?,
            scene,
        })
    }
}

impl<C: ColorModel> UniformInfiniteLight<C> {
    pub(crate) fn light_power(&self) -> LightPower<'_, C> {
        LightPower::of_emission(&self.radiance, 4.0 * PI * self.scene.disk_area())
    }
}

impl<C: ColorModel> Light<C> for UniformInfiniteLight<C> {
    fn light_type(&self) -> LightType {
        LightType::Infinite
    }

    fn phi(&self, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.light_power().at(wavelengths)
    }

    /// No sample when the coverage may be incomplete: any other sample finds this light as well.
    fn sample_li(
        &self,
        ctx: &LightSampleContext,
        u: Vec2,
        wavelengths: &C::Wavelengths,
        coverage: PdfCoverage,
    ) -> Option<LightLiSample<C::Radiance>> {
        if coverage == PdfCoverage::Incomplete {
            return None;
        }
        let wi = uniform_sphere::sample(u);
        Some(LightLiSample {
            l: self.radiance.at(wavelengths),
            wi,
            pdf: uniform_sphere::pdf(),
            p_light: self.scene.beyond(ctx.p, wi),
            n_light: Vec3::ZERO,
            uv: Vec2::ZERO,
        })
    }

    fn pdf_li(&self, _ctx: &LightSampleContext, _wi: Vec3, coverage: PdfCoverage) -> f32 {
        match coverage {
            PdfCoverage::Complete => uniform_sphere::pdf(),
            PdfCoverage::Incomplete => 0.0,
        }
    }

    /// The direction is chosen by `u1`, the point on a disk of the scene's radius by `u2`.
    fn sample_le(
        &self,
        u1: Vec2,
        u2: Vec2,
        wavelengths: &C::Wavelengths,
    ) -> Option<LightLeSample<C::Radiance>> {
        let ray = ray_through_scene(&self.scene, uniform_sphere::sample(u1), u2);
        Some(LightLeSample {
            l: self.radiance.at(wavelengths),
            ray,
            pdf: <Self as Light<C>>::pdf_le(self, &ray),
        })
    }

    fn pdf_le(&self, _ray: &EmittedRay) -> LePdf {
        LePdf {
            pos: 1.0 / self.scene.disk_area(),
            dir: uniform_sphere::pdf(),
        }
    }

    fn extent(&self) -> LightExtent {
        InfiniteBounds::uniform(self.radiance.maximum()).into()
    }
}

impl<C: ColorModel> InfiniteLight<C> for UniformInfiniteLight<C> {
    fn le(&self, _origin: Vec3, _direction: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.radiance.at(wavelengths)
    }
}
