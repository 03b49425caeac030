//! Surfaces that emit light with an image: their power is that of the texels they cover, and images
//! are held once.

use light_render::{AnyLightSampler, SamplerKind, World, inventory};
use light_scene::glam::{Affine2, Vec2, Vec3};
use light_scene::{
    Color, ColorImage, Emission, EmissionSides, Image, Material, MaterialId, Mesh, Scene,
};
use lights::sources::{TextureMapping, Wrap};

use crate::support::{assert_estimators_agree, cornell};

/// Blocks of four brightnesses, most of them black.
fn picture(size: u32) -> Image {
    let texel = |i: u32| {
        let (x, y) = (i % size / 8, i / size / 8);
        let bright = [0.0, 0.0, 0.2, 0.0, 4.0][(x * 3 + y * 7 + x * y) as usize % 5];
        Vec3::new(bright, 0.8 * bright, 0.5)
    };
    Image::new(size, size, (0..size * size).map(texel).collect()).expect("an image")
}

fn emissive(scene: &mut Scene, image: ColorImage) -> MaterialId {
    scene.add_material(Material {
        emission: Some(Emission {
            radiance: Color::Image(image),
            sides: EmissionSides::Front,
        }),
        ..Material::diffuse("screen", Vec3::splat(0.2))
    })
}

/// A wavy square of `n` by `n` quads at this height, each showing a part of the image.
fn sheet(n: u16, height: f32, material: MaterialId) -> Mesh {
    let mut mesh = Mesh::new("sheet", material);
    let mut uvs = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            let uv = Vec2::new(f32::from(i), f32::from(j)) / f32::from(n);
            let wave = 0.01 * (f32::from(i) * 0.9).sin();
            mesh.positions.push(Vec3::new(uv.x, height + wave, uv.y));
            uvs.push(uv);
        }
    }
    let n = u32::from(n);
    for a in (0..n).flat_map(|i| (0..n).map(move |j| i * (n + 1) + j)) {
        mesh.indices.push([a, a + n + 1, a + 1]);
        mesh.indices.push([a + 1, a + n + 1, a + n + 2]);
    }
    mesh.uvs = Some(uvs);
    mesh
}

#[test]
fn two_hundred_thousand_triangles_take_less_than_64_bytes_each() {
    let mut scene = Scene::default();
    let image = scene.add_image(picture(256));
    for height in 0..500u16 {
        // Each with a material of its own, as exporters write them.
        let image = ColorImage {
            scale: Vec3::splat(1.0 + f32::from(height % 7)),
            ..ColorImage::new(image)
        };
        let material = emissive(&mut scene, image);
        scene.meshes.push(sheet(15, f32::from(height), material));
    }
    let world = World::new(scene).expect("lights");
    let count = world.lights().len();
    assert!(count > 200_000, "{count} triangles");
    let bytes = world.lights().bytes();
    assert!(
        bytes.images < 256 * 256 * 13 + 12 * count + 100,
        "one image, its means and those of the triangles: {bytes:?}"
    );
    let sampler = AnyLightSampler::new(SamplerKind::DEFAULT, world.lights()).expect("a sampler");
    let all = bytes.lights + bytes.images + sampler.bytes(count);
    let each = all as f64 / count as f64;
    assert!(
        each < 64.0,
        "{each:.1} bytes a triangle beyond its vertices"
    );
    // What all triangles emit together is what the image emits over all of them.
    let power = inventory(world.lights())[0].power;
    let mean = picture(256).texels().iter().sum::<Vec3>() / 65536.0;
    let scales: f32 = (0..500u16).map(|height| 1.0 + f32::from(height % 7)).sum();
    let area = inventory(world.lights())[0].area / 500.0;
    let expected = (mean * scales).as_dvec3() * core::f64::consts::PI * area;
    let ratio = power / expected;
    // Waves make some triangles a little larger than others.
    assert!((ratio - 1.0).abs().max_element() < 1e-3, "{ratio}");
}

/// The room of [`cornell`], its lamp a screen that shows the image so.
fn screen(mapping: TextureMapping, uvs: Option<[[f32; 2]; 4]>) -> Scene {
    let mut scene = cornell();
    let image = scene.add_image(picture(32));
    let image = ColorImage {
        scale: Vec3::splat(8.0),
        mapping,
        ..ColorImage::new(image)
    };
    let screen = emissive(&mut scene, image);
    let lamp = scene.meshes.iter_mut().find(|mesh| mesh.name == "lamp");
    let lamp = lamp.expect("a lamp");
    lamp.material = screen;
    lamp.uvs = uvs.map(|uvs| uvs.map(Vec2::from).to_vec());
    scene
}

const CORNERS: [[f32; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

#[test]
fn hits_and_samples_of_a_screen_agree() {
    assert_estimators_agree(&screen(TextureMapping::REPEAT, Some(CORNERS)));
    assert_estimators_agree(&screen(TextureMapping::REPEAT, None));
}

#[test]
fn they_agree_where_the_image_is_turned_and_repeats() {
    let transform = Affine2::from_scale_angle_translation(Vec2::new(3.0, -1.7), 0.4, Vec2::X);
    for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Black] {
        let mapping = TextureMapping {
            transform,
            wrap: [wrap, Wrap::Clamp],
        };
        assert_estimators_agree(&screen(mapping, Some(CORNERS)));
    }
}
