//! Which rays meet which copies.

use light_render::{Ray, Surface};
use light_scene::glam::{Affine3A, Quat, Vec2, Vec3};
use light_scene::{Instance, Material, Mesh, Prototype, Scene};

use super::{flattened, green, grove, world};
use crate::support::room;

/// Rays between points of two lattices in the room.
fn rays() -> impl Iterator<Item = Ray> {
    let lattice = |i: u32, g: Vec3| (g * i as f32).fract();
    (1..40_000).map(move |i| {
        let origin = lattice(i, Vec3::new(0.819_172_5, 0.671_043_6, 0.549_700_5));
        let target = lattice(i, Vec3::new(0.754_877_7, 0.569_840_3, 0.430_159_7));
        let direction = (target - origin).normalize();
        Ray { origin, direction }
    })
}

#[test]
fn rays_meet_what_they_meet_of_copies() {
    let scene = grove(green());
    let (instanced, flat) = (world(&scene), world(&flattened(&scene)));
    let mut met = 0;
    for ray in rays() {
        let hits = [&instanced, &flat].map(|world| world.closest(&ray, None));
        let [Some(a), Some(b)] = hits else {
            panic!("the room is closed: {hits:?}");
        };
        if a.primitive.instance().is_none() {
            // Where two walls meet, either may be hit first.
            assert!(a.p.distance(b.p) < 1e-5, "{} and {}", a.p, b.p);
            continue;
        }
        met += 1;
        assert!(a.p.distance(b.p) < 1e-5, "{} and {}", a.p, b.p);
        assert!(a.n.distance(b.n) < 1e-5, "{} and {}", a.n, b.n);
        assert!(a.ns.distance(b.ns) < 1e-3, "{} and {}", a.ns, b.ns);
        assert!(a.uv.distance(b.uv) < 1e-3, "{} and {}", a.uv, b.uv);
        let light = |surface: &Surface| surface.p + a.n * 0.3;
        let hidden = [(&instanced, &a), (&flat, &b)]
            .map(|(world, surface)| world.occluded(surface, a.n, light(surface)));
        assert_eq!(hidden[0], hidden[1], "the same shadow at {}", a.p);
    }
    assert!(met > 2000, "{met} rays met a tree");
}

#[test]
fn no_ray_meets_the_plane_that_it_starts_on() {
    let mut scene = Scene::default();
    let matt = scene.add_material(Material::diffuse("matt", Vec3::ONE));
    let mut floor = Mesh::new("floor", matt);
    for (x, z) in (0..20u8).flat_map(|x| (0..20u8).map(move |z| (f32::from(x), f32::from(z)))) {
        let corners = room()[0].map(|p| (p + Vec3::new(x, 0.0, z)) * 0.1 + Vec3::splat(0.37));
        floor.push_quad(corners);
    }
    let prototype = scene.add_prototype(Prototype::new("floor", vec![floor]));
    let turn = Quat::from_axis_angle(Vec3::new(2.0, -1.0, 2.0) / 3.0, 0.7);
    for (scale, at) in [
        (Vec3::ONE, Vec3::ZERO),
        (Vec3::new(3.0, 0.01, 0.2), Vec3::new(100.0, -30.0, 7.0)),
        (Vec3::new(-0.02, 5.0, 0.1), Vec3::new(-2000.0, 900.0, 1.0)),
        (Vec3::splat(1e5), Vec3::splat(1e3)),
        (Vec3::splat(1e-3), Vec3::splat(10.0)),
    ] {
        let transform = Affine3A::from_scale_rotation_translation(scale, turn, at)
            * Affine3A::from_quat(turn.inverse());
        scene.instances.push(Instance {
            prototype,
            transform,
        });
    }
    let world = world(&scene);
    let transforms = world.instance_count();
    assert_eq!(transforms, 5, "none is copied");
    for n in 0..world.triangle_count() {
        let triangle = world.primitive(n).expect("there");
        let surface = world.surface(triangle, Vec2::new(0.3, 0.4));
        for k in 0..32u8 {
            let turn = f32::from(k) * 2.4;
            let along = surface.n.any_orthonormal_vector();
            let along = Quat::from_axis_angle(surface.n, turn) * along;
            for side in [surface.n, -surface.n] {
                let wi = (along + side * 0.01 * f32::from(k)).normalize();
                let met = world.closest(&surface.spawn(wi), Some(surface.primitive));
                let met = met.filter(|met| met.primitive.instance() == triangle.instance());
                assert_eq!(met, None, "from {triangle:?} along {wi}");
            }
        }
    }
}
