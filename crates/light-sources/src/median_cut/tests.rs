use super::*;
use crate::channels::Channels;
use core::f32::consts::PI;
use light_math::SphereMap::{EqualArea, LatLong};
use proptest::prelude::*;

fn cut(map: SphereMap, size: [u32; 2], texel: impl Fn(Vec3) -> f32) -> MedianCut {
    let texels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y]));
    let texels: Vec<f32> = texels
        .map(|p| texel(region::center(map, size, p)))
        .collect();
    let image = Image::from_f32(size, Channels::Gray, texels).expect("valid");
    MedianCut::new(image, map, RegionSums::Table).expect("valid")
}

fn lights(cut: &MedianCut, n: usize) -> Vec<MedianCutLight> {
    cut.lights(n, Centroid::Luminance).expect("lights")
}

/// Something smooth without symmetry.
fn sky(d: Vec3) -> f32 {
    2.2 + d.y + (3.0 * d.x).sin() * d.z
}

const MAPS: [(SphereMap, [u32; 2]); 2] = [(LatLong, [128, 64]), (EqualArea, [72, 72])];

#[test]
fn energies_are_equal_and_add_up_for_any_number() {
    for (map, size) in MAPS {
        let cut = cut(map, size, sky);
        let total = 4.0 * PI * cut.image.sphere_mean(map).x;
        for n in [1, 2, 3, 7, 16, 37] {
            let lights = lights(&cut, n);
            assert_eq!(lights.len(), n, "{map:?}");
            let sum: f32 = lights.iter().map(|l| l.irradiance.x).sum();
            assert!(
                (sum / total - 1.0).abs() < 1e-5,
                "{map:?} {n}: {sum} of {total}"
            );
            // A region of some 15 x 15 texels is cut to within half a column at each of its sides.
            for light in &lights {
                let off = light.irradiance.x * n as f32 / total - 1.0;
                assert!(off.abs() < 0.15, "{map:?} {n}: {off}");
            }
        }
    }
}

#[test]
fn regions_cover_the_map_once() {
    for (map, size) in MAPS {
        let lights = lights(&cut(map, size, sky), 23);
        for y in 0..size[1] {
            for x in 0..size[0] {
                let holds = |l: &&MedianCutLight| {
                    let TexelRegion { min, max } = l.region;
                    (min[0]..max[0]).contains(&x) && (min[1]..max[1]).contains(&y)
                };
                assert_eq!(lights.iter().filter(holds).count(), 1, "texel {x} {y}");
            }
        }
    }
}

#[test]
fn lights_of_a_constant_map_spread_evenly() {
    for (map, size) in MAPS {
        let lights = lights(&cut(map, size, |_| 1.0), 64);
        let mean: Vec3 = lights.iter().map(|l| l.direction).sum::<Vec3>() / 64.0;
        assert!(mean.length() < 0.02, "{map:?}: {mean}");
        for (i, a) in lights.iter().enumerate() {
            let cosines = lights[..i].iter().map(|b| b.direction.dot(a.direction));
            let nearest = cosines.fold(-1.0, f32::max);
            // Each has 0.44 rad by 0.44 rad.
            assert!(nearest < 0.2f32.cos(), "{map:?}: {nearest}");
        }
    }
}

#[test]
fn a_sun_is_found_within_its_texel() {
    for (map, size) in MAPS {
        let sun = Vec3::new(0.3, 0.5, -0.4).normalize();
        let texel = map.point(sun);
        let is_sun = |d: Vec3| {
            let off = (map.point(d) - texel) * glam::Vec2::new(size[0] as f32, size[1] as f32);
            off.abs().max_element() <= 0.5
        };
        let cut = cut(map, size, |d| if is_sun(d) { 1e5 } else { 0.1 });
        for centroid in [Centroid::Luminance, Centroid::SquaredLuminance] {
            let lights = cut.lights(9, centroid).expect("lights");
            assert_eq!(lights.len(), 9, "the others share the sky");
            let brightest = lights
                .iter()
                .max_by(|a, b| a.irradiance.x.total_cmp(&b.irradiance.x))
                .expect("nine");
            assert!(
                brightest.direction.distance(sun) < 2.0 * PI / size[0] as f32 * 1.5,
                "{map:?}"
            );
        }
    }
}

#[test]
fn there_are_no_more_lights_than_lit_texels() {
    for sums in [RegionSums::Table, RegionSums::Pyramid] {
        let mut texels = [0.0; 32 * 16];
        texels[100] = 2.0;
        texels[300] = 3.0;
        let image = Image::from_f32([32, 16], Channels::Gray, texels).expect("valid");
        let cut = MedianCut::new(image, LatLong, sums).expect("valid");
        let lights = lights(&cut, 100);
        assert_eq!(lights.len(), 2, "{sums:?}");
        let center = region::center(LatLong, [32, 16], [4, 3]);
        assert!(lights[0].direction.distance(center) < 1e-6, "{sums:?}");
    }
}

#[test]
fn the_pyramid_is_rough_but_loses_nothing() {
    for (map, size) in MAPS {
        let table = cut(map, size, sky);
        let total = 4.0 * PI * table.image.sphere_mean(map).x;
        let pyramid = MedianCut::new(table.image, map, RegionSums::Pyramid).expect("valid");
        let lights = lights(&pyramid, 16);
        let sum: f32 = lights.iter().map(|l| l.irradiance.x).sum();
        assert!(
            (sum / total - 1.0).abs() < 1e-5,
            "{map:?}: {sum} of {total}"
        );
        for light in lights {
            let off = light.irradiance.x * 16.0 / total - 1.0;
            assert!(off.abs() < 0.25, "{map:?}: {off}");
        }
    }
}

#[test]
fn black_maps_have_no_lights() {
    let black = cut(LatLong, [4, 2], |_| 0.0);
    assert_eq!(black.lights(5, Centroid::Luminance), Ok(Vec::new()), "none");
}

#[test]
fn refuses() {
    let gray = |size, value| Image::from_f32(size, Channels::Gray, [value; 2]).expect("valid");
    let new = |map| MedianCut::new(gray([2, 1], f32::MAX), map, RegionSums::Table);
    assert_eq!(
        new(EqualArea).err(),
        Some(MedianCutError::NotSquare),
        "not square"
    );
    let cut = new(LatLong).expect("valid");
    let lights = |n| cut.lights(n, Centroid::Luminance).err();
    assert_eq!(lights(0), Some(MedianCutError::NoLights), "no lights");
    assert_eq!(lights(1), Some(MedianCutError::TooBright), "too bright");
}

#[test]
fn lights_are_descriptions() {
    let light = lights(&cut(LatLong, [8, 4], sky), 3)[1];
    let desc = DistantLightDesc::<Rgb>::from(light);
    assert_eq!(
        (desc.direction, desc.emission),
        (light.direction, light.irradiance),
        "same"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn any_image_is_cut(
        texels in proptest::collection::vec(
            prop_oneof![Just(0.0f32), 0.0f32..1.0, 0.0f32..1e6],
            35,
        ),
        n in 1usize..50,
    ) {
        let image = Image::from_f32([7, 5], Channels::Gray, texels.clone()).expect("valid");
        for sums in [RegionSums::Table, RegionSums::Pyramid] {
            let cut = MedianCut::new(image.clone(), LatLong, sums).expect("valid");
            let lights = lights(&cut, n);
            let lit = texels.iter().filter(|&&t| t > 0.0).count();
            prop_assert_eq!(lights.len(), n.min(lit));
            prop_assert!(lights.iter().all(|l| l.direction.is_normalized()));
        }
    }
}
