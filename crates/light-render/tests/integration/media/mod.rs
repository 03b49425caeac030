//! Light in media, against closed forms and quadrature.

mod fog;
mod furnace;

use light_render::integrator::Integrator;
use light_scene::glam::{Affine3A, Vec3};
use light_scene::{Camera, Emission, Material, Mesh, Scene, Surface};
use lights::math::Aabb;
use lights::media::phase::{HenyeyGreenstein, Isotropic};
use lights::media::{
    AnyMedium, DensityGrid, Glow, GridMedium, Homogeneous, Phase, Region, Substance,
};
use lights::sources::{LightDesc, MediumInterface, RadianceAmount, Rgb, UniformInfiniteLightDesc};

use crate::support::{Shot, assert_estimators_agree, assert_threads_change_nothing, cornell, room};

const ISOTROPIC: Phase = Phase::Isotropic(Isotropic);

fn substance(sigma_a: Vec3, sigma_s: Vec3, le: Vec3) -> Substance<Rgb> {
    Substance::new(sigma_a, sigma_s, le).expect("valid")
}

fn homogeneous(sigma_a: Vec3, sigma_s: Vec3, le: Vec3) -> AnyMedium<Rgb> {
    Homogeneous {
        substance: substance(sigma_a, sigma_s, le),
        phase: ISOTROPIC,
        region: Region::UNBOUNDED,
    }
    .into()
}

/// A cloud of uneven density in the unit cube.
fn grid(sigma_a: Vec3, sigma_s: Vec3, le: Vec3) -> AnyMedium<Rgb> {
    let values = (0..5 * 4 * 3).map(|i: u16| f32::from(i * 37 % 11) * 0.3);
    let density = DensityGrid::new([5, 4, 3], values.collect()).expect("valid");
    let g = HenyeyGreenstein::new(0.7).expect("in range");
    GridMedium::new(
        substance(sigma_a, sigma_s, le),
        Phase::HenyeyGreenstein(g),
        Aabb::new(Vec3::ZERO, Vec3::ONE),
        Affine3A::IDENTITY,
        density,
        Glow::uniform(),
    )
    .expect("valid")
    .into()
}

/// The unit cube filled with a medium, bounded by `surface`, seen from outside along x.
fn filled_cube(medium: AnyMedium<Rgb>, surface: Surface) -> Scene {
    let mut scene = Scene::default();
    let inside = Some(scene.add_medium("inside", medium));
    let boundary = scene.add_material(Material {
        media: MediumInterface {
            inside,
            outside: None,
        },
        ..Material::new("boundary", surface)
    });
    for [a, b, c, d] in room() {
        scene
            .meshes
            .push(Mesh::quad("boundary", boundary, [a, d, c, b]));
    }
    let eye = Vec3::new(-2.0, 0.5, 0.5);
    scene.camera = Camera::look_at(eye, Vec3::splat(0.5), Vec3::Y, 0.3).ok();
    scene
}

fn sky(radiance: f32) -> LightDesc<Rgb> {
    LightDesc::UniformInfinite(UniformInfiniteLightDesc {
        emission: Vec3::splat(radiance),
        amount: RadianceAmount::default(),
    })
}

#[test]
fn light_dies_out_by_beer_and_lambert() {
    let sigma_a = Vec3::new(0.3, 1.0, 2.0);
    let mut scene = filled_cube(
        homogeneous(sigma_a, Vec3::ZERO, Vec3::ZERO),
        Surface::Interface,
    );
    scene.lights.push(sky(2.0));
    // So narrow that all rays cross a length of 1.
    let eye = Vec3::new(-2.0, 0.5, 0.5);
    scene.camera = Camera::look_at(eye, Vec3::splat(0.5), Vec3::Y, 1e-3).ok();
    let shot = Shot {
        size: 4,
        ..Shot::default()
    };
    shot.assert_mean(
        &scene,
        (2.0 * (-sigma_a).exp()).as_dvec3(),
        "two boundaries",
    );
}

#[test]
fn a_glowing_slab_emits_what_it_absorbs() {
    let (sigma_a, le) = (Vec3::new(0.3, 1.0, 2.0), Vec3::new(4.0, 2.0, 1.0));
    let mut scene = filled_cube(homogeneous(sigma_a, Vec3::ZERO, le), Surface::Interface);
    scene.lights.push(sky(0.0));
    let eye = Vec3::new(-2.0, 0.5, 0.5);
    scene.camera = Camera::look_at(eye, Vec3::splat(0.5), Vec3::Y, 1e-3).ok();
    let shot = Shot {
        max_depth: 1,
        ..Shot::default()
    };
    let expected = le * (Vec3::ONE - (-sigma_a).exp());
    shot.assert_mean(&scene, expected.as_dvec3(), "(1 - exp(-sigma_a d)) Le");
}

/// The room of the other tests, full of thin coloured smoke.
fn smoky_room() -> Scene {
    let mut scene = cornell();
    let smoke = scene.add_medium(
        "smoke",
        grid(
            Vec3::new(0.1, 0.2, 0.4),
            Vec3::new(0.6, 0.5, 0.2),
            Vec3::splat(0.2),
        ),
    );
    scene.camera_medium = Some(smoke);
    // A pane in the middle that bounds nothing.
    let pane = scene.add_material(Material::new("pane", Surface::Interface));
    let corners = room()[2].map(|p| p + Vec3::Z * 0.8);
    scene.meshes.push(Mesh::quad("pane", pane, corners));
    scene
}

#[test]
fn all_ways_to_find_light_agree_in_smoke() {
    assert_estimators_agree(&smoky_room());
}

#[test]
fn a_lamp_in_a_medium_that_surrounds_it_is_an_area_light_like_any_other() {
    // A lamp inside of the filled cube, seen from outside, through its boundary.
    let medium = homogeneous(Vec3::splat(0.2), Vec3::splat(1.5), Vec3::ZERO);
    let mut scene = filled_cube(medium, Surface::Interface);
    let lamp = scene.add_material(Material {
        emission: Some(Emission::two_sided(Vec3::splat(3.0))),
        ..Material::diffuse("lamp", Vec3::splat(0.5))
    });
    let corners = room()[0].map(|p| p * 0.4 + Vec3::new(0.3, 0.5, 0.3));
    scene.meshes.push(Mesh::quad("lamp", lamp, corners));
    Shot::default().assert_estimators_agree(&scene, 16);
}

#[test]
fn threads_do_not_change_a_bit_of_smoke() {
    assert_threads_change_nothing(&smoky_room());
}

#[test]
fn without_media_both_integrators_make_the_same_picture() {
    let picture = |integrator| {
        let shot = Shot {
            integrator: Some(integrator),
            ..Shot::default()
        };
        shot.render(&cornell(), 3).film.develop()
    };
    let (path, volpath) = (picture(Integrator::Path), picture(Integrator::VolPath));
    assert!(path == volpath, "bit for bit");
}
