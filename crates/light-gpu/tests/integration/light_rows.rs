//! Rows of lights are what the shader's comments say of them.

use light_gpu::light_samplers::BvhLightSampler;
use light_gpu::light_sources::glam::{Affine3A, Vec3};
use light_gpu::light_sources::light_bounds::LightId;
use light_gpu::light_sources::shape::ShapeDesc;
use light_gpu::light_sources::{
    AreaLightDesc, Channels, DiffuseEmissionDesc, EnvironmentMap, Image, ImageInfiniteLightDesc,
    IntensityAmount, LightDesc, LightSet, LightSetBuilder, MeshLightDesc, PointLightDesc,
    RadianceAmount, Rgb, SceneSphere, Sides, SurfaceColor,
};
use light_gpu::{
    LightSceneRowsError, UnsupportedLight, light_sampler_rows, light_scene_rows, light_set_rows,
};

const COLOR: Vec3 = Vec3::new(1.0, 2.0, 3.0);

fn set(lights: impl IntoIterator<Item = LightDesc<Rgb>>) -> LightSet<Rgb> {
    let scene = SceneSphere::new(Vec3::ZERO, 7.0).expect("a sphere");
    let mut builder = LightSetBuilder::new(scene);
    for light in lights {
        builder.add(light).expect("a valid light");
    }
    builder.build()
}

fn glow(sides: Sides) -> DiffuseEmissionDesc<Rgb> {
    let color = SurfaceColor::Uniform(COLOR);
    DiffuseEmissionDesc {
        sides,
        ..DiffuseEmissionDesc::new(color, RadianceAmount::Radiometric(2.0))
    }
}

fn vector(row: [u32; 4]) -> [f32; 3] {
    [0, 1, 2].map(|i| f32::from_bits(row[i]))
}

#[test]
fn a_light_is_four_rows_after_the_head() {
    let amount = IntensityAmount::Radiometric(1.0);
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let mesh = MeshLightDesc::new(corners, vec![[0, 1, 2], [2, 1, 0]], glow(Sides::Both));
    let point = PointLightDesc::new(Vec3::Z, COLOR, amount);
    let rows = light_set_rows(&set([mesh.into(), point.into()])).expect("known kinds");
    assert_eq!(rows.len(), 1 + 3 * 4, "rows");
    assert_eq!(rows[0], [3, 7.0f32.to_bits(), 0, 0], "count and radius");
    assert_eq!(vector(rows[2]), [2.0, 4.0, 6.0], "radiance");
    assert_eq!(
        vector(rows[5]),
        [0.0, 1.0, 0.0],
        "the second triangle's corners"
    );
    assert_eq!(
        vector(rows[7]),
        [1.0, 0.0, 0.0],
        "the second triangle's corners"
    );
    assert_eq!(rows[1][3], rows[5][3], "kind and sides of both triangles");
    assert_ne!(rows[1][3] & 0xff, rows[9][3] & 0xff, "kind of a point");
    assert_eq!(vector(rows[9]), [0.0, 0.0, 1.0], "the place of a point");
}

#[test]
fn sides_are_in_the_second_byte() {
    let code = |sides| {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let light = AreaLightDesc::new(ShapeDesc::Triangle(corners), glow(sides));
        light_set_rows(&set([light.into()])).expect("a triangle")[1][3] >> 8
    };
    let codes = [Sides::Front, Sides::Back, Sides::Both].map(code);
    assert_eq!(codes, [1, 2, 3], "front, back, both");
}

fn sky(map: fn(Image) -> EnvironmentMap, size: [u32; 2], texel: f32) -> LightDesc<Rgb> {
    let texels = (0..size[0] * size[1]).map(|i| texel * (1.0 + i as f32));
    let image = Image::from_f32(size, Channels::Gray, texels.collect::<Vec<f32>>());
    ImageInfiniteLightDesc {
        transform: Affine3A::from_rotation_z(0.5),
        amount: RadianceAmount::Radiometric(2.0),
        map: map(image.expect("an image")),
    }
    .into()
}

/// The row of a light's table, columns and rows of its picture.
fn place_of_table(rows: &[[u32; 4]], light: usize) -> [usize; 3] {
    let [first, width, height, _] = rows[4 + 4 * light].map(|n| n as usize);
    [first, width, height]
}

#[test]
fn tables_of_pictures_follow_all_lights() {
    let lat_long = sky(EnvironmentMap::LatLong, [3, 5], 1.0);
    let equal_area = sky(EnvironmentMap::EqualArea, [3, 3], 1.0);
    let point = PointLightDesc::new(Vec3::Z, COLOR, IntensityAmount::Radiometric(1.0));
    let rows = light_set_rows(&set([lat_long, point.into(), equal_area])).expect("known kinds");
    let [first, width, height] = place_of_table(&rows, 0);
    assert_eq!(
        [first, width, height],
        [1 + 3 * 4, 3, 5],
        "after the lights"
    );
    // 15 texels, 15 beginnings of columns and 5 of rows, and 4 caps.
    let second = first + 15 + 4 + 2 + 1;
    assert_eq!(place_of_table(&rows, 2), [second, 3, 3], "after the first");
    assert_eq!(rows.len(), second + 9 + 3 + 1, "without caps");
    assert_eq!(
        vector(rows[first + 4]),
        [10.0; 3],
        "radiance of the fifth texel"
    );
    let words = rows[first + 15..].as_flattened();
    assert_eq!(
        f32::from_bits(words[4]),
        4.0 / 15.0,
        "4 of 4 + 5 + 6 lies before it"
    );
    let [x, y] = [Vec3::X, Vec3::Y].map(|axis| {
        let turned = Affine3A::from_rotation_z(0.5).transform_vector3(axis);
        turned.to_array()
    });
    let near = |a: [f32; 3], b: [f32; 3]| Vec3::from(a).distance(Vec3::from(b)) < 1e-6;
    assert!(near(vector(rows[1]), x) && near(vector(rows[2]), y), "axes");
    assert_ne!(rows[1][3], rows[9][3], "kinds");
}

#[test]
fn a_black_picture_has_no_texels() {
    let rows = light_set_rows(&set([sky(EnvironmentMap::LatLong, [4, 2], 0.0)])).expect("a sky");
    assert_eq!(rows.len(), 1 + 4, "the light alone");
    assert_eq!(place_of_table(&rows, 0)[1..], [0, 0], "nothing to choose");
}

#[test]
fn the_first_light_that_shaders_do_not_sample_is_named() {
    let disk = ShapeDesc::Disk {
        transform: Affine3A::IDENTITY,
        radius: 1.0,
        inner_radius: 0.0,
    };
    let amount = IntensityAmount::Radiometric(1.0);
    let point = PointLightDesc::new(Vec3::Z, COLOR, amount);
    let disk = AreaLightDesc::new(disk, glow(Sides::Front));
    let set = set([point.into(), disk.into()]);
    let why = UnsupportedLight(LightId(1));
    assert_eq!(light_set_rows(&set), Err(why), "the disk");
    let text = why.to_string();
    assert!(text.starts_with("light 1: expected"), "{text}");
    assert!(text.contains("rectangle"), "names the kinds: {text}");
    let of_scene = LightSceneRowsError::Unsupported(why);
    assert_eq!(light_scene_rows(&set), Err(of_scene), "in a scene too");
    assert_eq!(of_scene.to_string(), text, "in the same words");
}

#[test]
fn a_scene_is_a_head_a_sampler_and_a_set() {
    let point = PointLightDesc::new(Vec3::Z, COLOR, IntensityAmount::Radiometric(1.0));
    let lights = set([point.into(), sky(EnvironmentMap::LatLong, [4, 2], 1.0)]);
    let rows = light_scene_rows(&lights).expect("known kinds");
    let sampler = BvhLightSampler::new(&lights.extents()).expect("valid lights");
    let sampler = light_sampler_rows(&sampler.view()).expect("one light at infinity");
    let (of_sampler, of_set) = rows[1..].split_at(sampler.len());
    assert_eq!(of_sampler, sampler, "after the head");
    assert_eq!(rows[0][0] as usize, 1 + sampler.len(), "where the set is");
    assert_eq!(of_set, light_set_rows(&lights).expect("known kinds"));
}
