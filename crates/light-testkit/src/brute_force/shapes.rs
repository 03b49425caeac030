use light_math::glam::{Vec2, Vec3};
use light_sources::shape::{ShapeDesc, Triangle};

use super::kind::Kind;
use super::placement::Placement;
use super::surface::{RigidFrame, Surface};
use crate::Rng;

/// A shape of about unit size in its unit, the same in double precision, and points around it.
pub(super) fn random_shape(
    kind: Kind,
    rng: &mut Rng,
    placement: &Placement,
) -> (ShapeDesc, Surface, Vec<Vec3>) {
    let transform = placement.transform();
    let thin = thinness(&mut Rng::new(rng.clone().u64()), placement);
    let frame = || RigidFrame::new(transform);
    let mut length = |low| rng.log_range(low, 1.0) * placement.unit;
    let around = |reach: f32| {
        let origin = Vec3::from(transform.translation);
        vec![origin - reach, origin + reach]
    };
    match kind {
        Kind::Sphere => {
            let radius = length(0.3);
            let desc = ShapeDesc::Sphere { transform, radius };
            (
                desc,
                Surface::Sphere(frame(), radius.into()),
                around(radius),
            )
        }
        Kind::Disk => {
            let radius = length(0.3);
            let inner_radius = [0.0, rng.range(0.01, 0.99) * radius][rng.below(2)];
            let desc = ShapeDesc::Disk {
                transform,
                radius,
                inner_radius,
            };
            let radii = [radius, inner_radius].map(f64::from);
            (desc, Surface::Disk(frame(), radii), around(radius))
        }
        Kind::Cylinder => {
            let (radius, length) = (length(0.02), length(0.02));
            let desc = ShapeDesc::Cylinder {
                transform,
                radius,
                length,
            };
            let sizes = [radius, length].map(f64::from);
            (
                desc,
                Surface::Cylinder(frame(), sizes),
                around(radius + length),
            )
        }
        Kind::Triangle => {
            let [a, b, c] = [(); 3].map(|()| rng.vec3() * 2.0 - 1.0);
            // The third vertex moves toward a point of the line through the others.
            let along = (c - a).dot(b - a) / a.distance_squared(b);
            let points = [a, b, a.lerp(b, along).lerp(c, thin)].map(|p| placement.point(p));
            let uvs = Triangle::DEFAULT_UV.map(|uv| uv.as_dvec2());
            let corners = points.map(|p| p.as_dvec3());
            (
                ShapeDesc::Triangle(points),
                Surface::Triangle(corners, uvs),
                points.to_vec(),
            )
        }
        Kind::Rectangle => {
            let corner = placement.point(Vec3::new(-0.5, -0.5, 0.0));
            let edges = [Vec3::X * length(0.05), Vec3::Y * length(0.05) * thin];
            let edges = edges.map(|edge| placement.turn * edge);
            let desc = ShapeDesc::Rectangle { corner, edges };
            let [a, x, y] = [corner, edges[0], edges[1]].map(|p| p.as_dvec3());
            let y = y - x * (x.dot(y) / x.length_squared());
            let points = vec![corner, corner + edges[0] + edges[1]];
            (desc, Surface::Quad([a, a + x, a + y, a + x + y]), points)
        }
        _ => {
            let bend = [0.0, rng.log_range(1e-4, 2.0)][rng.below(2)];
            // A flat one that folds over itself has two layers that no rounding keeps apart.
            let slant = if bend < 0.1 { 0.24 } else { 0.45 };
            let near = |x: f32, y: f32, rng: &mut Rng| {
                let flat = Vec2::new(x, y) + slant * (rng.vec2() * 2.0 - 1.0);
                let bent = flat.extend(bend * rng.range(-1.0, 1.0));
                bent * Vec3::new(1.0, thin, thin)
            };
            let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
            let corners = corners.map(|(x, y)| placement.point(near(x, y, rng)));
            let exact = corners.map(|p| p.as_dvec3());
            (
                ShapeDesc::Quad(corners),
                Surface::Quad(exact),
                corners.to_vec(),
            )
        }
    }
}

/// The width of a shape as a part of what it is without: of a quarter of the shapes far less than 1,
/// but ten thousand roundings of the coordinates.
fn thinness(rng: &mut Rng, placement: &Placement) -> f32 {
    let least = 1e4 * f32::EPSILON * placement.offset.length();
    match rng.below(4) {
        0 => rng.log_range(1e-3, 1.0).max(least.min(1.0)),
        _ => 1.0,
    }
}
