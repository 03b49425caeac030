use core::error::Error;
use core::fmt;

use crate::amount::RadianceAmount;
use crate::glam::{Affine3A, Vec3};
use crate::image::Image;
use crate::resample::equal_area_size;
use crate::rigid_transform::RigidTransformError;
use light_math::SphereMap;

/// An [`ImageInfiniteLight`](crate::ImageInfiniteLight) as a user describes it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ImageInfiniteLightDesc {
    /// From light space to the scene; only its rotation counts.
    pub transform: Affine3A,
    /// The picture of the sky.
    pub map: EnvironmentMap,
    /// Amount of light, as a factor of the picture.
    pub amount: RadianceAmount,
}

impl ImageInfiniteLightDesc {
    /// The sky of `map` in light space, its texels in W m^-2 sr^-1: white of 1 has 683 nit in
    /// [`Rgb`](crate::Rgb). In [`Spectral`](crate::Spectral) texels are per nanometre, and white has
    /// 72,982 nit: the amount `Luminance(Nit(683.0))` makes the same sky in both.
    #[must_use]
    pub fn new(map: EnvironmentMap) -> Self {
        Self {
            transform: Affine3A::IDENTITY,
            map,
            amount: RadianceAmount::default(),
        }
    }
}

/// An image of all directions, with its map.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum EnvironmentMap {
    /// A square, by [`equal_area`](light_math::equal_area).
    EqualArea(Image),
    /// A rectangle of any shape, by [`lat_long`](light_math::lat_long); its texels are sampled and
    /// looked up as they are.
    LatLong(Image),
}

impl EnvironmentMap {
    /// This map as an equal-area one, resampled if it is another: the form of pbrt's files, and the
    /// one that a [`PortalInfiniteLight`](crate::PortalInfiniteLight) reads.
    ///
    /// # Errors
    /// When an equal-area image is not square, or texels are too bright to be summed.
    pub fn into_equal_area(self) -> Result<Self, ImageInfiniteLightError> {
        self.into_equal_area_image().map(Self::EqualArea)
    }

    /// How the image lies around the sphere.
    #[must_use]
    pub const fn sphere_map(&self) -> SphereMap {
        match self {
            Self::EqualArea(_) => SphereMap::EqualArea,
            Self::LatLong(_) => SphereMap::LatLong,
        }
    }

    pub(crate) fn into_equal_area_image(self) -> Result<Image, ImageInfiniteLightError> {
        match self {
            Self::EqualArea(image) if image.size()[0] != image.size()[1] => {
                Err(ImageInfiniteLightError::NotSquare)
            }
            Self::EqualArea(image) => Ok(image),
            Self::LatLong(image) => {
                let n = equal_area_size(image.size()[1]);
                image
                    .resampled(SphereMap::LatLong, SphereMap::EqualArea, [n, n])
                    .map_err(|_| ImageInfiniteLightError::TooBright)
            }
        }
    }
}

/// Why the description of an environment light is invalid; each variant names a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ImageInfiniteLightError {
    /// `transform` is not rigid.
    Transform(RigidTransformError),
    /// `map` is an equal-area image that is not square.
    NotSquare,
    /// `map` is so bright that its integral over the sphere is not finite.
    TooBright,
    /// `amount` is negative, not finite, or so large that the integral or a texel of `map` is not
    /// finite.
    Amount,
}

impl ImageInfiniteLightError {
    /// With less fluence no texel of a map that fits into memory is too bright: each has more than
    /// 1e-18 of the sphere.
    const HARMLESS: f32 = 1e20;

    /// The fluence of a map with this mean over a solid angle, if it and each texel are finite,
    /// scaled.
    pub(crate) fn fluence(
        image: &Image,
        mean: Vec3,
        solid_angle: f32,
        scale: f32,
    ) -> Result<f32, Self> {
        if !mean.is_finite() {
            return Err(Self::TooBright);
        }
        if !(scale >= 0.0 && scale.is_finite()) {
            return Err(Self::Amount);
        }
        let fluence = solid_angle * scale * mean.max_element();
        let is_finite = |texel: Vec3| (texel * scale).is_finite();
        let fits = fluence < Self::HARMLESS
            || fluence.is_finite() && (scale <= 1.0 || image.texels().all(is_finite));
        match fits {
            true => Ok(fluence),
            false if scale <= 1.0 => Err(Self::TooBright),
            false => Err(Self::Amount),
        }
    }
}

impl fmt::Display for ImageInfiniteLightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Transform(error) => error.fmt(f),
            Self::NotSquare => f.write_str("map: an equal-area image must be square"),
            Self::TooBright => {
                f.write_str("map: too bright, its sum over all directions is not finite")
            }
            Self::Amount => f.write_str(
                "amount: must be finite, not negative, and leave what the map gives finite",
            ),
        }
    }
}

impl Error for ImageInfiniteLightError {}

impl From<RigidTransformError> for ImageInfiniteLightError {
    fn from(error: RigidTransformError) -> Self {
        Self::Transform(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::channels::Channels;
    use crate::image_infinite::ImageInfiniteLight;
    use crate::portal_infinite::PortalInfiniteLight;
    use crate::portal_infinite_desc::{PortalInfiniteLightDesc, PortalInfiniteLightError};
    use crate::rgb::Rgb;
    use crate::scene_sphere::SceneSphere;

    /// A sky `scale` times as bright as its picture, alone and behind a portal.
    fn refusals(map: &EnvironmentMap, scale: f32) -> [Option<ImageInfiniteLightError>; 2] {
        let scene = SceneSphere::new(Vec3::ZERO, 1e-3).expect("a sphere");
        let (map, amount) = (map.clone(), RadianceAmount::Radiometric(scale));
        let portal = PortalInfiniteLightDesc {
            transform: Affine3A::IDENTITY,
            map: map.clone(),
            amount,
            portal: [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y],
        };
        let portal = PortalInfiniteLight::<Rgb>::new(portal, scene).err();
        let portal = portal.map(|error| match error {
            PortalInfiniteLightError::Sky(error) => error,
            error => unreachable!("{error}"),
        });
        let sky = ImageInfiniteLightDesc {
            amount,
            ..ImageInfiniteLightDesc::new(map)
        };
        [ImageInfiniteLight::<Rgb>::new(sky, scene).err(), portal]
    }

    fn gray(size: [u32; 2], texels: &[f32]) -> Image {
        Image::from_f32(size, Channels::Gray, texels).expect("an image")
    }

    #[test]
    fn skies_of_infinite_fluence_are_refused() {
        let [bright, huge] = [1e37, 1e38].map(|texel| gray([4, 4], &[texel; 16]));
        let too_bright = Some(ImageInfiniteLightError::TooBright);
        let amount = Some(ImageInfiniteLightError::Amount);
        for map in [EnvironmentMap::EqualArea, EnvironmentMap::LatLong] {
            let of = |image: &Image, scale| refusals(&map(image.clone()), scale)[0];
            assert_eq!(of(&bright, 1.0), None, "1.3e38");
            assert_eq!(of(&huge, 1e-3), None, "1.3e36");
            assert_eq!(of(&huge, 1.0), too_bright, "1.3e39");
            assert_eq!(of(&bright, 100.0), amount, "1.3e40");
        }
        let of =
            |image: &Image, scale| refusals(&EnvironmentMap::EqualArea(image.clone()), scale)[1];
        assert_eq!(of(&bright, 1.0), None, "6e37 through a portal");
        assert_eq!(of(&huge, 1.0), too_bright, "6e38");
        assert_eq!(of(&bright, 100.0), amount, "6e39");
    }

    /// One texel of many: their integral is finite, its radiance is not.
    #[test]
    fn skies_with_an_infinite_texel_are_refused() {
        let mut texels = [0.0; 64 * 64];
        texels[2000] = 1e35;
        let map = EnvironmentMap::EqualArea(gray([64, 64], &texels));
        assert_eq!(refusals(&map, 1e3)[0], None, "1e38");
        let amount = Some(ImageInfiniteLightError::Amount);
        assert_eq!(refusals(&map, 5e3)[0], amount, "5e38");
    }
}
