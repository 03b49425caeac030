//! All ways to find light have the same mean, and threads change nothing.

use core::num::NonZeroU32;
use std::path::Path;

use light_render::SamplerKind;
use light_render::integrator::Estimator;
use light_scene::glam::Vec3;
use light_scene::{Camera, Diagnostic, Emission, Files, Material, Mesh, Scene, parse_scene};

use crate::support::{
    Shot, agree, assert_estimators_agree, assert_threads_change_nothing, cornell, lamps, plane,
    room,
};

#[test]
fn light_and_material_samples_and_both_have_the_same_mean() {
    assert_estimators_agree(&cornell());
}

#[test]
fn light_sampling_is_far_less_noisy_than_material_sampling() {
    let scene = cornell();
    let error = |estimator| {
        let shot = Shot {
            estimator,
            max_depth: 2,
            ..Shot::default()
        };
        shot.mean(&scene).1.x
    };
    let (light, bsdf) = (error(Estimator::Light), error(Estimator::Bsdf));
    assert!(light * 3.0 < bsdf, "light {light}, material {bsdf}");
}

#[test]
fn all_samplers_have_the_same_mean() {
    let scene = cornell();
    let of = |sampler| {
        let shot = Shot {
            sampler,
            ..Shot::default()
        };
        shot.mean(&scene)
    };
    let uniform = of(SamplerKind::Uniform);
    for kind in SamplerKind::ALL {
        let mean = of(kind);
        assert!(
            agree(mean, uniform),
            "{kind} {mean:?} and uniform {uniform:?}"
        );
    }
}

#[test]
fn many_choices_and_one_shadow_keep_the_mean_and_lose_noise() {
    let scene = lamps();
    let of = |light_samples, sampler, estimator| {
        let shot = Shot {
            light_samples,
            sampler,
            estimator,
            max_depth: 3,
            ..Shot::default()
        };
        shot.mean(&scene)
    };
    let one = of(NonZeroU32::MIN, SamplerKind::Bvh, Estimator::Mis);
    let many = NonZeroU32::new(8).expect("eight");
    for kind in SamplerKind::ALL {
        for estimator in [Estimator::Mis, Estimator::Light] {
            let mean = of(many, kind, estimator);
            assert!(
                agree(mean, one),
                "{kind}, {estimator:?}: eight {mean:?} and one {one:?}"
            );
        }
    }
    // Of direct light alone, pixel by pixel.
    let noise = |light_samples| {
        let shot = Shot {
            light_samples,
            sampler: SamplerKind::Bvh,
            max_depth: 2,
            size: 48,
            ..Shot::default()
        };
        let [a, b] = [1, 2].map(|seed| shot.render(&scene, seed).film.develop());
        let differences = a
            .iter()
            .zip(&b)
            .map(|(&a, &b)| (a - b).length_squared() / (a + b + 0.1).length_squared());
        differences.sum::<f32>()
    };
    let (eight, one) = (noise(many), noise(NonZeroU32::MIN));
    assert!(eight < 0.8 * one, "eight {eight}, one {one}");
}

#[test]
fn threads_do_not_change_a_bit() {
    assert_threads_change_nothing(&cornell());
}

#[test]
fn depth_adds_light() {
    let scene: Scene = cornell();
    let brightness = |max_depth| {
        let shot = Shot {
            max_depth,
            ..Shot::default()
        };
        shot.mean(&scene).0.dot(Vec3::ONE.as_dvec3())
    };
    let [seen, direct, indirect] = [1, 2, 3].map(brightness);
    assert!(
        seen < direct && direct < indirect,
        "{seen}, {direct}, {indirect}"
    );
}

/// Rounding puts half of the points of a tilted triangle behind it, where its own light would fall
/// on them from all over the hemisphere.
#[test]
fn a_lamp_does_not_light_its_own_back() {
    let mut scene = Scene::default();
    let lamp = scene.add_material(Material {
        emission: Some(Emission::one_sided(Vec3::ONE)),
        ..Material::diffuse("lamp", Vec3::splat(0.5))
    });
    let corners = [(0.3, 0.1), (1.4, 0.2), (1.3, 1.1), (0.1, 1.2)]
        .map(|(x, y)| Vec3::new(x, y, 0.37 * x - 0.61 * y));
    scene.meshes.push(Mesh::quad("lamp", lamp, corners));
    let from_behind = Vec3::new(0.5, 0.6, -3.0);
    scene.camera = Camera::look_at(from_behind, Vec3::new(0.7, 0.7, 0.0), Vec3::Y, 0.3).ok();
    for estimator in [Estimator::Light, Estimator::Mis] {
        let shot = Shot {
            estimator,
            ..Shot::default()
        };
        let (mean, _) = shot.mean(&scene);
        assert_eq!(mean.max_element(), 0.0, "{estimator:?}");
    }
}

/// The second of two coincident faces is left out: rays hit one of them, but light samples found
/// both, so that means were up to twice as bright.
#[test]
fn a_lamp_that_a_file_lists_twice_is_one() {
    let lamp = "f 1 2 3 4\n";
    fn mtl(_: &Path) -> Result<Vec<u8>, Diagnostic> {
        Ok(b"newmtl matt\nKd .5 .5 .5\nnewmtl lamp\nKe 1 1 1\n".to_vec())
    }
    let read = |text: &str| {
        let mut scene = parse_scene(Path::new("a.obj"), text.as_bytes(), Files::new(&mtl));
        let scene = scene.as_mut().expect("a scene");
        let (eye, target) = (Vec3::new(0.5, 0.3, 3.0), Vec3::new(0.5, 0.0, 0.0));
        scene.camera = Camera::look_at(eye, target, Vec3::Y, 0.6).ok();
        scene.clone()
    };
    let start = "mtllib a.mtl\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\n\
                 v -1 0 -1\nv -1 0 2\nv 2 0 2\nv 2 0 -1\n\
                 usemtl matt\nf 5 6 7 8\nusemtl lamp\n";
    let once = read(&format!("{start}o first\n{lamp}"));
    let twice = read(&format!("{start}o first\n{lamp}o second\n{lamp}"));
    assert_eq!(once.warnings, [], "as usual");
    assert_eq!(twice.warnings.len(), 1, "{:?}", twice.warnings);
    assert_estimators_agree(&twice);
    let shot = Shot::of_direct_light(Estimator::Light);
    assert_eq!(shot.mean(&twice), shot.mean(&once), "one lamp");
}

/// The square of twice the area of a triangle of 5e9 units is more than a float holds, and that of
/// 1e-10 units less.
#[test]
fn the_unit_of_length_does_not_matter() {
    let mean = |scale: f32| {
        let mut scene = plane(0.5, 25.0 * scale);
        let lamp = scene.add_material(Material {
            emission: Some(Emission::one_sided(Vec3::ONE)),
            ..Material::diffuse("lamp", Vec3::ZERO)
        });
        let corners = room()[1].map(|p| (p * 2.0 + Vec3::new(-1.0, 1.0, -1.0)) * scale);
        scene.meshes.push(Mesh::quad("lamp", lamp, corners));
        let (eye, target) = (Vec3::new(0.0, 1.0, 4.0), Vec3::new(0.0, 0.0, 1.0));
        scene.camera = Camera::look_at(eye * scale, target * scale, Vec3::Y, 0.1).ok();
        Shot::of_direct_light(Estimator::Mis).mean(&scene)
    };
    let one = mean(1.0);
    assert!(one.0.min_element() > 0.05, "light arrives: {one:?}");
    for scale in [1e8, 2e8, 1e-10] {
        let scaled = mean(scale);
        assert!(agree(scaled, one), "{scale}: {scaled:?}, {one:?}");
    }
}
