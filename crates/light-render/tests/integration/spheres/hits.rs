//! Which rays meet a sphere.

use light_render::{PrimitiveId, Ray};
use light_scene::glam::{Vec2, Vec3};
use light_scene::{Material, QuadricFront, Scene};

use super::{add, similarity, tessellated, world};

#[test]
fn rays_meet_what_they_meet_of_triangles() {
    let mut scene = Scene::default();
    add(
        &mut scene,
        Material::diffuse("a", Vec3::ONE),
        similarity(Vec3::new(0.4, 0.5, 0.6), 0.3),
    );
    add(
        &mut scene,
        Material::diffuse("b", Vec3::ONE),
        similarity(Vec3::new(0.8, 0.2, 0.3), 0.2),
    );
    scene.quadrics[1].front = QuadricFront::Inside;
    let [round, fine] = [world(scene.clone()), world(tessellated(&scene, 512))];
    let lattice = |i: u32, g: Vec3| (g * i as f32).fract();
    let mut met = 0;
    for i in 1..20_000 {
        let origin = lattice(i, Vec3::new(0.819_172_5, 0.671_043_6, 0.549_700_5));
        let target = lattice(i, Vec3::new(0.754_877_7, 0.569_840_3, 0.430_159_7));
        let direction = (target - origin).normalize();
        let ray = Ray { origin, direction };
        let (Some(a), Some(b)) = (round.closest(&ray, None), fine.closest(&ray, None)) else {
            continue;
        };
        // Where a ray grazes, a little in height is much along the ray.
        if a.n.dot(direction).abs() < 0.1 || a.p.distance(origin) < 1e-3 {
            continue;
        }
        met += 1;
        assert!(a.p.distance(b.p) < 1e-3, "{} and {}", a.p, b.p);
        assert!(a.n.dot(b.n) > 0.999, "{} and {}", a.n, b.n);
        assert!(a.ns.distance(b.ns) < 5e-3, "{} and {}", a.ns, b.ns);
        let seam = (a.uv - b.uv).abs();
        assert!(
            seam.min(1.0 - seam).max_element() < 0.02,
            "{} and {}",
            a.uv,
            b.uv
        );
    }
    assert!(met > 5000, "{met} rays met a sphere");
}

#[test]
fn rays_that_start_on_a_sphere_meet_its_other_side_alone() {
    let mut met_again = 0;
    for (center, radius) in [
        (Vec3::ZERO, 1.0),
        (Vec3::new(1e3, -2e3, 5e2), 0.5),
        (Vec3::new(0.0, -1e5, 0.0), 1e5),
        (Vec3::new(3.0, 4.0, 5.0), 1e-3),
    ] {
        let mut scene = Scene::default();
        add(
            &mut scene,
            Material::diffuse("ball", Vec3::ONE),
            similarity(center, radius),
        );
        let world = world(scene);
        for k in 0..64u8 {
            let at = Vec2::new(f32::from(k) * 0.618, f32::from(k) * 0.755).fract() * 2.0 - 1.0;
            let surface = world.surface(PrimitiveId::new(0), at);
            for slope in [1e-4, 0.01, 0.3, 2.0] {
                let along = surface.n.any_orthonormal_vector();
                let out = (along + surface.n * slope).normalize();
                let met = world.closest(&surface.spawn(out), Some(surface.primitive));
                assert_eq!(met, None, "nothing outside of {surface:?}");
                let inward = (along - surface.n * slope).normalize();
                let chord = 2.0 * radius * -inward.dot(surface.n);
                if chord * slope < 8.0 * surface.p_error.max_element() {
                    continue;
                }
                met_again += 1;
                let met = world.closest(&surface.spawn(inward), Some(surface.primitive));
                let Some(met) = met else {
                    panic!("the other side, from {surface:?} with {slope}");
                };
                let error = (met.p.distance(surface.p) - chord).abs();
                let rounding = surface.p_error.max_element() / slope.min(1.0);
                assert!(
                    error <= 4.0 * rounding + 1e-5 * radius,
                    "{error} of {chord}"
                );
            }
        }
    }
    assert!(met_again > 500, "{met_again} chords beyond rounding");
}
