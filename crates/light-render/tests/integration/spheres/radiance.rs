//! Light from spheres and within them, in closed form.

use light_scene::glam::{DVec3, Vec3};
use light_scene::{Camera, Emission, Material, QuadricFront, Scene};
use lights::sources::{LightDesc, RadianceAmount, UniformInfiniteLightDesc};

use super::{add, glass, lamp, similarity};
use crate::support::{ALL, Shot, agree, plane};

/// Direct light on a plane at the origin, below or beside a sphere of radiance 1.
#[test]
fn a_sphere_gives_the_irradiance_of_its_solid_angle() {
    const ALBEDO: f32 = 0.6;
    for (center, radius) in [
        (Vec3::new(0.0, 3.0, 0.0), 1.0),
        (Vec3::new(3.0, 4.0, 0.0), 2.0),
        (Vec3::new(0.0, 1.01, 0.0), 0.99),
        (Vec3::new(2e3, 4e3, 1e3), 5.0),
    ] {
        let mut scene = plane(ALBEDO, 1.0);
        scene.camera = Camera::look_at(Vec3::Y * 0.015, Vec3::ZERO, Vec3::Z, 1e-3).ok();
        add(
            &mut scene,
            lamp(Emission::one_sided(Vec3::ONE)),
            similarity(center, radius),
        );
        let (distance, radius) = (f64::from(center.length()), f64::from(radius));
        let sine = radius / distance;
        let expected = f64::from(ALBEDO) * sine * sine * f64::from(center.y) / distance;
        // Rays that scatter find a small lamp too seldom.
        for estimator in ALL.into_iter().filter(|e| sine > 0.1 || e.samples_lights()) {
            let shot = Shot::of_direct_light(estimator);
            let what = format!("{estimator:?} under {center}");
            shot.assert_mean(&scene, DVec3::splat(expected), &what);
        }
    }
}

#[test]
fn a_furnace_inside_of_a_sphere_is_the_geometric_series() {
    const ALBEDO: f32 = 0.7;
    const DEPTH: i32 = 5;
    let mut scene = Scene::default();
    let wall = Material {
        emission: Some(Emission::one_sided(Vec3::new(1.0, 2.0, 3.0))),
        ..Material::diffuse("wall", Vec3::splat(ALBEDO))
    };
    add(
        &mut scene,
        wall,
        similarity(Vec3::new(10.0, 0.0, -3.0), 2.0),
    );
    scene.quadrics[0].front = QuadricFront::Inside;
    let eye = Vec3::new(10.5, 0.3, -2.0);
    scene.camera = Camera::look_at(eye, eye + Vec3::X, Vec3::Y, 1.5).ok();
    let albedo = f64::from(ALBEDO);
    let series = (1.0 - albedo.powi(DEPTH)) / (1.0 - albedo);
    for estimator in ALL {
        let shot = Shot {
            max_depth: 5,
            spp: 64,
            estimator,
            ..Shot::default()
        };
        let mean = shot.mean(&scene);
        let exact = (DVec3::new(1.0, 2.0, 3.0) * series, DVec3::ZERO);
        assert!(
            agree(mean, exact),
            "{estimator:?}: {mean:?}, expected {series} times the emission"
        );
    }
}

#[test]
fn glass_balls_under_an_even_sky_are_not_seen() {
    let mut scene = Scene::default();
    add(
        &mut scene,
        Material::new("glass", glass()),
        similarity(Vec3::ZERO, 1.0),
    );
    let sky = UniformInfiniteLightDesc {
        emission: Vec3::ONE,
        amount: RadianceAmount::default(),
    };
    scene.lights.push(LightDesc::UniformInfinite(sky));
    scene.camera = Camera::look_at(Vec3::Z * 4.0, Vec3::ZERO, Vec3::Y, 0.6).ok();
    let shot = Shot {
        max_depth: 1000,
        spp: 64,
        ..Shot::default()
    };
    let mean = shot.mean(&scene);
    assert!(agree(mean, (DVec3::ONE, DVec3::ZERO)), "{mean:?}");
}
