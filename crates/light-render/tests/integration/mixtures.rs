//! Mixtures of two materials: at each point one of them, on average both by their shares.

use light_scene::glam::{DVec3, Vec2, Vec3};
use light_scene::{Color, ColorImage, Emission, Image, Material, MaterialId, Mesh, Scene, Surface};
use lights::sources::{LightDesc, RadianceAmount, UniformInfiniteLightDesc};

use crate::support::{Shot, agree, cornell, plane, room};

fn mix(scene: &mut Scene, materials: [MaterialId; 2], amount: Color) -> MaterialId {
    scene.add_material(Material::new("mix", Surface::Mix { materials, amount }))
}

fn grey(scene: &mut Scene, albedo: f32) -> MaterialId {
    scene.add_material(Material::diffuse("grey", Vec3::splat(albedo)))
}

/// A plane of what `make` makes, under a sky of radiance 1.
fn under_sky(make: impl Fn(&mut Scene) -> MaterialId) -> Scene {
    let mut scene = plane(0.0, 1.0);
    let sky = UniformInfiniteLightDesc {
        emission: Vec3::ONE,
        amount: RadianceAmount::default(),
    };
    scene.lights.push(LightDesc::UniformInfinite(sky));
    let material = make(&mut scene);
    scene.meshes[0].material = material;
    scene
}

fn mean(scene: &Scene) -> (DVec3, DVec3) {
    let shot = Shot {
        max_depth: 2,
        ..Shot::default()
    };
    shot.mean(scene)
}

fn assert_is(mean: (DVec3, DVec3), expected: f64) {
    let exact = (DVec3::splat(expected), DVec3::ZERO);
    assert!(mean.1.x > 0.0, "chosen at random");
    assert!(agree(mean, exact), "{mean:?}, expected {expected}");
}

#[test]
fn the_mean_of_two_albedos() {
    for amount in [0.2f32, 0.5, 0.9] {
        let scene = under_sky(|scene| {
            let parts = [0.1, 0.8].map(|albedo| grey(scene, albedo));
            mix(scene, parts, Color::Constant(Vec3::splat(amount)))
        });
        assert_is(mean(&scene), 0.1 + 0.7 * f64::from(amount));
    }
}

#[test]
fn a_mixture_of_mixtures() {
    let scene = under_sky(|scene| {
        let half = Color::Constant(Vec3::splat(0.5));
        let parts = [0.1, 0.5].map(|albedo| grey(scene, albedo));
        let inner = mix(scene, parts, half);
        let other = grey(scene, 0.9);
        mix(scene, [inner, other], half)
    });
    assert_is(mean(&scene), f64::midpoint(0.3, 0.9));
}

#[test]
fn what_does_not_come_before_it_is_black() {
    let scene = under_sky(|scene| {
        let itself = grey(scene, 0.5);
        let itself = MaterialId(itself.0 + 1);
        mix(scene, [itself, itself], Color::Constant(Vec3::ONE))
    });
    assert_eq!(mean(&scene).0, DVec3::ZERO, "and nobody waits");
}

/// In a closed room that emits light, E / (1 - albedo), with the albedo of the mean: each
/// reflection chooses again.
#[test]
fn a_furnace_of_two_albedos() {
    let mut scene = Scene::default();
    let materials = [0.2, 0.8].map(|albedo| grey(&mut scene, albedo));
    let amount = Color::Constant(Vec3::splat(0.5));
    let walls = scene.add_material(Material {
        emission: Some(Emission::one_sided(Vec3::ONE)),
        ..Material::new("walls", Surface::Mix { materials, amount })
    });
    for corners in room() {
        scene.meshes.push(Mesh::quad("wall", walls, corners));
    }
    scene.camera = cornell().camera;
    let shot = Shot {
        max_depth: 50,
        spp: 32,
        ..Shot::default()
    };
    assert_is(shot.mean(&scene), 1.0 / (1.0 - 0.5));
}

/// Where the image is black the first, where it is white the second.
#[test]
fn an_image_may_be_the_amount() {
    let mut scene = under_sky(|scene| {
        let parts = [0.1, 0.8].map(|albedo| grey(scene, albedo));
        let texels = [0.0, 0.0, 1.0, 1.0].map(Vec3::splat).to_vec();
        let image = scene.add_image(Image::new(1, 4, texels).expect("an image"));
        mix(scene, parts, Color::Image(ColorImage::new(image)))
    });
    let uvs = [(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0)];
    scene.meshes[0].uvs = Some(uvs.map(|(u, v)| Vec2::new(u, v)).to_vec());
    // The picture shows a quarter of the plane's side, across the seam.
    scene.camera = light_scene::Camera::look_at(Vec3::Y * 2.0, Vec3::ZERO, Vec3::Z, 0.9).ok();
    let shot = Shot {
        max_depth: 2,
        spp: 4,
        ..Shot::default()
    };
    let pixels = shot.render(&scene, 0).film.develop();
    let row = |row: usize| pixels[row * 16..][..16].iter().map(|p| p.x).sum::<f32>() / 16.0;
    let ends = if row(4) < row(11) { [4, 11] } else { [11, 4] }.map(row);
    let near = |mean: f32, albedo: f32| (mean - albedo).abs() < 0.02;
    assert!(near(ends[0], 0.1) && near(ends[1], 0.8), "{ends:?}");
}
