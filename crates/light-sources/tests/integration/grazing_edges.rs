//! Points at the edge of a surface, seen from almost within it: what is sampled there is found
//! again by its direction.

use light_bounds::LightSampleContext;
use light_math::float::ONE_MINUS_EPSILON;
use light_math::glam::{Affine3A, Quat, Vec2, Vec3};
use light_sources::shape::{AnyShape, Shape, ShapeDesc};
use light_testkit::Rng;

fn shapes() -> [(&'static str, AnyShape); 6] {
    let [a, b, c] = [
        Vec3::new(-1.0, 0.5, 2.0),
        Vec3::new(1.0, 0.5, 2.0),
        Vec3::new(-1.0, 1.1, 2.8),
    ];
    let disk = |inner_radius| ShapeDesc::Disk {
        transform: Affine3A::from_rotation_x(0.4),
        radius: 0.8,
        inner_radius,
    };
    let rectangle = ShapeDesc::Rectangle {
        corner: a,
        edges: [b - a, c - a],
    };
    [
        ("triangle", ShapeDesc::Triangle([a, b, c])),
        ("rectangle", rectangle),
        ("flat patch", ShapeDesc::Quad([a, b, c, b + c - a])),
        (
            "twisted patch",
            ShapeDesc::Quad([a, b, c, Vec3::new(1.0, 1.5, 2.7)]),
        ),
        ("disk", disk(0.0)),
        ("ring", disk(0.3)),
    ]
    .map(|(name, desc)| (name, desc.build().expect("a shape")))
}

/// A point of the unit square with one number at its end.
fn edge(rng: &mut Rng) -> Vec2 {
    let end = [
        0.0,
        f32::MIN_POSITIVE,
        ONE_MINUS_EPSILON - f32::EPSILON / 2.0,
        ONE_MINUS_EPSILON,
    ][rng.below(4)];
    let u = Vec2::new(end, rng.f32());
    if rng.below(2) == 0 {
        u
    } else {
        Vec2::new(u.y, u.x)
    }
}

/// A unit vector that leaves a surface at the given cosine.
fn grazing(n: Vec3, cos_theta: f32, rng: &mut Rng) -> Vec3 {
    let (x, y) = n.any_orthonormal_pair();
    let (sin, cos) = (rng.f32() * core::f32::consts::TAU).sin_cos();
    (x * cos + y * sin) * (1.0 - cos_theta * cos_theta).sqrt() + n * cos_theta
}

#[test]
fn samples_at_edges_are_found_again_at_grazing_angles() {
    let mut rng = Rng::new(7);
    for (name, shape) in shapes() {
        let mut compared = 0;
        for _ in 0..40_000 {
            let u = edge(&mut rng);
            let Some(on) = shape.sample(u) else { continue };
            let cos_theta = 10f32.powf(-0.5 - 2.0 * rng.f32());
            let distance = 0.5 + 9.5 * rng.f32();
            let p = on.at.p + grazing(on.at.n, cos_theta, &mut rng) * distance;
            let ctx = LightSampleContext::medium(p);
            let Some(sample) = shape.sample_toward(&ctx, u) else {
                continue;
            };
            let cos_theta = sample.at.n.dot(sample.wi).abs();
            if cos_theta < 2e-3 {
                continue;
            }
            compared += 1;
            let pdf = shape.pdf_toward(&ctx, sample.wi);
            // A direction that is turned by a rounding meets another place, where a bent surface
            // has another normal.
            let bend = if name == "twisted patch" { 2e-6 } else { 0.0 };
            let tolerance = (2e-5 + bend / cos_theta) / cos_theta;
            assert!(
                (pdf - sample.pdf).abs() <= tolerance * sample.pdf,
                "{name}: queried {pdf}, {sample:?} for {u} from {p}, cosine {cos_theta}"
            );
        }
        assert!(compared > 20_000, "{name}: {compared} compared");
    }
}

/// Closer to a surface than its coordinates can say, rounding decides where a direction leads: a
/// sample carries the density of the direction that it has.
#[test]
fn samples_from_beside_a_surface_have_the_density_of_their_direction() {
    let mut rng = Rng::new(11);
    for (name, shape) in shapes() {
        if !matches!(name, "rectangle" | "triangle" | "flat patch") {
            continue;
        }
        let mut compared = 0;
        for _ in 0..20_000 {
            let Some(on) = shape.sample(rng.vec2()) else {
                continue;
            };
            let side = if rng.below(2) == 0 { 1.0 } else { -1.0 };
            let p = on.at.p + on.at.n * (side * rng.log_range(1e-7, 1e-4));
            let n = rng.direction();
            let ctx = LightSampleContext::surface(p, n, n);
            let Some(sample) = shape.sample_toward(&ctx, rng.vec2()) else {
                continue;
            };
            if sample.at.n.dot(sample.wi).abs() < 0.01 {
                continue;
            }
            compared += 1;
            let pdf = shape.pdf_toward(&ctx, sample.wi);
            assert!(
                (pdf - sample.pdf).abs() <= 2e-3 * sample.pdf,
                "{name}: queried {pdf}, {sample:?} from {p}"
            );
        }
        assert!(compared > 1000, "{name}: {compared} compared");
    }
}

/// From within the plane of a flat shape, up to rounding, there is hardly anything to see, and what
/// is sampled has the density that is queried, which rounding makes any number.
#[test]
fn samples_from_within_the_plane_have_the_density_of_their_direction() {
    let mut rng = Rng::new(12);
    let (mut sampled, mut total) = (0, 0);
    for trial in 0..400u16 {
        let turn = Quat::from_axis_angle(rng.direction(), f32::from(trial));
        let [x, y] = [Vec3::X, Vec3::Y].map(|v| turn * v);
        let shapes = [
            ShapeDesc::Triangle([Vec3::ZERO, x, y]),
            ShapeDesc::Rectangle {
                corner: Vec3::ZERO,
                edges: [x, y],
            },
            ShapeDesc::Quad([Vec3::ZERO, x, y, 0.8 * x + 0.9 * y]),
            ShapeDesc::Disk {
                transform: Affine3A::from_quat(turn),
                radius: 1.0,
                inner_radius: 0.0,
            },
        ];
        let places = [Vec3::ZERO, 0.3 * x + 0.2 * y, 2.0 * x - 0.7 * y];
        for (desc, p) in shapes.iter().flat_map(|s| places.map(|p| (s, p))) {
            let shape = desc.build().expect("a shape");
            let ctx = LightSampleContext::medium(p);
            for _ in 0..20 {
                total += 1;
                let Some(sample) = shape.sample_toward(&ctx, rng.vec2()) else {
                    continue;
                };
                sampled += 1;
                let pdf = shape.pdf_toward(&ctx, sample.wi);
                assert_eq!(pdf, sample.pdf, "{shape:?}: {sample:?} from {p}");
            }
        }
    }
    assert!(sampled > 0, "none of {total}");
}

/// Just above the inside of a flat shape it covers a half space, however rounding sees it: samples
/// have the density of that, and none a tiny one.
#[test]
fn samples_from_just_above_a_flat_shape_cover_a_half_space() {
    const HALF_SPACE: f64 = core::f64::consts::TAU;
    let mut rng = Rng::new(14);
    for height in [0.0, 1e-7, 1e-6, 1e-5] {
        let (mut sum, mut count) = (0.0, 0);
        for _ in 0..2000 {
            let x = rng.direction();
            let (y, z) = x.any_orthonormal_pair();
            let corner = rng.direction();
            let p = corner + x * rng.range(0.1, 0.9) + y * rng.range(0.1, 0.9) + z * height;
            let ctx = LightSampleContext::medium(p);
            let far = corner + (x + y) * 1.5;
            let quad = ShapeDesc::Quad([corner, corner + x, corner + y, far]);
            let edges = [x, y];
            for desc in [quad, ShapeDesc::Rectangle { corner, edges }] {
                let shape = desc.build().expect("a shape");
                for _ in 0..50 {
                    count += 1;
                    if let Some(sample) = shape.sample_toward(&ctx, rng.vec2()) {
                        let weight = 1.0 / f64::from(sample.pdf);
                        assert!(weight < 300.0, "{desc:?} from {p}: {sample:?}");
                        let pdf = shape.pdf_toward(&ctx, sample.wi);
                        assert_eq!(pdf, sample.pdf, "{desc:?}: {sample:?}");
                        sum += weight;
                    }
                }
            }
        }
        let mean = sum / f64::from(count);
        assert!(mean < 1.02 * HALF_SPACE, "{mean} sr from {height}");
        // From within the plane, rounding decides whether anything is seen.
        let least = if height > 1e-6 {
            0.98 * HALF_SPACE
        } else {
            0.0
        };
        assert!(mean > least, "{mean} sr from {height}");
    }
}
