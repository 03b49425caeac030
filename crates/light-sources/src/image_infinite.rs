use alloc::sync::Arc;
use core::f32::consts::PI;
use core::marker::PhantomData;

use crate::color::ColorModel;
use crate::distant::ray_through_scene;
use crate::environment_table::EnvironmentTable;
use crate::glam::{Vec2, Vec3};
use crate::image::Image;
use crate::image_infinite_desc::{EnvironmentMap, ImageInfiniteLightDesc, ImageInfiniteLightError};
use crate::image_sky::ImageSky;
use crate::light::{InfiniteLight, Light};
use crate::light_power::LightPower;
use crate::light_sample::{EmittedRay, LePdf, LightLeSample, LightLiSample};
use crate::light_type::LightType;
use crate::pdf_coverage::PdfCoverage;
use crate::rigid_transform::RigidTransform;
use crate::scene_sphere::SceneSphere;
use light_bounds::{InfiniteBounds, LightExtent, LightSampleContext};
use light_math::DirectionCone;

/// An environment map: radiance from infinitely far away, by direction, constant over each texel.
///
/// A lat-long picture is sampled by texel, in proportion to the sum of its channels times its exact
/// solid angle, and evenly over that solid angle: the density is constant over a texel too, above 0
/// wherever there is light, and the same bits in a sample and in a query unless a texel is smaller
/// than the rounding of a direction. An equal-area picture is sampled as pbrt samples it.
///
/// Memory beside the image: 8 bytes a texel of a lat-long picture, 16 of an equal-area one.
/// Building takes two passes over the texels; with the feature `rayon` those of a lat-long picture
/// run on all threads, and give the same bits on any number of them. A sample takes two binary
/// searches, along rows and along columns. The example [`environment`][1] lights a ball
/// with one.
///
/// [1]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/environment.rs
///
/// # Source
/// `[PBRT4]`, section 12.5.2, of which the map and the solid angle of lat-long texels differ; the
/// compensated distribution for [`PdfCoverage::Incomplete`] is that of `[Karlik2019]`, with the
/// mean over the sphere.
#[derive(Clone, Debug)]
pub struct ImageInfiniteLight<C> {
    transform: RigidTransform,
    /// Shared by clones, and by the light that an update makes of this one.
    sky: Arc<ImageSky>,
    scale: f32,
    scene: SceneSphere,
    extent: InfiniteBounds,
    color: PhantomData<C>,
}

impl<C: ColorModel> ImageInfiniteLight<C> {
    /// The light that `desc` describes, over the given scene.
    ///
    /// # Errors
    /// When a field of `desc` is invalid.
    pub fn new(
        desc: ImageInfiniteLightDesc,
        scene: SceneSphere,
    ) -> Result<Self, ImageInfiniteLightError> {
        Self::with_sky(desc, scene, |map| ImageSky::new(map).map(Arc::new))
    }

    /// The light that `desc` describes, over the same scene; it shares the tables of this one if
    /// its picture is a clone.
    pub(crate) fn updated(
        &self,
        desc: ImageInfiniteLightDesc,
    ) -> Result<Self, ImageInfiniteLightError> {
        Self::with_sky(desc, self.scene, |map| {
            if self.sky.is_of(&map) {
                Ok(self.sky.clone())
            } else {
                ImageSky::new(map).map(Arc::new)
            }
        })
    }

    fn with_sky(
        desc: ImageInfiniteLightDesc,
        scene: SceneSphere,
        sky: impl FnOnce(EnvironmentMap) -> Result<Arc<ImageSky>, ImageInfiniteLightError>,
    ) -> Result<Self, ImageInfiniteLightError> {
        let scale = desc.amount.scale(C::flux_of_texel(Vec3::ONE));
        let scale = scale.map_err(|_| ImageInfiniteLightError::Amount)?;
        let transform = RigidTransform::new(desc.transform)?;
        let sky = sky(desc.map)?;
        let means = &sky.means;
        let fluence = ImageInfiniteLightError::fluence(&sky.image, means.color, 4.0 * PI, scale)?;
        if !means.average.is_finite() {
            return Err(ImageInfiniteLightError::TooBright);
        }
        Ok(Self {
            transform,
            extent: InfiniteBounds {
                fluence,
                mean: transform.vector(means.direction),
                cone: DirectionCone::WHOLE_SPHERE,
            },
            sky,
            scale,
            scene,
            color: PhantomData,
        })
    }

    /// The numbers by which directions are chosen, copied for a sampler elsewhere, as a shader;
    /// `None` if the picture is black.
    #[must_use]
    pub fn table(&self, coverage: PdfCoverage) -> Option<EnvironmentTable> {
        self.sky.table(coverage)
    }

    /// The radiance in W m^-2 sr^-1 from the directions of the texel in column `x` and row `y`;
    /// beyond the edge, of the one nearest to it.
    #[must_use]
    pub fn texel_radiance(&self, [x, y]: [u32; 2], wavelengths: &C::Wavelengths) -> C::Radiance {
        self.radiance(self.sky.image.texel(x, y), wavelengths)
    }

    /// How the light is turned; its origin does not count.
    #[must_use]
    pub const fn transform(&self) -> &RigidTransform {
        &self.transform
    }

    pub(crate) fn image(&self) -> &Image {
        &self.sky.image
    }

    pub(crate) fn table_bytes(&self) -> usize {
        self.sky.table_bytes()
    }

    /// Address of the tables, the same for clones.
    pub(crate) fn table_address(&self) -> usize {
        Arc::as_ptr(&self.sky).addr()
    }

    fn radiance(&self, texel: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        C::emit_texel(texel, wavelengths) * self.scale
    }

    /// The density of the direction `wi` toward the light.
    fn pdf(&self, wi: Vec3, coverage: PdfCoverage) -> f32 {
        self.sky.pdf(self.transform.inverse_vector(wi), coverage)
    }
}

impl<C: ColorModel> ImageInfiniteLight<C> {
    pub(crate) fn light_power(&self) -> LightPower<'_, C> {
        let etendue = 4.0 * PI * self.scene.disk_area() * self.scale;
        LightPower::of_texel(self.sky.means.color, etendue)
    }
}

impl<C: ColorModel> Light<C> for ImageInfiniteLight<C> {
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
        coverage: PdfCoverage,
    ) -> Option<LightLiSample<C::Radiance>> {
        let sample = self.sky.sample(u, coverage, &self.transform)?;
        Some(LightLiSample {
            l: self.radiance(sample.texel, wavelengths),
            wi: sample.wi,
            pdf: sample.pdf,
            p_light: self.scene.beyond(ctx.p, sample.wi),
            n_light: Vec3::ZERO,
            uv: sample.uv,
        })
    }

    fn pdf_li(&self, _ctx: &LightSampleContext, wi: Vec3, coverage: PdfCoverage) -> f32 {
        self.pdf(wi, coverage)
    }

    /// The direction is chosen by `u1`, the point on a disk of the scene's radius by `u2`.
    fn sample_le(
        &self,
        u1: Vec2,
        u2: Vec2,
        wavelengths: &C::Wavelengths,
    ) -> Option<LightLeSample<C::Radiance>> {
        let sample = self
            .sky
            .sample(u1, PdfCoverage::Complete, &self.transform)?;
        Some(LightLeSample {
            l: self.radiance(sample.texel, wavelengths),
            ray: ray_through_scene(&self.scene, -sample.wi, u2),
            pdf: LePdf {
                pos: 1.0 / self.scene.disk_area(),
                dir: sample.pdf,
            },
        })
    }

    fn pdf_le(&self, ray: &EmittedRay) -> LePdf {
        LePdf {
            pos: 1.0 / self.scene.disk_area(),
            dir: self.pdf(-ray.direction, PdfCoverage::Complete),
        }
    }

    fn extent(&self) -> LightExtent {
        self.extent.into()
    }
}

impl<C: ColorModel> InfiniteLight<C> for ImageInfiniteLight<C> {
    fn le(&self, _origin: Vec3, direction: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        let texel = self.sky.texel(self.transform.inverse_vector(direction));
        self.radiance(texel, wavelengths)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::amount::RadianceAmount;
    use crate::channels::Channels;
    use crate::glam::Affine3A;
    use crate::rgb::Rgb;

    #[test]
    fn a_constant_sky_is_sampled_evenly_when_samples_may_leave_out_directions() {
        let texels = alloc::vec![0.3; 16];
        let image = Image::from_f32([4, 4], Channels::Gray, texels).expect("an image");
        let light = ImageInfiniteLight::<Rgb>::new(
            ImageInfiniteLightDesc {
                map: EnvironmentMap::EqualArea(image),
                transform: Affine3A::IDENTITY,
                amount: RadianceAmount::default(),
            },
            SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere"),
        )
        .expect("a sky");
        let ctx = LightSampleContext::medium(Vec3::ZERO);
        for coverage in [PdfCoverage::Complete, PdfCoverage::Incomplete] {
            for u in [Vec2::ZERO, Vec2::splat(0.3), Vec2::splat(0.99)] {
                let sample = light.sample_li(&ctx, u, &(), coverage).expect("a sample");
                assert!((sample.pdf * 4.0 * PI - 1.0).abs() < 1e-5, "{sample:?}");
                assert_eq!(light.pdf_li(&ctx, sample.wi, coverage), sample.pdf, "{u}");
            }
        }
    }
}
