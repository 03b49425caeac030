//! Rows of lights are what the shader's comments say of them.

use light_gpu::light_sources::glam::{Affine3A, Vec3};
use light_gpu::light_sources::light_bounds::LightId;
use light_gpu::light_sources::shape::ShapeDesc;
use light_gpu::light_sources::{
    AreaLightDesc, DiffuseEmissionDesc, IntensityAmount, LightDesc, LightSet, LightSetBuilder,
    MeshLightDesc, PointLightDesc, RadianceAmount, Rgb, SceneSphere, Sides, SurfaceColor,
};
use light_gpu::{UnsupportedLight, light_set_rows};

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
    let refused = light_set_rows(&set([point.into(), disk.into()]));
    assert_eq!(refused, Err(UnsupportedLight(LightId(1))), "the disk");
    let text = UnsupportedLight(LightId(1)).to_string();
    assert!(text.starts_with("light 1 "), "{text}");
}
