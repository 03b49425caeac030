//! Disks and cylinders are met, seen, and give light as very many triangles do.

use light_render::{PrimitiveId, Ray, World};
use light_scene::glam::{Affine3A, DVec3, Vec2, Vec3};
use light_scene::{
    Alpha, Camera, Color, Emission, Instance, Material, Prototype, Quadric, QuadricFront,
    QuadricKind, Scene,
};

use super::{glass, lamp, similarity, tessellated, world};
use crate::spheres::Finish;
use crate::support::{ALL, Shot, agree, assert_estimators_agree, cornell, plane};

const KINDS: [QuadricKind; 3] = [
    QuadricKind::Disk { inner_radius: 0.0 },
    QuadricKind::Disk { inner_radius: 0.6 },
    QuadricKind::Cylinder { length: 1.5 },
];

/// A room with a quadric of `material` in it, an ordinary lamp above.
pub(crate) fn in_room(kind: QuadricKind, material: Material) -> Scene {
    let mut scene = cornell();
    let material = scene.add_material(material);
    let transform = similarity(Vec3::new(0.6, 0.35, 0.45), 0.25);
    let quadric = Quadric::new("round", material, kind, transform);
    scene.quadrics.push(quadric);
    scene
}

pub(crate) fn assert_looks_tessellated(scene: &Scene, what: &str) {
    let shot = Shot {
        max_depth: 12,
        ..Shot::default()
    };
    let means = [scene, &tessellated(scene, 256)].map(|scene| shot.mean(scene));
    assert!(agree(means[0], means[1]), "{what}: {means:?}");
}

#[test]
fn rays_meet_what_they_meet_of_triangles() {
    for kind in KINDS {
        for front in [QuadricFront::Outside, QuadricFront::Inside] {
            let mut scene = in_room(kind, Material::diffuse("a", Vec3::ONE));
            scene.quadrics[0].front = front;
            assert_rays_agree(scene, &format!("{kind:?}, {front:?}"));
        }
    }
}

/// Rays meet the quadrics of a scene as such where they meet very many triangles instead.
pub(crate) fn assert_rays_agree(mut scene: Scene, what: &str) {
    // Nothing else.
    scene.meshes.clear();
    let [round, fine] = [world(scene.clone()), world(tessellated(&scene, 512))];
    let lattice = |i: u32, g: Vec3| (g * i as f32).fract();
    let (mut met, mut differ) = (0, 0);
    for i in 1..20_000 {
        let origin = lattice(i, Vec3::new(0.819_172_5, 0.671_043_6, 0.549_700_5));
        let target = lattice(i, Vec3::new(0.754_877_7, 0.569_840_3, 0.430_159_7));
        let direction = (target - origin).normalize();
        let ray = Ray { origin, direction };
        let (a, b) = (round.closest(&ray, None), fine.closest(&ray, None));
        let (Some(a), Some(b)) = (a, b) else {
            // At the rims.
            differ += usize::from(a.is_some() != b.is_some());
            continue;
        };
        if a.n.dot(direction).abs() < 0.1 || a.p.distance(b.p) > 0.05 {
            differ += usize::from(a.p.distance(b.p) > 0.05);
            continue;
        }
        met += 1;
        assert!(a.p.distance(b.p) < 1e-3, "{what}: {} and {}", a.p, b.p);
        assert!(a.n.dot(b.n) > 0.999, "{what}: {} and {}", a.n, b.n);
        let seam = (a.uv - b.uv).abs();
        assert!(
            seam.min(1.0 - seam).max_element() < 0.02,
            "{what}: {} and {}",
            a.uv,
            b.uv
        );
    }
    assert!(met > 1000, "{what}: {met} rays met it");
    assert!(differ * 200 < met, "{what}: {differ} of {met} at rims");
}

/// A ray that starts on a disk never comes back; one into a tube meets the wall across, or leaves
/// at an end.
#[test]
fn rays_that_start_on_it_meet_its_other_side_alone() {
    for (center, radius) in [
        (Vec3::ZERO, 1.0),
        (Vec3::new(1e3, -2e3, 5e2), 0.5),
        (Vec3::new(0.0, -1e5, 0.0), 1e5),
        (Vec3::new(3.0, 4.0, 5.0), 1e-3),
    ] {
        for kind in KINDS {
            let mut scene = Scene::default();
            let material = scene.add_material(Material::diffuse("a", Vec3::ONE));
            let transform = similarity(center, radius);
            let quadric = Quadric::new("round", material, kind, transform);
            let axis = Vec3::from(quadric.transform.matrix3.z_axis).normalize();
            scene.quadrics.push(quadric);
            let world = world(scene);
            for k in 0..64u8 {
                // Not at the rims, where rounding decides.
                let at = Vec2::new(f32::from(k) * 0.618, f32::from(k) * 0.755).fract();
                let at = at * 0.8 + 0.1;
                let surface = world.surface(PrimitiveId::new(0), at);
                let from = Some(surface.primitive);
                let around = surface
                    .n
                    .cross(axis)
                    .normalize_or(surface.n.any_orthonormal_vector());
                for slope in [1e-3, 0.01, 0.3, 2.0] {
                    let out = (around + surface.n * slope).normalize();
                    let met = world.closest(&surface.spawn(out), from);
                    assert_eq!(met, None, "nothing outside of {surface:?}");
                    let inward = (around - surface.n * slope).normalize();
                    let met = world.closest(&surface.spawn(inward), from);
                    let chord = 2.0 * radius * -inward.dot(surface.n);
                    if !matches!(kind, QuadricKind::Cylinder { .. }) {
                        assert_eq!(met, None, "a disk is flat");
                    } else if chord * slope > 8.0 * surface.p_error.max_element() {
                        let met = met.expect("the wall across");
                        let error = (met.p.distance(surface.p) - chord).abs();
                        let rounding = surface.p_error.max_element() / slope.min(1.0);
                        assert!(
                            error <= 4.0 * rounding + 1e-5 * radius,
                            "{error} of {chord} at {center}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn pictures_are_those_of_fine_triangles() {
    let grey = Vec3::splat(0.5);
    let masked = |material: Material| Material {
        alpha: Some(Alpha {
            opacity: Color::Constant(Vec3::splat(0.4)),
            cutoff: None,
        }),
        ..material
    };
    for kind in KINDS {
        for material in [
            Material::diffuse("matt", grey),
            Material::new("glass", glass()),
            lamp(Emission::one_sided(Vec3::ONE)),
            lamp(Emission::two_sided(Vec3::ONE)),
            masked(Material::diffuse("masked", grey)),
            masked(lamp(Emission::one_sided(Vec3::ONE))),
        ] {
            let what = format!("{kind:?} of {}", material.name);
            assert_looks_tessellated(&in_room(kind, material), &what);
        }
    }
}

#[test]
fn estimators_agree_on_lamps_of_all_sides() {
    for kind in KINDS {
        for front in [QuadricFront::Outside, QuadricFront::Inside] {
            for emission in [Emission::one_sided, Emission::two_sided] {
                let mut scene = in_room(kind, lamp(emission(Vec3::new(3.0, 2.0, 1.0))));
                scene.quadrics[0].front = front;
                assert_estimators_agree(&scene);
            }
        }
    }
}

/// Direct light on a plane at the origin below a disk of radiance 1 that faces it: that of a cone.
#[test]
fn a_disk_gives_the_irradiance_of_its_cone() {
    const ALBEDO: f32 = 0.6;
    for (height, radius, inner_radius) in [(3.0, 1.0, 0.0), (0.5, 2.0, 0.0), (2.0, 1.5, 0.8)] {
        let mut scene = plane(ALBEDO, 1.0);
        scene.camera = Camera::look_at(Vec3::Y * 0.015, Vec3::ZERO, Vec3::Z, 1e-3).ok();
        let material = scene.add_material(lamp(Emission::one_sided(Vec3::ONE)));
        // From +z downward.
        let turn = Affine3A::from_rotation_x(core::f32::consts::FRAC_PI_2);
        let transform = Affine3A::from_translation(Vec3::Y * height)
            * turn
            * Affine3A::from_scale(Vec3::splat(radius));
        let kind = QuadricKind::Disk { inner_radius };
        let disk = Quadric::new("disk", material, kind, transform);
        scene.quadrics.push(disk);
        let share = |radius: f64| radius * radius / (radius * radius + f64::from(height).powi(2));
        let [outer, inner] = [1.0, f64::from(inner_radius)].map(|r| share(r * f64::from(radius)));
        let expected = f64::from(ALBEDO) * (outer - inner);
        for estimator in ALL {
            let shot = Shot::of_direct_light(estimator);
            let what = format!("{estimator:?}, {height}, {radius}, {inner_radius}");
            shot.assert_mean(&scene, DVec3::splat(expected), &what);
        }
    }
}

#[test]
fn places_may_stretch_what_prototypes_hold() {
    let stretched = similarity(Vec3::new(0.6, 0.6, 0.5), 1.0)
        * Affine3A::from_scale(Vec3::new(0.2, 0.1, -0.15));
    let transforms = [stretched, similarity(Vec3::new(0.25, 0.6, 0.4), 0.12)];
    for kind in KINDS {
        for material in [
            Material::new(
                "glass",
                Finish::Mirror {
                    reflectance: Vec3::ONE,
                },
            ),
            lamp(Emission::one_sided(Vec3::ONE)),
        ] {
            let mut scene = cornell();
            let id = scene.add_material(material);
            let round = Quadric::new("round", id, kind, Affine3A::IDENTITY);
            let mut flat = scene.clone();
            let fine = round.mesh(256);
            let copies = transforms.iter().map(|place| fine.transformed(place));
            flat.meshes.extend(copies);
            let mut prototype = Prototype::new("round", Vec::new());
            prototype.quadrics.push(round);
            let prototype = scene.add_prototype(prototype);
            scene.instances.extend(transforms.map(|transform| Instance {
                prototype,
                transform,
            }));
            assert!(World::new(scene.clone()).is_ok(), "{kind:?}");
            let shot = Shot {
                max_depth: 12,
                ..Shot::default()
            };
            let means = [&scene, &flat].map(|scene| shot.mean(scene));
            assert!(agree(means[0], means[1]), "{kind:?}: {means:?}");
        }
    }
}
