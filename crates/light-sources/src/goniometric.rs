use core::error::Error;
use core::f32::consts::PI;
use core::fmt;

use crate::amount::IntensityAmount;
use crate::channels::Channels;
use crate::color::ColorModel;
use crate::emission_lobe::{Emitted, emission_lobe};
use crate::glam::{Affine3A, Vec2, Vec3};
use crate::image::Image;
use crate::light_power::LightPower;
use crate::medium_interface::MediumInterface;
use crate::point_source::{DirectionSample, PointSource};
use crate::rigid_transform::{RigidTransform, RigidTransformError};
use crate::scaled_emission::{EmissionError, ScaledEmission};
use crate::sphere_table::{SphereSample, SphereTable};
use light_bounds::{EmissionLobe, LightBounds};
use light_math::Aabb;
use light_math::equal_area::{sphere_to_square, square_to_sphere};

/// A [`GoniometricLight`] as a user describes it.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub struct GoniometricLightDesc<C: ColorModel> {
    /// From light space to the scene.
    pub transform: Affine3A,
    /// The relative intensity by direction: a grey square image, by
    /// [`equal_area`](light_math::equal_area).
    pub distribution: Image,
    /// Colour of the light.
    pub emission: C::Emission,
    /// Amount of light, where the distribution is 1.
    pub amount: IntensityAmount,
    /// The medium around it, `outside`.
    pub media: MediumInterface,
}

impl<C: ColorModel> GoniometricLightDesc<C> {
    /// A light of the relative intensities of `distribution`, a grey square image by
    /// [`equal_area`](light_math::equal_area), in vacuum.
    #[must_use]
    pub fn new(
        transform: Affine3A,
        distribution: Image,
        emission: C::Emission,
        amount: IntensityAmount,
    ) -> Self {
        Self {
            transform,
            distribution,
            emission,
            amount,
            media: MediumInterface::default(),
        }
    }
}

/// A point light with a measured distribution of intensity.
///
/// # Source
/// `[PBRT4]`, section 12.2.3.
#[derive(Clone, Debug)]
pub struct GoniometricLight<C: ColorModel> {
    transform: RigidTransform,
    image: Image,
    mean: f32,
    lobe: EmissionLobe,
    table: SphereTable,
    intensity: ScaledEmission<C>,
    media: MediumInterface,
}

/// Why the description of a goniometric light is invalid; each variant names a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GoniometricLightError {
    /// `transform` is not rigid.
    Transform(RigidTransformError),
    /// `distribution` is not square.
    NotSquare,
    /// `distribution` has colours.
    NotGray,
    /// `emission` or `amount` is invalid, or the amount is too large for the distribution.
    Emission(EmissionError),
}

/// The least number of parts along each axis for the mean direction.
const PARTS: u32 = 32;

impl<C: ColorModel> GoniometricLight<C> {
    /// The light that `desc` describes.
    ///
    /// # Errors
    /// When a field of `desc` is invalid.
    pub fn new(desc: GoniometricLightDesc<C>) -> Result<Self, GoniometricLightError> {
        let transform = RigidTransform::new(desc.transform)?;
        let image = desc.distribution;
        let [width, height] = image.size();
        if width != height {
            return Err(GoniometricLightError::NotSquare);
        }
        if image.channels() != Channels::Gray {
            return Err(GoniometricLightError::NotGray);
        }
        let mean = image.mean().x;
        let full = C::flux(&desc.emission);
        let scale = desc.amount.scale(full, full * (4.0 * PI * mean))?;
        let intensity = ScaledEmission::new(desc.emission, scale)?;
        let brightest = image.texels().fold(0.0, |max: f32, texel| max.max(texel.x));
        if !(brightest * intensity.maximum()).is_finite() {
            return Err(EmissionError::Amount.into());
        }
        if !(4.0 * PI * intensity.maximum() * mean).is_finite() {
            return Err(EmissionError::Power.into());
        }
        // Texels of a coarse image are divided, so that a part has nearly one direction.
        let parts = PARTS.div_ceil(width);
        let rows = width * parts;
        let solid_angle = 4.0 * PI / (rows as f32 * rows as f32);
        let lobe = emission_lobe(|| {
            let places = (0..rows).flat_map(|y| (0..rows).map(move |x| [x, y]));
            places.map(|[x, y]| {
                let place = (Vec2::new(x as f32, y as f32) + 0.5) / rows as f32;
                Emitted {
                    w: transform.vector(square_to_sphere(place)),
                    intensity: image.texel(x / parts, y / parts).x * intensity.maximum(),
                    solid_angle,
                }
            })
        });
        Ok(Self {
            transform,
            mean,
            lobe,
            table: SphereTable::new(&image.averages(), width),
            image,
            intensity,
            media: desc.media,
        })
    }

    pub(crate) const fn image(&self) -> &Image {
        &self.image
    }

    pub(crate) fn table_bytes(&self) -> usize {
        self.table.bytes()
    }
}

impl<C: ColorModel> GoniometricLight<C> {
    pub(crate) fn light_power(&self) -> LightPower<'_, C> {
        LightPower::of_emission(&self.intensity, 4.0 * PI * self.mean)
    }
}

impl<C: ColorModel> PointSource for GoniometricLight<C> {
    type Color = C;

    fn position(&self) -> Vec3 {
        self.transform.origin()
    }

    fn intensity(&self, w: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        let uv = sphere_to_square(self.transform.inverse_vector(w));
        self.intensity.at(wavelengths) * self.image.nearest(uv).x
    }

    fn power(&self, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.light_power().at(wavelengths)
    }

    /// In proportion to the intensity, by `u1`.
    fn sample_direction(
        &self,
        u1: Vec2,
        _u2: Vec2,
        wavelengths: &C::Wavelengths,
    ) -> Option<DirectionSample<C::Radiance>> {
        let sample = self.table.sample(u1, &self.transform)?;
        let SphereSample { w, pdf, texel, .. } = sample;
        let [x, y] = texel;
        Some(DirectionSample {
            w,
            intensity: self.intensity.at(wavelengths) * self.image.texel(x, y).x,
            pdf,
        })
    }

    fn direction_pdf(&self, w: Vec3) -> f32 {
        self.table.pdf(self.transform.inverse_vector(w))
    }

    fn point_bounds(&self) -> LightBounds {
        LightBounds {
            bounds: Aabb::from_point(self.transform.origin()),
            w: Vec3::Z,
            phi: 4.0 * PI * self.intensity.maximum() * self.mean,
            cos_theta_o: -1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        }
    }

    fn lobe(&self) -> Option<EmissionLobe> {
        Some(self.lobe)
    }

    fn surroundings(&self) -> MediumInterface {
        self.media
    }
}

impl fmt::Display for GoniometricLightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Transform(error) => error.fmt(f),
            Self::NotSquare => f.write_str("distribution: an equal-area image must be square"),
            Self::NotGray => f.write_str("distribution: must have one channel"),
            Self::Emission(error) => error.fmt(f),
        }
    }
}

impl Error for GoniometricLightError {}

impl From<RigidTransformError> for GoniometricLightError {
    fn from(error: RigidTransformError) -> Self {
        Self::Transform(error)
    }
}

impl From<EmissionError> for GoniometricLightError {
    fn from(error: EmissionError) -> Self {
        Self::Emission(error)
    }
}
