use alloc::vec::Vec;

use light_math::SphereMap;

/// The numbers by which an [`ImageInfiniteLight`](crate::ImageInfiniteLight) chooses directions,
/// for a sampler in another language, as a shader.
///
/// With `u` in `[0, 1)^2` the row is the last one of [`rows`](Self::rows) that begins at or below
/// `u.y`, the column the last one of that row of [`columns`](Self::columns) that begins at or below
/// `u.x`; the place in the texel is where `u` lies between the beginnings, the last of which is
/// followed by 1. All numbers of one map are 8 bytes a texel.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentTable {
    /// How the texels lie around the sphere.
    pub map: SphereMap,
    /// Columns and rows.
    pub size: [u32; 2],
    /// Where each texel begins in its row, as a share of the row: row by row.
    pub columns: Vec<f32>,
    /// Where each row begins, as a share of all.
    pub rows: Vec<f32>,
    /// The density in sr^-1 of the directions of each texel, row by row.
    pub densities: Vec<f32>,
    /// Of a lat-long map the shares of the sphere within the upper edges of the rows, from the pole
    /// to the first edge at or below the equator: `(1 - cos t) / 2` for the angle `t` from the
    /// pole. A place in a texel is even over these shares. Empty for an equal-area map, whose
    /// places are even over the picture.
    pub caps: Vec<f32>,
}

/// How far a direction moves on the square of equal areas, where it is rounded, turned and turned
/// back.
pub(crate) const ROUNDING: f32 = 2e-6;

/// The distances from the edge of a texel, on that square, that a direction is moved to.
pub(crate) const NUDGES: [f32; 3] = [2e-7, 6e-7, ROUNDING];

/// How much of its distance from the middle of its texel a direction keeps, one try after the
/// other, if rounding has moved it beyond an edge.
pub(crate) const INSETS: [f32; 3] = [0.999, 0.97, 0.5];

/// The numbers of samples toward an environment map, by name, for ports of them to another
/// language, for directions that rounding has moved beyond an edge of their texel: the distances
/// from the edge, on the square of equal areas, and how much of its distance from the middle of its
/// texel a direction keeps, one try after the other.
pub const ENVIRONMENT_CONSTANTS: [(&str, f32); 6] = [
    ("FIRST_INSET", INSETS[0]),
    ("FIRST_NUDGE", NUDGES[0]),
    ("SECOND_INSET", INSETS[1]),
    ("SECOND_NUDGE", NUDGES[1]),
    ("THIRD_INSET", INSETS[2]),
    ("THIRD_NUDGE", NUDGES[2]),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::amount::RadianceAmount;
    use crate::channels::Channels;
    use crate::glam::{Affine3A, Vec2, Vec3};
    use crate::image::Image;
    use crate::image_infinite::ImageInfiniteLight;
    use crate::image_infinite_desc::{EnvironmentMap, ImageInfiniteLightDesc};
    use crate::light::Light;
    use crate::pdf_coverage::PdfCoverage;
    use crate::rgb::Rgb;
    use crate::scene_sphere::SceneSphere;
    use light_bounds::LightSampleContext;

    fn sky(map: EnvironmentMap) -> ImageInfiniteLight<Rgb> {
        let scene = SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere");
        let desc = ImageInfiniteLightDesc {
            map,
            transform: Affine3A::from_rotation_x(0.3),
            amount: RadianceAmount::Radiometric(2.0),
        };
        ImageInfiniteLight::new(desc, scene).expect("a sky")
    }

    /// Half of the texels are black, and so is all of row 1.
    fn image(size: [u32; 2]) -> Image {
        let texel = |i: u32| if i / size[0] == 1 { 0 } else { i * 7 % 12 };
        let texels = (0..size[0] * size[1]).map(|i| texel(i).saturating_sub(5) as f32);
        Image::from_f32(size, Channels::Gray, texels.collect::<Vec<f32>>()).expect("an image")
    }

    /// The last bin that begins at or below `u`, as a reader of the table finds it.
    fn find(begins: &[f32], u: f32) -> usize {
        let found = begins.iter().rposition(|&begin| begin <= u);
        found.expect("the first bin begins at 0")
    }

    #[test]
    fn a_reader_of_the_table_samples_the_light() {
        let maps = [
            EnvironmentMap::LatLong(image([6, 5])),
            EnvironmentMap::EqualArea(image([5, 5])),
        ];
        let ctx = LightSampleContext::medium(Vec3::ZERO);
        let coverages = [PdfCoverage::Complete, PdfCoverage::Incomplete];
        for (map, coverage) in maps
            .into_iter()
            .flat_map(|map| coverages.map(|c| (map.clone(), c)))
        {
            let light = sky(map);
            let table = light.table(coverage).expect("light");
            let [width, height] = table.size.map(|n| n as usize);
            assert_eq!(table.columns.len(), width * height, "a number a texel");
            assert_eq!((table.rows.len(), table.rows[0]), (height, 0.0), "rows");
            for u in (0..900u16).map(|i| Vec2::new(f32::from(i % 30), f32::from(i / 30)) / 30.0) {
                let row = find(&table.rows, u.y);
                let column = find(&table.columns[row * width..][..width], u.x);
                let sample = light.sample_li(&ctx, u, &(), coverage).expect("a sample");
                let density = table.densities[row * width + column];
                assert_eq!(density, sample.pdf, "{:?} {coverage:?}, {u}", table.map);
                let texel = [column, row].map(|i| u32::try_from(i).expect("few"));
                assert_eq!(light.texel_radiance(texel, &()), sample.l, "{u}");
            }
        }
    }

    #[test]
    fn caps_go_from_the_pole_to_the_equator_or_beyond() {
        let caps = |map| sky(map).table(PdfCoverage::Complete).expect("light").caps;
        let even = caps(EnvironmentMap::LatLong(image([3, 4])));
        assert_eq!((even.len(), even[0]), (3, 0.0), "two rows");
        assert!((even[2] - 0.5).abs() < 1e-7, "half of the sphere: {even:?}");
        let odd = caps(EnvironmentMap::LatLong(image([6, 5])));
        assert!(odd.len() == 4 && odd[3] > 0.5, "a row beyond: {odd:?}");
        assert!(
            caps(EnvironmentMap::EqualArea(image([5, 5]))).is_empty(),
            "none"
        );
    }

    #[test]
    fn black_has_no_table() {
        let black = Image::from_f32([2, 2], Channels::Gray, [0.0; 4]).expect("an image");
        for map in [
            EnvironmentMap::LatLong(black.clone()),
            EnvironmentMap::EqualArea(black),
        ] {
            assert_eq!(
                sky(map).table(PdfCoverage::Complete),
                None,
                "nothing to choose"
            );
        }
    }
}
