//! Media that only scatter vanish in a white furnace.

use light_render::integrator::Estimator;
use light_scene::glam::{DVec3, Vec3};
use light_scene::{Camera, Surface};

use super::{filled_cube, grid, homogeneous, sky};
use crate::support::{ALL, Shot};

/// Long paths in few pixels.
pub(super) fn furnace_shot(estimator: Estimator) -> Shot {
    Shot {
        size: 4,
        spp: 64,
        max_depth: 400,
        estimator,
        ..Shot::default()
    }
}

#[test]
fn what_only_scatters_vanishes_in_a_white_furnace() {
    let sigma_s = Vec3::new(1.0, 2.5, 4.0);
    for (name, medium) in [
        ("homogeneous", homogeneous(Vec3::ZERO, sigma_s, Vec3::ZERO)),
        ("grid", grid(Vec3::ZERO, sigma_s, Vec3::ZERO)),
    ] {
        let mut scene = filled_cube(medium, Surface::Interface);
        scene.lights.push(sky(1.0));
        for estimator in ALL {
            let shot = furnace_shot(estimator);
            shot.assert_mean(&scene, DVec3::ONE, &format!("{name}, {estimator:?}"));
        }
    }
}

#[test]
fn the_furnace_is_white_from_inside_of_the_medium_too() {
    let medium = homogeneous(Vec3::ZERO, Vec3::new(1.0, 2.0, 3.0), Vec3::ZERO);
    let mut scene = filled_cube(medium, Surface::Interface);
    scene.camera_medium = scene.meshes.first().and_then(|mesh| {
        let material = scene.material(mesh.material);
        material.media.inside
    });
    scene.camera = Camera::look_at(Vec3::splat(0.4), Vec3::ONE, Vec3::Y, 1.0).ok();
    scene.lights.push(sky(1.0));
    let shot = furnace_shot(Estimator::Light);
    shot.assert_mean(&scene, DVec3::ONE, "camera inside");
}

#[test]
fn a_scattering_medium_in_glass_vanishes_in_a_white_furnace() {
    let medium = homogeneous(Vec3::ZERO, Vec3::splat(2.0), Vec3::ZERO);
    let glass = Surface::Dielectric {
        eta: 1.5,
        alpha: light_scene::glam::Vec2::ZERO,
    };
    let mut scene = filled_cube(medium, glass);
    scene.lights.push(sky(1.0));
    let shot = furnace_shot(Estimator::Mis);
    shot.assert_mean(&scene, DVec3::ONE, "glass");
}
