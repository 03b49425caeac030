use light_scene::glam::{DVec3, Vec2, Vec3};
use light_scene::{Camera, Color, Image, Material, MetallicRoughness, Scene, Surface};
use lights::sources::{
    DistantLightDesc, IrradianceAmount, LightDesc, RadianceAmount, UniformInfiniteLightDesc,
};

use crate::support::{Shot, plane};

/// A dielectric of index 1.5 over a base of this colour.
pub(crate) fn dielectric(base_color: Vec3, roughness: f32) -> MetallicRoughness {
    MetallicRoughness {
        base_color: Color::Constant(base_color),
        roughness_metallic: Color::Constant(Vec3::new(0.0, roughness, 0.0)),
        f0: Vec3::splat(0.04),
        f90: 1.0,
        clearcoat: None,
    }
}

/// A plane of this surface, with u along +x and v along -z, seen from `eye` where its middle is.
pub(crate) fn plane_of(surface: Surface, eye: Vec3) -> Scene {
    let mut scene = plane(0.0, 1.0);
    scene.materials[0] = Material::new("surface", surface);
    let mesh = &mut scene.meshes[0];
    let uv = |p: &Vec3| 0.5 + 0.5 * Vec2::new(p.x, -p.z);
    mesh.uvs = Some(mesh.positions.iter().map(uv).collect());
    scene.camera = Camera::look_at(eye, Vec3::ZERO, Vec3::Z, 1e-3).ok();
    scene
}

/// Adds uniform light of radiance 1 from everywhere.
pub(crate) fn add_sky(scene: &mut Scene) {
    let sky = UniformInfiniteLightDesc {
        emission: Vec3::ONE,
        amount: RadianceAmount::default(),
    };
    scene.lights.push(LightDesc::UniformInfinite(sky));
}

/// Adds light of irradiance 1 from one direction.
pub(crate) fn add_sun(scene: &mut Scene, direction: Vec3) {
    let amount = IrradianceAmount::default();
    let sun = DistantLightDesc::new(direction, Vec3::ONE, amount);
    scene.lights.push(LightDesc::Distant(sun));
}

/// Direct light of a picture of one radiance.
pub(crate) fn direct(scene: &Scene) -> (DVec3, DVec3) {
    let shot = Shot {
        size: 8,
        max_depth: 2,
        ..Shot::default()
    };
    shot.mean(scene)
}

/// An image of these texels in a row.
pub(crate) fn row(texels: &[Vec3]) -> Image {
    let width = u32::try_from(texels.len()).expect("a few");
    Image::new(width, 1, texels.to_vec()).expect("an image")
}

pub(crate) fn assert_near((mean, error): (DVec3, DVec3), expected: f64, what: &str) {
    let tolerance = 4.5 * error.x + 2e-3 * expected;
    assert!(
        (mean.x - expected).abs() <= tolerance,
        "{what}: {} +- {}, expected {expected}",
        mean.x,
        error.x
    );
}
