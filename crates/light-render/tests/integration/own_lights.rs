//! Lights of other types in scenes: pictures are those of the lights which they repeat.

use light_render::integrator::Integrator;
use light_render::{SceneDigest, SceneDigestError, World, inventory};
use light_scene::glam::{Affine3A, Quat, Vec3};
use light_scene::{Emission, Material, Quadric, Scene};
use light_testkit::own_twin;
use lights::bounds::LightId;
use lights::math::Aabb;
use lights::sources::*;

use crate::support::{Shot, assert_estimators_agree, assert_threads_change_nothing, cornell};

/// The sphere around a scene, as the world has it.
fn around(scene: &Scene) -> SceneSphere {
    let (center, radius) = scene.bounds().bounding_sphere();
    SceneSphere::new(center, radius).expect("a sphere")
}

fn twin(desc: LightDesc<Rgb>, scene: &Scene) -> LightDesc<Rgb> {
    own_twin(desc, around(scene)).expect("a light").into()
}

/// A room that is open to the left, with lights that have no surface.
fn open_room() -> Scene {
    let mut scene = cornell();
    scene.meshes.remove(3);
    let amount = IntensityAmount::Radiometric(0.2);
    let down = Quat::from_rotation_arc(Vec3::Z, Vec3::NEG_Y);
    let down = Affine3A::from_rotation_translation(down, Vec3::new(0.7, 0.9, 0.6));
    let (lamp, from_left) = (Vec3::new(0.2, 0.8, 0.7), Vec3::new(-0.9, 0.3, 0.1));
    let irradiance = IrradianceAmount::Radiometric(0.5);
    let sun = SunAmount::Radiance(RadianceAmount::Radiometric(20.0));
    scene.lights = vec![
        PointLightDesc::new(lamp, Vec3::ONE, amount).into(),
        SpotLightDesc::new(down, 0.5, Vec3::new(1.0, 0.5, 0.2), amount).into(),
        DistantLightDesc::new(from_left.normalize(), Vec3::ONE, irradiance).into(),
        LightDesc::Sun(SunLightDesc {
            direction: from_left,
            angular_diameter: 0.2,
            emission: Vec3::ONE,
            amount: sun,
        }),
        UniformInfiniteLightDesc::new(Vec3::Z, RadianceAmount::Radiometric(0.3)).into(),
    ];
    scene
}

/// `cornell` with a glowing black ball, as geometry of the scene, and as an own light.
fn balls() -> [Scene; 2] {
    let radiance = Vec3::new(3.0, 2.0, 1.0);
    let mut plain = cornell();
    let transform = Affine3A::from_translation(Vec3::new(0.7, 0.35, 0.4));
    let transform = transform * Affine3A::from_scale(Vec3::splat(0.12));
    let glow = plain.add_material(Material {
        emission: Some(Emission::one_sided(radiance)),
        ..Material::diffuse("glow", Vec3::ZERO)
    });
    let ball = Quadric::sphere("ball", glow, transform);
    let color = SurfaceColor::Uniform(radiance);
    let emission = DiffuseEmissionDesc::new(color, RadianceAmount::default());
    let desc = AreaLightDesc::new(ball.shape(), emission);
    plain.quadrics.push(ball);
    let mut own = cornell();
    own.lights.push(twin(desc.into(), &plain));
    [plain, own]
}

#[test]
fn own_lights_without_a_surface_make_the_picture_of_their_twins() {
    let plain = open_room();
    let mut own = plain.clone();
    own.lights = (plain.lights.iter().cloned())
        .map(|desc| twin(desc, &plain))
        .collect();
    for integrator in [Integrator::Path, Integrator::VolPath] {
        let shot = Shot {
            integrator: Some(integrator),
            ..Shot::default()
        };
        let pictures = [&plain, &own].map(|scene| shot.render(scene, 5).film.develop());
        assert!(pictures[0] == pictures[1], "bit for bit, {integrator:?}");
        let mut dark = cornell();
        dark.meshes.remove(3);
        let dark = shot.render(&dark, 5).film.develop();
        assert!(dark != pictures[0], "the lights are seen");
    }
}

/// The rounding of two ways to meet a sphere is all that differs: every pixel is the same within
/// 1e-4 of its value.
#[test]
fn an_own_ball_makes_the_picture_of_a_sphere() {
    let [plain, own] = balls();
    for integrator in [Integrator::Path, Integrator::VolPath] {
        let shot = Shot {
            integrator: Some(integrator),
            ..Shot::default()
        };
        let [a, b] = [&plain, &own].map(|scene| shot.render(scene, 6).film.develop());
        let off = |(a, b): (&Vec3, &Vec3)| (a - b).abs().max_element() / a.max_element();
        let most = a.iter().zip(&b).map(off).fold(0.0, f32::max);
        assert!(most < 1e-4, "{integrator:?}: off by {most:e}");
        let cornell = shot.render(&cornell(), 6).film.develop();
        let dark = a.iter().zip(&cornell).map(off).filter(|&x| x > 1e-4);
        assert!(dark.count() > 200, "the ball is seen");
    }
}

#[test]
fn all_ways_to_find_an_own_ball_agree() {
    let [_, own] = balls();
    assert_estimators_agree(&own);
    assert_threads_change_nothing(&own);
}

#[test]
fn own_lights_are_named_and_bound_the_scene() {
    let [plain, own] = balls();
    let world = World::new(own.clone()).expect("a world");
    let kinds: Vec<_> = inventory(world.lights())
        .iter()
        .map(|entry| (entry.kind, entry.count))
        .collect();
    assert_eq!(kinds, [("triangle", 2), ("own", 1)], "kinds");
    let names = world.light_names(LightId(2)).expect("the own light");
    assert_eq!(names, ["own", "light 0"], "names");
    let alone = |scene: &Scene| {
        let mut alone = scene.clone();
        alone.meshes.clear();
        alone.bounds()
    };
    let [sphere, own] = [&plain, &own].map(alone);
    assert_eq!(sphere, own, "the ball's box");
    assert_ne!(own, Aabb::EMPTY, "a box");
    assert_eq!(open_room().bounds(), cornell().bounds(), "others have none");
}

/// Nothing says what an own light consists of.
#[test]
fn own_lights_have_neither_digest_nor_text() {
    let [plain, own] = balls();
    assert!(SceneDigest::new(&plain).is_ok(), "a sphere has a digest");
    let refused = SceneDigest::new(&own).err();
    let expected = SceneDigestError::OwnLight { light: 0 };
    assert_eq!(refused, Some(expected), "an own light");
    assert_eq!(expected.to_string(), "light 0: an own light has no digest");
    let text = serde_json::to_string(&own.lights[0]);
    let error = text.expect_err("no text").to_string();
    assert_eq!(
        error,
        "the enum variant LightDesc::Own cannot be serialized"
    );
    let known = serde_json::to_string(&open_room().lights);
    assert!(
        known.is_ok_and(|text| text.contains("Sun")),
        "others have a text"
    );
}
