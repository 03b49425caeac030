use crate::environment_table::EnvironmentTable;
use crate::equal_area_sky::EqualAreaSky;
use crate::glam::{Vec2, Vec3};
use crate::image::Image;
use crate::image_infinite_desc::{EnvironmentMap, ImageInfiniteLightError};
use crate::lat_long_sky::LatLongSky;
use crate::pdf_coverage::PdfCoverage;
use crate::rigid_transform::RigidTransform;
use crate::sky_means::SkyMeans;
use crate::sky_sample::SkySample;
use light_math::SphereMap;

/// What depends on the picture of a sky alone, not on how it is turned or scaled.
#[derive(Debug)]
pub(crate) struct ImageSky {
    pub(crate) image: Image,
    pub(crate) means: SkyMeans,
    directions: Directions,
}

/// Directions in proportion to texels, by the map of the picture.
#[derive(Debug)]
enum Directions {
    EqualArea(EqualAreaSky),
    LatLong(LatLongSky),
}

impl ImageSky {
    pub(crate) fn new(map: EnvironmentMap) -> Result<Self, ImageInfiniteLightError> {
        let (image, (directions, means)) = match map {
            EnvironmentMap::EqualArea(image) => {
                let [width, height] = image.size();
                if width != height {
                    return Err(ImageInfiniteLightError::NotSquare);
                }
                let (sky, means) = EqualAreaSky::new(&image);
                (image, (Directions::EqualArea(sky), means))
            }
            EnvironmentMap::LatLong(image) => {
                let (sky, means) = LatLongSky::new(&image);
                (image, (Directions::LatLong(sky), means))
            }
        };
        Ok(Self {
            image,
            means,
            directions,
        })
    }

    /// Whether this is the sky of `map`, which shares its picture.
    pub(crate) fn is_of(&self, map: &EnvironmentMap) -> bool {
        let (EnvironmentMap::EqualArea(image) | EnvironmentMap::LatLong(image)) = map;
        self.map() == map.sphere_map() && image.is_clone_of(&self.image)
    }

    fn map(&self) -> SphereMap {
        match self.directions {
            Directions::EqualArea(_) => SphereMap::EqualArea,
            Directions::LatLong(_) => SphereMap::LatLong,
        }
    }

    pub(crate) fn table_bytes(&self) -> usize {
        match &self.directions {
            Directions::EqualArea(sky) => sky.bytes(),
            Directions::LatLong(sky) => sky.bytes(),
        }
    }

    /// The numbers of [`sample`](Self::sample); `None` if the picture is black.
    pub(crate) fn table(&self, coverage: PdfCoverage) -> Option<EnvironmentTable> {
        match &self.directions {
            Directions::EqualArea(sky) => sky.table(coverage),
            Directions::LatLong(sky) => sky.table(&self.image, coverage),
        }
    }

    /// The texel of the direction `w`, in light space.
    pub(crate) fn texel(&self, w: Vec3) -> Vec3 {
        self.image.nearest(self.map().point(w))
    }

    /// A direction in the scene, chosen by `u`; `None` if the picture is black.
    pub(crate) fn sample(
        &self,
        u: Vec2,
        coverage: PdfCoverage,
        transform: &RigidTransform,
    ) -> Option<SkySample> {
        match &self.directions {
            Directions::EqualArea(sky) => sky.sample(&self.image, u, coverage, transform),
            Directions::LatLong(sky) => sky.sample(&self.image, u, coverage, transform),
        }
    }

    /// The density in sr^-1 of the direction `w`, in light space.
    pub(crate) fn pdf(&self, w: Vec3, coverage: PdfCoverage) -> f32 {
        match &self.directions {
            Directions::EqualArea(sky) => sky.pdf(w, coverage),
            Directions::LatLong(sky) => sky.pdf(self.texel(w), coverage),
        }
    }
}
