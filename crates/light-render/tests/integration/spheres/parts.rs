//! Parts of spheres, disks and cylinders are met, seen, and give light as very many triangles do.

use light_scene::glam::{Vec2, Vec3};
use light_scene::{
    Alpha, Color, Emission, Material, QuadricFront, QuadricKind, QuadricPart, Scene,
};

use super::disks_and_cylinders::{assert_looks_tessellated, assert_rays_agree, in_room};
use super::{glass, lamp, world};
use crate::support::assert_estimators_agree;

const KINDS: [QuadricKind; 3] = [
    QuadricKind::Sphere,
    QuadricKind::Disk { inner_radius: 0.3 },
    QuadricKind::Cylinder { length: 1.5 },
];

const PARTS: [QuadricPart; 3] = [
    QuadricPart {
        turn: 0.4,
        v: [0.0, 1.0],
    },
    QuadricPart {
        turn: 1.0,
        v: [0.3, 1.0],
    },
    QuadricPart {
        turn: 0.8,
        v: [0.1, 0.6],
    },
];

fn part_in_room(kind: QuadricKind, part: QuadricPart, material: Material) -> Scene {
    let mut scene = in_room(kind, material);
    scene.quadrics[0].part = Some(part);
    scene
}

#[test]
fn rays_meet_what_they_meet_of_triangles() {
    for kind in KINDS {
        for part in PARTS {
            for front in [QuadricFront::Outside, QuadricFront::Inside] {
                let mut scene = part_in_room(kind, part, Material::diffuse("a", Vec3::ONE));
                scene.quadrics[0].front = front;
                // Larger, since less of it is there.
                scene.quadrics[0].transform.matrix3 *= 1.6;
                assert_rays_agree(scene, &format!("{kind:?}, {part:?}, {front:?}"));
            }
        }
    }
}

#[test]
fn pictures_are_those_of_fine_triangles() {
    let masked = Material {
        alpha: Some(Alpha {
            opacity: Color::Constant(Vec3::splat(0.4)),
            cutoff: None,
        }),
        ..Material::diffuse("masked", Vec3::splat(0.5))
    };
    for kind in KINDS {
        for material in [
            Material::diffuse("matt", Vec3::splat(0.5)),
            Material::new("glass", glass()),
            masked.clone(),
        ] {
            let what = format!("{kind:?} of {}", material.name);
            assert_looks_tessellated(&part_in_room(kind, PARTS[2], material), &what);
        }
    }
}

/// No light has the shape of a part: its triangles emit, each a light.
#[test]
fn parts_that_emit_are_triangles() {
    for kind in KINDS {
        let scene = part_in_room(kind, PARTS[0], lamp(Emission::one_sided(Vec3::ONE)));
        let world = world(scene.clone());
        assert!(world.lights().len() > 60, "{}", world.lights().len());
        assert_eq!(world.stored_quadric_count(), 0, "{kind:?}");
        assert_estimators_agree(&scene);
    }
}

/// What is left out of a part lets rays pass.
#[test]
fn rays_pass_what_a_part_lacks() {
    let mut scene = part_in_room(
        QuadricKind::Sphere,
        PARTS[0],
        Material::diffuse("a", Vec3::ONE),
    );
    scene.meshes.clear();
    let quadric = scene.quadrics[0].clone();
    let world = world(scene);
    let place = |turn: f32| {
        let (sin, cos) = (turn * core::f32::consts::TAU).sin_cos();
        let outward = quadric
            .transform
            .transform_vector3(Vec3::new(cos, sin, 0.0));
        [quadric.center(), quadric.center() + outward * 2.0]
    };
    for (turn, is_there) in [
        (0.01, true),
        (0.2, true),
        (0.39, true),
        (0.41, false),
        (0.9, false),
    ] {
        let [from, to] = place(turn);
        let ray = light_render::Ray {
            origin: from,
            direction: (to - from).normalize(),
        };
        assert_eq!(world.closest(&ray, None).is_some(), is_there, "{turn}");
        if let Some(hit) = world.closest(&ray, None) {
            let expected = Vec2::new(turn / 0.4, 0.5);
            assert!(hit.uv.distance(expected) < 1e-3, "{turn}: {}", hit.uv);
        }
    }
}
