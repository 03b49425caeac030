use alloc::vec::Vec;
use core::error::Error;
use core::f32::consts::PI;
use core::fmt;
use core::marker::PhantomData;

use crate::amount::IntensityAmount;
use crate::color::{ColorModel, Radiance};
use crate::emission_lobe::{Emitted, emission_lobe};
use crate::glam::{Affine3A, Vec2, Vec3};
use crate::image::Image;
use crate::light_power::LightPower;
use crate::medium_interface::MediumInterface;
use crate::picture_grid::PictureGrid;
use crate::point_source::{DirectionSample, PointSource};
use crate::rgb_sum::{RgbSum, single};
use crate::rigid_transform::{RigidTransform, RigidTransformError};
use crate::scaled_emission::EmissionError;
use light_bounds::{EmissionLobe, LightBounds};
use light_math::Aabb;
use light_math::distribution::{PiecewiseConstant2D, Sample2D};
use light_math::float::{sqrt, tan};

/// A [`ProjectionLight`] as a user describes it.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ProjectionLightDesc {
    /// From light space, where the light is at the origin and emits along +z, to scene space.
    pub transform: Affine3A,
    /// The picture; its texel (0, 0) is projected to the smallest x and y.
    pub image: Image,
    /// Angle that the shorter side of the picture spans, in `(0, pi)`.
    pub fov: f32,
    /// Amount of light, as a factor of the picture.
    pub amount: IntensityAmount,
    /// The medium around it, `outside`.
    pub media: MediumInterface,
}

impl ProjectionLightDesc {
    /// A projector of `image` along +z of `transform`, whose shorter side spans the angle `fov` in
    /// `(0, pi)`, in vacuum.
    #[must_use]
    pub fn new(transform: Affine3A, image: Image, fov: f32, amount: IntensityAmount) -> Self {
        Self {
            transform,
            image,
            fov,
            amount,
            media: MediumInterface::default(),
        }
    }
}

/// A point light that projects a picture: a slide projector.
///
/// # Source
/// `[PBRT4]`, section 12.2.2. A direction `w` meets the plane z = 1 at `(w.x, w.y) / w.z`; the
/// picture fills a rectangle of that plane around the axis.
#[derive(Clone, Debug)]
pub struct ProjectionLight<C> {
    transform: RigidTransform,
    image: Image,
    scale: f32,
    /// Half width and half height of the picture on the plane z = 1.
    half: Vec2,
    /// Sum over the texels of colour times solid angle, in W/sr times sr for a scale of 1.
    power: Vec3,
    extent: LightBounds,
    lobe: EmissionLobe,
    /// Over the rectangle on the plane; `None` when the picture is black.
    table: Option<PiecewiseConstant2D<Vec<f32>>>,
    media: MediumInterface,
    color: PhantomData<C>,
}

/// The largest accepted rounding error of a point of the picture, relative to half its shorter
/// side.
const RESOLVED: f32 = 0.125;

/// Why the description of a projection light is invalid; each variant names a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ProjectionLightError {
    /// `transform` is not rigid.
    Transform(RigidTransformError),
    /// `fov` does not lie in `(0, pi)`, or so near to an end that single precision has no picture:
    /// its size is infinite, or below the rounding of directions.
    Fov,
    /// `amount` is negative, not finite, or too large for the picture.
    Emission(EmissionError),
}

impl<C: ColorModel> ProjectionLight<C> {
    /// The light that `desc` describes.
    ///
    /// # Errors
    /// When a field of `desc` is invalid.
    pub fn new(desc: ProjectionLightDesc) -> Result<Self, ProjectionLightError> {
        let transform = RigidTransform::new(desc.transform)?;
        let image = desc.image;
        let [width, height] = image.size().map(|n| n as f32);
        let half = Vec2::new(width, height) * (tan(0.5 * desc.fov) / width.min(height));
        let area = 4.0 * half.x * half.y;
        // Refuses a picture smaller than the rounding error of directions.
        let is_resolved = rounding_on_plane(half) <= RESOLVED * half.min_element();
        if !(desc.fov > 0.0 && desc.fov < PI && area.is_finite() && is_resolved) {
            return Err(ProjectionLightError::Fov);
        }

        // Each texel counts by its solid angle.
        let picture = PictureGrid::new(image.size(), half);
        let (mut power, mut maxima) = (RgbSum::default(), RgbSum::default());
        let mut weights = image.averages();
        for ((texel, texel_part), weight) in image.texels().zip(picture.texels()).zip(&mut weights)
        {
            // A density only needs the middles of texels.
            *weight *= solid_angle_per_area(texel_part.center);
            power.add(texel, texel_part.solid_angle);
            maxima.add(Vec3::splat(texel.max_element()), 1.0);
        }
        let mean_maximum = maxima.over(f64::from(width) * f64::from(height)).x;
        let power = power.over(1.0);
        let white = C::flux_of_texel(Vec3::ONE);
        let scale = desc.amount.scale(white, C::flux_of_texel(power))?;
        if !(scale >= 0.0 && (power * scale).is_finite() && (mean_maximum * scale).is_finite()) {
            return Err(EmissionError::Amount.into());
        }
        let lobe = emission_lobe(|| {
            picture.parts().map(|part| Emitted {
                w: transform.vector(part.center.extend(1.0).normalize()),
                intensity: image.texel(part.texel[0], part.texel[1]).max_element() * scale,
                solid_angle: single(part.solid_angle),
            })
        });
        let table =
            PiecewiseConstant2D::new(&weights, image.size()[0] as usize, image.size()[1] as usize);
        let table = table.and_then(|table| table.over(-half, half));
        Ok(Self {
            extent: LightBounds {
                bounds: Aabb::from_point(transform.origin()),
                w: transform.axis(),
                phi: mean_maximum * scale,
                cos_theta_o: 1.0,
                cos_theta_e: 1.0 / sqrt(1.0 + half.length_squared()),
                two_sided: false,
            },
            lobe,
            transform,
            image,
            scale,
            half,
            power,
            // The only remaining error is a black picture.
            table: table.ok(),
            media: desc.media,
            color: PhantomData,
        })
    }

    pub(crate) const fn image(&self) -> &Image {
        &self.image
    }

    pub(crate) fn table_bytes(&self) -> usize {
        let table = self.table.as_ref();
        table.map_or(0, |table| size_of_val(table.table()))
    }

    /// Intensity toward the point `p` of the plane z = 1, inside of the picture.
    fn picture(&self, p: Vec2, wavelengths: &C::Wavelengths) -> C::Radiance {
        let uv = 0.5 * (p / self.half) + 0.5;
        C::emit_texel(self.image.nearest(uv), wavelengths) * self.scale
    }

    /// The intersection of a direction away from the light with the plane z = 1.
    fn on_plane(&self, w: Vec3) -> Option<Vec2> {
        let w = self.transform.inverse_vector(w);
        (w.z > 0.0).then(|| w.truncate() / w.z)
    }

    /// The same, where that is on the picture, with the density of the direction. The picture is
    /// enlarged by the rounding error of the direction.
    fn on_picture(&self, w: Vec3) -> Option<(Vec2, f32)> {
        let p = self.on_plane(w)?;
        let inside = p.clamp(-self.half, self.half);
        let pdf = self.table.as_ref()?.pdf(inside) / solid_angle_per_area(inside);
        (p.distance(inside) <= rounding_on_plane(p)).then_some((inside, pdf))
    }
}

impl<C: ColorModel> ProjectionLight<C> {
    pub(crate) fn light_power(&self) -> LightPower<'_, C> {
        LightPower::of_texel(self.power, self.scale)
    }
}

impl<C: ColorModel> PointSource for ProjectionLight<C> {
    type Color = C;

    fn position(&self) -> Vec3 {
        self.transform.origin()
    }

    fn intensity(&self, w: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        // Nothing beyond the edge, where the bounds promise that none is.
        match self.on_plane(w) {
            Some(p) if p.abs().cmple(self.half).all() => self.picture(p, wavelengths),
            _ => C::Radiance::BLACK,
        }
    }

    fn power(&self, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.light_power().at(wavelengths)
    }

    /// In proportion to the intensity, by `u1`. Intensity and density are those of the rounded
    /// direction, which may be on a neighbour of the chosen texel.
    fn sample_direction(
        &self,
        u1: Vec2,
        _u2: Vec2,
        wavelengths: &C::Wavelengths,
    ) -> Option<DirectionSample<C::Radiance>> {
        let Sample2D { p, .. } = self.table.as_ref()?.sample(u1);
        let w = self.transform.vector(p.extend(1.0).normalize());
        let (p, pdf) = self.on_picture(w)?;
        (pdf > 0.0).then(|| DirectionSample {
            w,
            intensity: self.picture(p, wavelengths),
            pdf,
        })
    }

    fn direction_pdf(&self, w: Vec3) -> f32 {
        self.on_picture(w).map_or(0.0, |(_, pdf)| pdf)
    }

    fn point_bounds(&self) -> LightBounds {
        self.extent
    }

    fn lobe(&self) -> Option<EmissionLobe> {
        Some(self.lobe)
    }

    fn surroundings(&self) -> MediumInterface {
        self.media
    }
}

/// Rounding error of the intersection `p` of a direction with the plane z = 1.
fn rounding_on_plane(p: Vec2) -> f32 {
    8.0 * f32::EPSILON * (1.0 + p.length_squared())
}

/// Solid angle per area of the plane z = 1 at `p`: the cubed cosine of the angle to the axis.
fn solid_angle_per_area(p: Vec2) -> f32 {
    let cos_theta = 1.0 / sqrt(1.0 + p.length_squared());
    cos_theta * cos_theta * cos_theta
}

impl fmt::Display for ProjectionLightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Transform(error) => error.fmt(f),
            Self::Fov => f.write_str(
                "fov: must lie in (0, pi), not so near to an end that single precision has no picture",
            ),
            Self::Emission(error) => error.fmt(f),
        }
    }
}

impl Error for ProjectionLightError {}

impl From<RigidTransformError> for ProjectionLightError {
    fn from(error: RigidTransformError) -> Self {
        Self::Transform(error)
    }
}

impl From<EmissionError> for ProjectionLightError {
    fn from(error: EmissionError) -> Self {
        Self::Emission(error)
    }
}
