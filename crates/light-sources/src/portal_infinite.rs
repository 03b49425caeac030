use alloc::vec::Vec;
use core::marker::PhantomData;

use crate::channels::Channels;
use crate::color::{ColorModel, Radiance};
use crate::glam::{Vec2, Vec3};
use crate::image::Image;
use crate::image_infinite_desc::ImageInfiniteLightError;
use crate::light::{InfiniteLight, Light};
use crate::light_power::LightPower;
use crate::light_sample::{EmittedRay, LePdf, LightLeSample, LightLiSample};
use crate::light_type::LightType;
use crate::pdf_coverage::PdfCoverage;
use crate::portal::Portal;
use crate::portal_infinite_desc::{PortalInfiniteLightDesc, PortalInfiniteLightError};
use crate::rgb_sum::RgbSum;
use crate::rigid_transform::RigidTransform;
use crate::scene_sphere::SceneSphere;
use light_bounds::{InfiniteBounds, LightExtent, LightSampleContext};
use light_math::distribution::{Sample2D, SummedAreaTable, Window, WindowedPiecewiseConstant2D};
use light_math::{DirectionCone, SphereImage, SphereMap};

/// An environment map that is visible through one rectangle only, such as a window.
///
/// The picture is resampled into a square in which the portal, seen from anywhere, is a rectangle
/// with sides along the axes; a point then samples only the part of the sky that it sees. Unlike an
/// [`ImageInfiniteLight`](crate::ImageInfiniteLight), which samples the texels of its picture as
/// they are, this light has the texels of its [own map](Self::rectified): a sun of one texel is
/// spread over its neighbours there. A lat-long picture becomes an
/// [equal-area one](crate::EnvironmentMap::into_equal_area) first.
///
/// # Source
/// `[Bitterli2015]`; `[PBRT4]`, section 12.5.3. Rays that leave the light start on the portal, not
/// all around the scene, so that none is wasted, and the power includes the cosine at the portal.
#[derive(Clone, Debug)]
pub struct PortalInfiniteLight<C> {
    portal: Portal,
    image: Image,
    scale: f32,
    /// Integral of the picture's colour times the cosine at the portal.
    irradiance: Vec3,
    scene: SceneSphere,
    extent: InfiniteBounds,
    /// `None` when the picture is black.
    table: Option<WindowedPiecewiseConstant2D<Vec<u64>>>,
    color: PhantomData<C>,
}

/// No rays are emitted at cosines to the portal's normal below this: their density has no digits
/// left.
const LEAST_COSINE: f32 = 1e-4;

impl<C: ColorModel> PortalInfiniteLight<C> {
    /// The light that `desc` describes, over the given scene.
    ///
    /// # Errors
    /// When a field of `desc` is invalid.
    pub fn new(
        desc: PortalInfiniteLightDesc,
        scene: SceneSphere,
    ) -> Result<Self, PortalInfiniteLightError> {
        let scale = desc.amount.scale(C::flux_of_texel(Vec3::ONE));
        let scale = scale.map_err(|_| ImageInfiniteLightError::Amount)?;
        let transform =
            RigidTransform::new(desc.transform).map_err(ImageInfiniteLightError::from)?;
        let sky = desc.map.into_equal_area_image()?;
        let portal = Portal::new(desc.portal)
            .filter(|portal| (1.0 / (portal.area() * LEAST_COSINE)).is_finite())
            .ok_or(PortalInfiniteLightError::Portal)?;

        // The sky in the portal's own map, and its integrals over the half space in front.
        let [n, _] = sky.size();
        let sky = SphereImage::new(SphereMap::EqualArea, sky.size(), |x, y| sky.texel(x, y))
            .map_err(|_| ImageInfiniteLightError::NotSquare)?;
        let mut texels = Vec::new();
        let mut weights = Vec::new();
        let ([mut irradiance, mut mean, mut color], mut total) = ([RgbSum::default(); 3], 0.0);
        for y in 0..n {
            for x in 0..n {
                let uv = (Vec2::new(x as f32, y as f32) + 0.5) / n as f32;
                let (w, solid_angle) = portal.direction(uv);
                let texel = sky.bilinear(transform.inverse_vector(w));
                let weight = texel.average() * solid_angle;
                let (direction, exact) = Portal::texel_integrals([x, y], n);
                irradiance.add(texel, direction.z);
                color.add(texel, exact);
                let average = f64::from(texel.average());
                mean.add(portal.frame().from_local(direction.as_vec3()), average);
                total += average * exact;
                texels.extend_from_slice(&texel.to_array());
                weights.push(weight);
            }
        }
        let (irradiance, color) = (irradiance.over(1.0), color.over(1.0));
        let size = sky.size();
        let image = Image::from_f32(size, Channels::Rgb, texels)
            .map_err(|_| ImageInfiniteLightError::TooBright)?;
        let table = SummedAreaTable::new(&weights, size[0] as usize, size[1] as usize);
        Ok(Self {
            extent: InfiniteBounds {
                fluence: ImageInfiniteLightError::fluence(&image, color, 1.0, scale)?,
                mean: mean.over(total),
                cone: DirectionCone::new(portal.frame().z, 0.0),
            },
            portal,
            image,
            scale,
            irradiance,
            scene,
            table: table.ok().map(WindowedPiecewiseConstant2D::new),
            color: PhantomData,
        })
    }

    /// The sky in the portal's own map, a square.
    #[must_use]
    pub const fn rectified(&self) -> &Image {
        &self.image
    }

    /// A sum for each texel.
    pub(crate) fn table_bytes(&self) -> usize {
        let [width, height] = self.image.size().map(|n| n as usize);
        self.table
            .as_ref()
            .map_or(0, |_| width * height * size_of::<u64>())
    }

    pub(crate) fn light_power(&self) -> LightPower<'_, C> {
        LightPower::of_texel(self.irradiance, self.portal.area() * self.scale)
    }

    fn radiance(&self, uv: Vec2, wavelengths: &C::Wavelengths) -> C::Radiance {
        C::emit_texel(self.image.nearest(uv), wavelengths) * self.scale
    }

    /// A direction toward the sky in `window`, chosen by `u`, with its point in the map and its
    /// density: those of the rounded direction, which may be on a neighbouring texel.
    fn sample_direction(&self, u: Vec2, window: &Window) -> Option<(Vec2, Vec3, f32)> {
        let Sample2D { p, .. } = self.table.as_ref()?.sample(u, window)?;
        let (wi, _) = self.portal.direction(p);
        let (uv, pdf) = self.look_up(wi, window)?;
        (pdf > 0.0).then_some((uv, wi, pdf))
    }

    /// Where a direction lies in the map, and its density among those of `window`.
    fn look_up(&self, wi: Vec3, window: &Window) -> Option<(Vec2, f32)> {
        let (uv, solid_angle) = self.portal.uv(wi)?;
        let inside = nearest_inside(uv, window)?;
        let pdf = self.table.as_ref()?.pdf(inside, window) / solid_angle;
        pdf.is_finite().then_some((inside, pdf))
    }

    /// The density of [`sample_direction`](Self::sample_direction).
    fn pdf_direction(&self, wi: Vec3, window: &Window) -> f32 {
        self.look_up(wi, window).map_or(0.0, |(_, pdf)| pdf)
    }

    /// Density of a ray's origin on the portal, per area across the ray; 0 along the portal, which
    /// no ray passes.
    fn pdf_position(&self, direction: Vec3) -> f32 {
        let cos_theta = self.portal.frame().z.dot(direction).abs();
        if cos_theta > LEAST_COSINE {
            1.0 / (self.portal.area() * cos_theta)
        } else {
            0.0
        }
    }
}

/// `uv` clamped to a window; `None` if it is farther outside than the rounding of a direction.
fn nearest_inside(uv: Vec2, window: &Window) -> Option<Vec2> {
    let inside = uv.clamp(window.min, window.max);
    (uv.distance(inside) <= 8.0 * f32::EPSILON).then_some(inside)
}

impl<C: ColorModel> Light<C> for PortalInfiniteLight<C> {
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
        let window = self.portal.window(ctx.p)?;
        let (uv, wi, pdf) = self.sample_direction(u, &window)?;
        Some(LightLiSample {
            l: self.radiance(uv, wavelengths),
            wi,
            pdf,
            p_light: self.scene.beyond(ctx.p, wi),
            n_light: Vec3::ZERO,
            uv,
        })
    }

    fn pdf_li(&self, ctx: &LightSampleContext, wi: Vec3, _coverage: PdfCoverage) -> f32 {
        let window = self.portal.window(ctx.p);
        window.map_or(0.0, |window| self.pdf_direction(wi, &window))
    }

    /// The direction is chosen by `u1` from the whole half space, the place on the portal by `u2`;
    /// the ray starts before it, outside of the scene.
    fn sample_le(
        &self,
        u1: Vec2,
        u2: Vec2,
        wavelengths: &C::Wavelengths,
    ) -> Option<LightLeSample<C::Radiance>> {
        let (uv, wi, pdf) = self.sample_direction(u1, &Window::UNIT)?;
        let pos = self.pdf_position(wi);
        if pos == 0.0 {
            return None;
        }
        let on_portal = self.portal.point(u2);
        let away = self.scene.radius() + on_portal.distance(self.scene.center());
        Some(LightLeSample {
            l: self.radiance(uv, wavelengths),
            ray: EmittedRay::from_point(on_portal + wi * away, -wi),
            pdf: LePdf { pos, dir: pdf },
        })
    }

    fn pdf_le(&self, ray: &EmittedRay) -> LePdf {
        let is_through = self.portal.is_on_line(ray.origin, ray.direction);
        LePdf {
            pos: if is_through {
                self.pdf_position(ray.direction)
            } else {
                0.0
            },
            dir: self.pdf_direction(-ray.direction, &Window::UNIT),
        }
    }

    fn extent(&self) -> LightExtent {
        self.extent.into()
    }
}

impl<C: ColorModel> InfiniteLight<C> for PortalInfiniteLight<C> {
    fn le(&self, origin: Vec3, direction: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        let uv = self.portal.uv(direction).map(|(uv, _)| uv);
        let inside = uv.zip(self.portal.window(origin));
        let inside = inside.and_then(|(uv, window)| nearest_inside(uv, &window));
        inside.map_or(C::Radiance::BLACK, |uv| self.radiance(uv, wavelengths))
    }
}
