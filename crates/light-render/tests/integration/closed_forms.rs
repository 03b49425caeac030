//! Pictures that can be computed by hand.

use core::f64::consts::FRAC_1_PI;

use light_render::integrator::Estimator;
use light_scene::glam::{Affine3A, DVec3, Vec3};
use light_scene::{Emission, Image, Material, Mesh, Scene};
use lights::sources::{
    DistantLightDesc, IntensityAmount, IrradianceAmount, LightDesc, MediumInterface,
    PointLightDesc, RadianceAmount, Rgb, UniformInfiniteLightDesc,
};

use crate::support::{ALL, Shot, plane, room};

const ALBEDO: f32 = 0.6;

/// Direct light on the plane, by light samples and by both kinds.
fn assert_plane(light: LightDesc<Rgb>, radiance: f64, estimators: &[Estimator]) {
    let mut scene = plane(ALBEDO, 1.0);
    scene.lights.push(light);
    assert_mean(&scene, radiance, estimators);
}

fn assert_mean(scene: &Scene, radiance: f64, estimators: &[Estimator]) {
    for &estimator in estimators {
        let shot = Shot {
            size: 8,
            max_depth: 2,
            estimator,
            ..Shot::default()
        };
        shot.assert_mean(scene, DVec3::splat(radiance), &format!("{estimator:?}"));
    }
}

const LIGHT_AND_BOTH: &[Estimator] = &[Estimator::Light, Estimator::Mis];

#[test]
fn a_point_light_falls_off_with_the_square_of_the_distance() {
    let light = LightDesc::Point(PointLightDesc {
        position: Vec3::new(30.0, 40.0, 0.0),
        emission: Vec3::splat(5e3),
        amount: IntensityAmount::default(),
        media: MediumInterface::default(),
    });
    let (distance, cosine) = (50.0f64, 0.8);
    let radiance = f64::from(ALBEDO) * FRAC_1_PI * 5e3 * cosine / (distance * distance);
    assert_plane(light, radiance, LIGHT_AND_BOTH);
}

#[test]
fn a_distant_light_gives_its_irradiance_times_the_cosine() {
    let light = LightDesc::Distant(DistantLightDesc {
        direction: Vec3::new(-0.6, 0.8, 0.0),
        emission: Vec3::splat(7.0),
        amount: IrradianceAmount::default(),
    });
    assert_plane(
        light,
        f64::from(ALBEDO) * FRAC_1_PI * 7.0 * 0.8,
        LIGHT_AND_BOTH,
    );
}

#[test]
fn a_constant_sky_gives_its_radiance_times_the_albedo() {
    let light = LightDesc::UniformInfinite(UniformInfiniteLightDesc {
        emission: Vec3::splat(3.0),
        amount: RadianceAmount::default(),
    });
    // Incomplete light samples leave a uniform sky to the material alone.
    assert_plane(light, f64::from(ALBEDO) * 3.0, &ALL);
}

#[test]
fn a_sky_image_of_one_color_is_a_constant_sky() {
    let mut scene = plane(ALBEDO, 1.0);
    let texels = vec![Vec3::splat(3.0); 8 * 4];
    let image = Image::new(8, 4, texels).expect("8 x 4");
    let added = scene.add_sky(&image, Affine3A::from_rotation_x(0.3));
    added.expect("radiance");
    assert_mean(&scene, f64::from(ALBEDO) * 3.0, &ALL);
}

#[test]
fn a_sky_with_a_bright_spot_gives_the_same_by_all_estimators() {
    let mut scene = plane(ALBEDO, 1.0);
    let mut texels = vec![Vec3::splat(0.2); 16 * 8];
    texels[2 * 16 + 5] = Vec3::splat(40.0);
    let image = Image::new(16, 8, texels).expect("16 x 8");
    let added = scene.add_sky(&image, Affine3A::IDENTITY);
    added.expect("radiance");
    let shot = Shot {
        size: 8,
        spp: 64,
        max_depth: 2,
        ..Shot::default()
    };
    shot.assert_estimators_agree(&scene, 64);
}

#[test]
fn a_lamp_overhead_gives_its_form_factor() {
    // Disk-like square far above: L A / d^2, to the accuracy of its size over its distance.
    let mut scene = plane(ALBEDO, 0.1);
    let lamp = scene.add_material(Material {
        emission: Some(Emission::one_sided(Vec3::splat(1e4))),
        ..Material::diffuse("lamp", Vec3::ZERO)
    });
    let corners = room()[1].map(|p| (p - Vec3::new(0.5, 1.0, 0.5)) * 0.5 + Vec3::Y * 100.0);
    scene.meshes.push(Mesh::quad("lamp", lamp, corners));
    let radiance = f64::from(ALBEDO) * FRAC_1_PI * 1e4 * 0.25 / 1e4;
    assert_mean(&scene, radiance, LIGHT_AND_BOTH);
}

#[test]
fn a_closed_box_glows_with_emission_over_one_minus_albedo() {
    let mut scene = Scene::default();
    let glowing = scene.add_material(Material {
        emission: Some(Emission::one_sided(Vec3::new(1.0, 2.0, 0.5))),
        ..Material::diffuse("glowing", Vec3::splat(0.5))
    });
    for corners in room() {
        scene.meshes.push(Mesh::quad("wall", glowing, corners));
    }
    scene.camera = light_scene::Camera::look_at(Vec3::splat(0.5), Vec3::ZERO, Vec3::Y, 2.0).ok();
    for estimator in ALL {
        let shot = Shot {
            size: 8,
            spp: 32,
            max_depth: 64,
            estimator,
            ..Shot::default()
        };
        shot.assert_mean(&scene, DVec3::new(2.0, 4.0, 1.0), &format!("{estimator:?}"));
    }
}
