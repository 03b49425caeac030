use core::f64::consts::PI;

use lights::glam::Vec2;
use lights::math::fraction::to_f32;
use lights::math::warp::{uniform_sphere, uniform_triangle};
use lights::math::{Frame, octahedral, warp};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::scene_receiver::SceneReceiver;
use crate::{PrimitiveId, QuadricShape, World};

/// Primitives whose areas are held at most; of more, only some are looked at.
const MOST_PRIMITIVES: usize = 1 << 20;

/// Points that may be tried for each that is wanted: some lie on lamps, on mirrors, and where a
/// part of a quadric is not.
const TRIES: usize = 8;

/// Up to `count` points on the surfaces of `world` that scatter light, uniform in area and in
/// random order, each seen from a direction of its own on the front, cosine-distributed. None if no
/// surface scatters light into more than single directions. A function of `seed`.
pub(super) fn on_surfaces(world: &World, count: usize, seed: u64) -> Vec<SceneReceiver> {
    let all = world.triangle_count() + world.quadric_count();
    let step = all.div_ceil(MOST_PRIMITIVES).max(1);
    let mut sum = 0.0;
    let ends: Vec<(PrimitiveId, f64)> = world
        .primitives()
        .step_by(step)
        .map(|primitive| {
            sum += area(world, primitive);
            (primitive, sum)
        })
        .collect();
    if !(sum > 0.0 && sum.is_finite()) {
        return Vec::new();
    }
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let mut number = || to_f32(rng.next_u64());
    let mut receivers = Vec::with_capacity(count);
    for key in 0..count * TRIES {
        if receivers.len() == count {
            break;
        }
        let place = f64::from(number()) * sum;
        let at = ends.partition_point(|&(_, end)| end <= place);
        let Some(&(primitive, _)) = ends.get(at) else {
            continue;
        };
        let coords = coords(world, primitive, Vec2::new(number(), number()));
        if !world.is_there(primitive, coords) {
            continue;
        }
        let surface = world.surface(primitive, coords);
        let wo = warp::cosine_hemisphere::sample(Vec2::new(number(), number()));
        let wo = Frame::from_z(surface.n).from_local(wo);
        receivers.extend(SceneReceiver::new(world, surface, wo, key as u64));
    }
    receivers
}

/// The area of a primitive in the scene, that of the whole for a part of a quadric.
fn area(world: &World, primitive: PrimitiveId) -> f64 {
    let p = |x, y| world.surface(primitive, Vec2::new(x, y)).p.as_dvec3();
    // Transforms of quadrics keep their form.
    let diameter = |v| p(0.5, v).distance(p(0.0, v));
    let area = match world.quadric(primitive) {
        // The middle and a corner of the square are opposite points.
        Some(QuadricShape::Sphere(_)) => PI * p(0.5, 0.5).distance_squared(p(0.0, 0.0)),
        Some(QuadricShape::Disk(_)) => {
            let [outer, inner] = [diameter(0.0), diameter(1.0)];
            0.25 * PI * (outer * outer - inner * inner)
        }
        Some(QuadricShape::Cylinder(_)) => PI * diameter(0.0) * p(0.0, 1.0).distance(p(0.0, 0.0)),
        None => {
            let origin = p(0.0, 0.0);
            0.5 * (p(1.0, 0.0) - origin).cross(p(0.0, 1.0) - origin).length()
        }
    };
    if area.is_finite() { area } else { 0.0 }
}

/// The coordinates of a point of a primitive, uniform in area; of a part of a quadric they may be
/// those of a point of the rest.
fn coords(world: &World, primitive: PrimitiveId, u: Vec2) -> Vec2 {
    match world.quadric(primitive) {
        Some(QuadricShape::Sphere(_)) => octahedral::to_square(uniform_sphere::sample(u)),
        Some(QuadricShape::Disk(disk)) => {
            let inner = disk.inner_radius() / disk.radius();
            let r = (inner * inner + (1.0 - inner * inner) * u.y).sqrt();
            Vec2::new(u.x, (1.0 - r) / (1.0 - inner))
        }
        Some(QuadricShape::Cylinder(_)) => u,
        None => {
            let weights = uniform_triangle::sample(u);
            Vec2::new(weights.y, weights.z)
        }
    }
}
