//! All ways to find light have the same mean, and threads change nothing.

mod support;

use light_render::SamplerKind;
use light_render::integrator::Estimator;
use light_scene::Scene;
use light_scene::glam::Vec3;
use support::{Shot, agree, cornell};

#[test]
fn light_and_material_samples_and_both_have_the_same_mean() {
    let scene = cornell();
    let of = |estimator, spp| {
        let shot = Shot {
            estimator,
            spp,
            ..Shot::default()
        };
        shot.mean(&scene)
    };
    let mis = of(Estimator::Mis, 16);
    let light = of(Estimator::Light, 16);
    let bsdf = of(Estimator::Bsdf, 64);
    assert!(agree(light, mis), "light {light:?} and both {mis:?}");
    assert!(agree(bsdf, mis), "material {bsdf:?} and both {mis:?}");
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
fn threads_do_not_change_a_bit() {
    let picture = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads");
        let shot = Shot {
            spp: 5,
            ..Shot::default()
        };
        pool.install(|| shot.render(&cornell(), 3).film.develop())
    };
    assert_eq!(picture(1), picture(2), "one thread and two");
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
