//! A lamp and a sky in fog without bounds.

use light_render::integrator::{Estimator, Integrator, SingleScattering};
use light_scene::glam::{DVec3, Vec3};
use light_scene::{Camera, Emission, Material, Mesh, Scene};
use lights::media::phase::HenyeyGreenstein;
use lights::media::{Homogeneous, Phase, PhaseFunction, Region, StepSize};
use lights::sources::{IntensityAmount, LightDesc, MediumInterface, PointLightDesc};

use super::furnace::furnace_shot;
use super::{sky, substance};
use crate::support::{Shot, agree, room};

/// A lamp in fog without bounds, and what a ray along z sees of it after one collision, by the
/// midpoint rule.
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
    shot.assert_mean(&scene, DVec3::splat(expected), "one collision");
}

#[test]
fn the_sky_is_not_seen_through_fog_without_end() {
    let (mut scene, _) = lamp_in_fog();
    scene.lights = vec![sky(1.0)];
    let shot = furnace_shot(Estimator::Light);
    shot.assert_mean(&scene, DVec3::ZERO, "infinitely thick");
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
