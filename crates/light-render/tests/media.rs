//! Light in media, against what can be said in closed form or by quadrature.

mod support;

use light_render::integrator::{Estimator, Integrator, SingleScattering};
use light_scene::glam::{Affine3A, DVec3, Vec3};
use light_scene::{Camera, Emission, Material, Mesh, Scene, Surface};
use lights::math::Aabb;
use lights::media::phase::{HenyeyGreenstein, Isotropic};
use lights::media::{
    AnyMedium, DensityGrid, Glow, GridMedium, Homogeneous, Phase, PhaseFunction, Region, StepSize,
    Substance,
};
use lights::sources::{
    IntensityAmount, LightDesc, MediumInterface, PointLightDesc, RadianceAmount, Rgb,
    UniformInfiniteLightDesc,
};
use support::{Shot, agree, assert_estimators_agree, cornell, room};

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

fn assert_mean(scene: &Scene, shot: &Shot, expected: Vec3, what: &str) {
    let mean = shot.mean(scene);
    let expected = (expected.as_dvec3(), DVec3::ZERO);
    assert!(agree(mean, expected), "{what}: {mean:?}, not {expected:?}");
}

/// Long paths in few pixels.
fn furnace_shot(estimator: Estimator) -> Shot {
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
        for estimator in [Estimator::Mis, Estimator::Light, Estimator::Bsdf] {
            let shot = furnace_shot(estimator);
            assert_mean(&scene, &shot, Vec3::ONE, &format!("{name}, {estimator:?}"));
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
    assert_mean(&scene, &shot, Vec3::ONE, "camera inside");
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
    assert_mean(&scene, &shot, Vec3::ONE, "glass");
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
    assert_mean(&scene, &shot, 2.0 * (-sigma_a).exp(), "two boundaries");
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
    assert_mean(&scene, &shot, expected, "(1 - exp(-sigma_a d)) Le");
}

/// A lamp in fog without bounds, and what a ray along z sees of it after one collision, by the midpoint rule.
fn lamp_in_fog() -> (Scene, f64) {
    let g = HenyeyGreenstein::new(0.6).expect("in range");
    let mut scene = Scene::default();
    let fog = Homogeneous {
        substance: substance(Vec3::splat(0.1), Vec3::splat(0.3), Vec3::ZERO),
        phase: Phase::HenyeyGreenstein(g),
        region: Region::UNBOUNDED,
    };
    scene.camera_medium = Some(scene.add_medium("fog", fog));
    let lamp = Vec3::new(1.0, 0.5, -2.0);
    scene.lights.push(LightDesc::Point(PointLightDesc {
        position: lamp,
        emission: Vec3::splat(5.0),
        amount: IntensityAmount::default(),
        media: MediumInterface::default(),
    }));
    scene.camera = Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, 1e-4).ok();
    let (n, length) = (200_000, 60.0);
    let h = length / f64::from(n);
    let seen = (0..n).map(|i| {
        let t = (f64::from(i) + 0.5) * h;
        let to_lamp = lamp.as_dvec3() - DVec3::NEG_Z * t;
        let d = to_lamp.length();
        let cos_theta = DVec3::NEG_Z.dot(to_lamp / d);
        #[expect(clippy::cast_possible_truncation, reason = "a cosine")]
        let phase = f64::from(g.value(cos_theta as f32));
        (-0.4 * (t + d)).exp() * 0.3 * phase * 5.0 / (d * d) * h
    });
    (scene, seen.sum())
}

#[test]
fn a_lamp_in_endless_fog_is_seen_as_by_quadrature() {
    let (scene, expected) = lamp_in_fog();
    let shot = Shot {
        size: 8,
        spp: 256,
        max_depth: 2,
        ..Shot::default()
    };
    let mean = shot.mean(&scene);
    let expected = (DVec3::splat(expected), DVec3::ZERO);
    assert!(agree(mean, expected), "{mean:?}, not {expected:?}");
}

#[test]
fn the_sky_is_not_seen_through_fog_without_end() {
    let (mut scene, _) = lamp_in_fog();
    scene.lights = vec![sky(1.0)];
    let shot = furnace_shot(Estimator::Light);
    assert_mean(&scene, &shot, Vec3::ZERO, "infinitely thick");
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
    let of = |estimator| {
        let shot = Shot {
            estimator,
            ..Shot::default()
        };
        shot.mean(&scene)
    };
    let [mis, light, bsdf] = [Estimator::Mis, Estimator::Light, Estimator::Bsdf].map(of);
    assert!(agree(light, mis), "light {light:?} and both {mis:?}");
    assert!(agree(bsdf, mis), "scattered {bsdf:?} and both {mis:?}");
}

#[test]
fn threads_do_not_change_a_bit_of_smoke() {
    let picture = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads");
        let shot = Shot {
            spp: 5,
            ..Shot::default()
        };
        pool.install(|| shot.render(&smoky_room(), 3).film.develop())
    };
    assert!(picture(1) == picture(2), "one thread and two");
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

#[test]
fn three_ways_to_scatter_once_agree() {
    let (mut scene, _) = lamp_in_fog();
    let floor = scene.add_material(Material::diffuse("floor", Vec3::splat(0.5)));
    let lamp = scene.add_material(Material {
        emission: Some(Emission::two_sided(Vec3::splat(8.0))),
        ..Material::diffuse("lamp", Vec3::ZERO)
    });
    let at = |scale: f32, place: Vec3| move |p: Vec3| (p - 0.5) * scale + place;
    let corners = room()[0].map(at(6.0, Vec3::new(0.0, 2.0, -3.0)));
    scene.meshes.push(Mesh::quad("floor", floor, corners));
    let corners = room()[1].map(at(0.4, Vec3::new(-0.8, 0.6, -2.5)));
    scene.meshes.push(Mesh::quad("lamp", lamp, corners));
    scene.camera = Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, 1.0).ok();
    let of = |integrator| {
        let shot = Shot {
            max_depth: 2,
            spp: 32,
            integrator: Some(integrator),
            ..Shot::default()
        };
        shot.mean(&scene)
    };
    let step = StepSize::new(0.25).expect("positive");
    let paths = of(Integrator::VolPath);
    let asked = of(Integrator::SingleScattering(SingleScattering::NextEvent));
    let marched = of(Integrator::SingleScattering(SingleScattering::Classic(
        step,
    )));
    assert!(agree(asked, paths), "asked {asked:?}, paths {paths:?}");
    assert!(
        agree(marched, paths),
        "marched {marched:?}, paths {paths:?}"
    );
}
