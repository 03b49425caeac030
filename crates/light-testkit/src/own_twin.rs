use alloc::sync::Arc;

use light_bounds::{LightExtent, LightId, LightSampleContext};
use light_math::glam::{Vec2, Vec3};
use light_sources::{
    AreaLight, ColorModel, EmittedRay, InfiniteLight, LePdf, Light, LightDesc, LightDescError,
    LightLeSample, LightLiSample, LightRef, LightSet, LightSetBuilder, LightType, MediumInterface,
    OwnLight, PdfCoverage, SceneSphere, SurfacePoint,
};

/// A light of another type, which forwards every method to the light of `desc`.
///
/// # Errors
/// When the description is invalid.
pub fn own_twin<C: ColorModel>(
    desc: impl Into<LightDesc<C>>,
    scene: SceneSphere,
) -> Result<OwnLight<C>, LightDescError> {
    let mut set = LightSetBuilder::new(scene);
    set.add(desc)?;
    let twin = Arc::new(Twin { set: set.build() });
    Ok(match twin.light().light_type() {
        LightType::DeltaPosition | LightType::DeltaDirection => OwnLight::Delta(twin),
        LightType::Area => OwnLight::Area(twin),
        LightType::Infinite => OwnLight::Infinite(twin),
    })
}

struct Twin<C: ColorModel> {
    /// One light.
    set: LightSet<C>,
}

impl<C: ColorModel> Twin<C> {
    fn light(&self) -> LightRef<'_, C> {
        self.set.get(LightId(0)).expect("a light of one source")
    }
}

impl<C: ColorModel> Light<C> for Twin<C> {
    fn light_type(&self) -> LightType {
        self.light().light_type()
    }

    fn phi(&self, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.light().phi(wavelengths)
    }

    fn sample_li(
        &self,
        ctx: &LightSampleContext,
        u: Vec2,
        wavelengths: &C::Wavelengths,
        coverage: PdfCoverage,
    ) -> Option<LightLiSample<C::Radiance>> {
        self.light().sample_li(ctx, u, wavelengths, coverage)
    }

    fn pdf_li(&self, ctx: &LightSampleContext, wi: Vec3, coverage: PdfCoverage) -> f32 {
        self.light().pdf_li(ctx, wi, coverage)
    }

    fn sample_le(
        &self,
        u1: Vec2,
        u2: Vec2,
        wavelengths: &C::Wavelengths,
    ) -> Option<LightLeSample<C::Radiance>> {
        self.light().sample_le(u1, u2, wavelengths)
    }

    fn pdf_le(&self, ray: &EmittedRay) -> LePdf {
        self.light().pdf_le(ray)
    }

    fn extent(&self) -> LightExtent {
        self.light().extent()
    }

    fn media(&self) -> MediumInterface {
        self.light().media()
    }
}

impl<C: ColorModel> AreaLight<C> for Twin<C> {
    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        self.light().hit(origin, direction)
    }

    fn l(&self, at: &SurfacePoint, w: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.light().l(at, w, wavelengths)
    }
}

impl<C: ColorModel> InfiniteLight<C> for Twin<C> {
    fn le(&self, origin: Vec3, direction: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.light().le(origin, direction, wavelengths)
    }
}
