//! Pictures of spheres are those of very many triangles.

use light_scene::glam::{Affine3A, Vec2, Vec3};
use light_scene::{
    Alpha, Color, Emission, Image, Instance, Material, Prototype, Quadric, QuadricFront, Scene,
    Surface as Finish,
};
use lights::media::phase::Isotropic;
use lights::media::{Homogeneous, Phase, Region, Substance};
use lights::sources::MediumInterface;

use super::{add, glass, lamp, similarity, tessellated, world};
use crate::support::{Shot, agree, assert_estimators_agree, cornell};

/// A room with a ball of `material` in it, an ordinary lamp above.
fn ball_in_room(material: Material) -> Scene {
    let mut scene = cornell();
    add(
        &mut scene,
        material,
        similarity(Vec3::new(0.65, 0.3, 0.4), 0.2),
    );
    scene
}

fn assert_looks_tessellated(scene: &Scene, what: &str) {
    let shot = Shot {
        max_depth: 12,
        ..Shot::default()
    };
    let means = [scene, &tessellated(scene, 128)].map(|scene| shot.mean(scene));
    assert!(agree(means[0], means[1]), "{what}: {means:?}");
}

#[test]
fn pictures_are_those_of_fine_triangles() {
    let grey = Vec3::splat(0.5);
    let metal = Finish::Conductor {
        eta: Vec3::splat(0.2),
        k: Vec3::splat(3.0),
        alpha: Vec2::splat(0.2),
    };
    for material in [
        Material::diffuse("matt", grey),
        Material::new("glass", glass()),
        Material::new("metal", metal),
        lamp(Emission::one_sided(Vec3::ONE)),
        lamp(Emission::two_sided(Vec3::ONE)),
        Material {
            alpha: Some(Alpha {
                opacity: Color::Constant(Vec3::splat(0.4)),
                cutoff: None,
            }),
            ..Material::diffuse("masked", grey)
        },
        Material {
            emission: Some(Emission::one_sided(Vec3::ONE)),
            ..Material::new("glass lamp", glass())
        },
    ] {
        let what = material.name.clone();
        assert_looks_tessellated(&ball_in_room(material), &what);
    }
}

#[test]
fn textures_lie_on_quadrics_as_on_triangles() {
    let texels = (0..64).map(|i| Vec3::splat(if i % 3 == 0 { 0.1 } else { 0.9 }));
    let image = Image::new(8, 8, texels.collect()).expect("an image");
    let mut scene = ball_in_room(Material::diffuse("ball", Vec3::ONE));
    let color = Color::Image(light_scene::ColorImage::new(scene.add_image(image)));
    let ball = scene.materials.last_mut().expect("the ball's");
    ball.surface = Finish::Diffuse { reflectance: color };
    assert_looks_tessellated(&scene, "textured");
    let ball = scene.materials.last_mut().expect("the ball's");
    ball.alpha = Some(Alpha {
        opacity: color,
        cutoff: Some(0.5),
    });
    assert_looks_tessellated(&scene, "with an alpha mask");
}

#[test]
fn estimators_agree_on_lamps_inside_and_outside() {
    for front in [QuadricFront::Outside, QuadricFront::Inside] {
        for emission in [Emission::one_sided, Emission::two_sided] {
            let mut scene = ball_in_room(lamp(emission(Vec3::new(3.0, 2.0, 1.0))));
            scene.quadrics[0].front = front;
            assert_estimators_agree(&scene);
            // From inside of it.
            scene.quadrics[0].transform = similarity(Vec3::new(0.5, 0.5, 0.9), 0.3);
            assert_estimators_agree(&scene);
        }
    }
}

#[test]
fn media_are_bounded_by_spheres() {
    let smoke = Homogeneous {
        substance: Substance::new(Vec3::ONE, Vec3::new(4.0, 8.0, 12.0), Vec3::ZERO).expect("valid"),
        phase: Phase::Isotropic(Isotropic),
        region: Region::UNBOUNDED,
    };
    for (what, surface) in [("smoke", Finish::Interface), ("smoke in glass", glass())] {
        let mut scene = ball_in_room(Material::new(what, surface));
        let inside = Some(scene.add_medium("smoke", smoke.clone()));
        let outside = None;
        let ball = scene.materials.last_mut().expect("the ball's");
        ball.media = MediumInterface { inside, outside };
        assert_looks_tessellated(&scene, what);
    }
}

#[test]
fn prototypes_hold_spheres_which_places_may_stretch() {
    let stretched = similarity(Vec3::new(0.6, 0.6, 0.5), 1.0)
        * Affine3A::from_scale(Vec3::new(0.2, 0.1, -0.15));
    let transforms = [stretched, similarity(Vec3::new(0.25, 0.6, 0.4), 0.12)];
    for (is_emissive, material) in [
        (false, Material::new("glass", glass())),
        (true, lamp(Emission::one_sided(Vec3::ONE))),
    ] {
        let mut scene = cornell();
        let id = scene.add_material(material);
        let ball = Quadric::sphere("ball", id, Affine3A::IDENTITY);
        let mut flat = scene.clone();
        let fine = ball.mesh(128);
        flat.meshes.extend(
            transforms
                .iter()
                .map(|transform| fine.transformed(transform)),
        );
        let mut prototype = Prototype::new("ball", Vec::new());
        prototype.quadrics.push(ball);
        let prototype = scene.add_prototype(prototype);
        scene.instances.extend(transforms.map(|transform| Instance {
            prototype,
            transform,
        }));

        let world = world(scene.clone());
        let count = (world.instance_count(), world.stored_quadric_count());
        assert_eq!(
            count,
            if is_emissive { (0, 1) } else { (2, 1) },
            "emissive parts are copied"
        );
        let shot = Shot {
            max_depth: 12,
            ..Shot::default()
        };
        let means = [&scene, &flat].map(|scene| shot.mean(scene));
        assert!(agree(means[0], means[1]), "{means:?}");
    }
}
