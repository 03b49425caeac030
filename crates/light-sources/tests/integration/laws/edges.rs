//! Rounding of a direction toward the edge of a shape does not make the ray miss.

use light_sources::light_bounds::LightSampleContext;
use light_sources::shape::{Shape, ShapeDesc};
use light_testkit::Rng;

use light_sources::glam::{Affine3A, Quat, Vec2, Vec3};

/// Samples on all edges and corners of the square of random numbers: of those seen well from the
/// front hardly one misses.
#[test]
fn samples_on_edges_hit() {
    let transform = Affine3A::from_rotation_translation(
        Quat::from_rotation_x(0.7) * Quat::from_rotation_y(-1.9),
        Vec3::new(1.0, 20.0, -3.0),
    );
    let [x, y] = [Vec3::X, Vec3::Y].map(|v| transform.transform_vector3(v));
    let corner = transform.transform_point3(Vec3::ZERO);
    let shapes = [
        ShapeDesc::Triangle([corner, corner + x, corner + y * 1.3]),
        ShapeDesc::Rectangle {
            corner,
            edges: [x, y * 2.0],
        },
        ShapeDesc::Quad([corner, corner + x, corner + y, corner + x * 1.6 + y * 1.2]),
        ShapeDesc::Disk {
            transform,
            radius: 0.8,
            inner_radius: 0.4,
        },
        ShapeDesc::Cylinder {
            transform,
            radius: 0.4,
            length: 1.4,
        },
    ];
    let mut rng = Rng::new(81);
    let mut failures = Vec::new();
    for desc in shapes {
        let shape = desc.build().expect("a shape");
        let (mut taken, mut missed) = (0u32, 0u32);
        for _ in 0..2000 {
            let distance = rng.log_range(0.5, 300.0);
            let p = shape.bounds().center() + rng.direction() * (1.0 + distance);
            let ctx = LightSampleContext::medium(p);
            let edge = [0.0, light_math::float::ONE_MINUS_EPSILON][rng.below(2)];
            let along = rng.f32();
            let u = [Vec2::new(edge, along), Vec2::new(along, edge)][rng.below(2)];
            let Some(sample) = shape.sample_toward(&ctx, u) else {
                continue;
            };
            if sample.at.n.dot(sample.wi).abs() < 0.1 {
                continue;
            }
            taken += 1;
            missed += u32::from(shape.pdf_toward(&ctx, sample.wi) == 0.0);
        }
        assert!(taken > 900, "{desc:?}: {taken}");
        if missed * 200 > taken {
            failures.push(format!("{desc:?}: {missed} of {taken} miss"));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

/// Samples at the ends of tubes of any proportion, near the silhouette too, where a rounding of the
/// direction moves the wall by much more than the direction.
#[test]
fn samples_at_the_ends_of_tubes_are_queried_as_sampled() {
    let mut rng = Rng::new(82);
    let (mut taken, mut missed) = (0u32, Vec::new());
    for _ in 0..200_000 {
        let turn = Quat::from_axis_angle(rng.direction(), rng.range(0.0, 6.0));
        let center = rng.direction() * rng.log_range(0.1, 30.0);
        let desc = ShapeDesc::Cylinder {
            transform: Affine3A::from_rotation_translation(turn, center),
            radius: rng.log_range(0.01, 1.0),
            length: rng.log_range(0.01, 1.0),
        };
        let shape = desc.build().expect("a cylinder");
        let ctx = LightSampleContext::medium(rng.direction());
        let beside = [0.0, rng.log_range(1e-7, 0.1), rng.f32()][rng.below(3)];
        let end = [0.0, light_math::float::ONE_MINUS_EPSILON][rng.below(2)];
        let u = Vec2::new((end - beside).abs(), end);
        let Some(sample) = shape.sample_toward(&ctx, u) else {
            continue;
        };
        if sample.at.n.dot(sample.wi).abs() < 1e-3 {
            continue;
        }
        taken += 1;
        if shape.pdf_toward(&ctx, sample.wi) == 0.0 {
            missed.push(format!("{desc:?} from {} at {u}: {sample:?}", ctx.p));
        }
    }
    assert!(taken > 100_000, "{taken}");
    assert!(
        missed.is_empty(),
        "{} of {taken}: {:#?}",
        missed.len(),
        &missed[..missed.len().min(3)]
    );
}
