//! Flat shapes do not light their own plane, on either side of which rounding puts its points.

use light_bounds::LightSampleContext;
use light_sources::glam::{Affine3A, Quat, Vec2, Vec3};
use light_sources::shape::{AnyShape, Shape, ShapeDesc};
use light_testkit::Rng;

/// One of each kind, of about the size `scale`, turned and moved.
fn shapes(place: Vec3, scale: f32) -> [AnyShape; 5] {
    let turn = Quat::from_axis_angle(Vec3::new(1.0, 2.0, -2.0) / 3.0, 1.1);
    let transform = Affine3A::from_rotation_translation(turn, place);
    let point = |x, y| transform.transform_point3(Vec3::new(x, y, 0.0) * scale);
    let disk = |inner_radius| ShapeDesc::Disk {
        transform,
        radius: scale,
        inner_radius,
    };
    let [a, b, c, d] = [
        point(0.0, 0.0),
        point(1.0, 0.0),
        point(0.0, 0.7),
        point(0.9, 1.0),
    ];
    [
        ShapeDesc::Triangle([a, b, c]),
        ShapeDesc::Rectangle {
            corner: a,
            edges: [b - a, c - a],
        },
        ShapeDesc::Quad([a, b, c, d]),
        disk(0.0),
        disk(0.4 * scale),
    ]
    .map(|desc| desc.build().expect("a shape"))
}

/// The irradiance by radiance 1, by light samples and by directions.
fn irradiances(shape: &AnyShape, ctx: &LightSampleContext, rng: &mut Rng) -> [f32; 2] {
    let n = ctx.n().expect("a surface");
    let count = 400;
    let mut sums = [0.0; 2];
    for _ in 0..count {
        if let Some(sample) = shape.sample_toward(ctx, Vec2::new(rng.f32(), rng.f32())) {
            sums[0] += sample.wi.dot(n).max(0.0) / sample.pdf;
        }
        let wi: Vec3 = rng.direction();
        if shape.pdf_toward(ctx, wi) > 0.0 {
            sums[1] += wi.dot(n).max(0.0) * 4.0 * core::f32::consts::PI;
        }
    }
    sums.map(|sum| sum / count as f32)
}

#[test]
fn a_flat_emitter_does_not_light_itself() {
    let mut rng = Rng::new(8);
    for (place, scale) in [(0.0, 1.0), (3.0, 0.2), (700.0, 1.0), (-2000.0, 50.0)] {
        let place = Vec3::new(1.0, -0.6, 0.8) * place;
        for shape in shapes(place, scale) {
            for _ in 0..100 {
                let u = Vec2::new(rng.range(0.05, 0.95), rng.range(0.05, 0.95));
                let at = shape.sample(u).expect("a point").at;
                let side = if rng.below(2) == 0 { at.n } else { -at.n };
                let n = (side + 1e-4 * rng.direction()).normalize();
                let on_it = LightSampleContext::surface(at.p, n, n);
                // A ray tracer knows by how much it has missed the plane.
                let error = 1e-5 * scale;
                let missed = at.p + at.n * rng.range(-error, error);
                let near_it = LightSampleContext::surface(missed, n, n);
                for ctx in [on_it, near_it.with_error(Vec3::splat(error))] {
                    let found = irradiances(&shape, &ctx, &mut rng);
                    assert_eq!(found, [0.0; 2], "{shape:?} at {at:?}");
                }
            }
        }
    }
}

/// Two other surfaces at the same points: one that leans by five degrees, and one a little before
/// the emitter that faces it.
#[test]
fn surfaces_beside_and_before_a_flat_emitter_keep_its_light() {
    let mut rng = Rng::new(9);
    for shape in shapes(Vec3::new(3.0, -2.0, 1.0), 1.0) {
        for _ in 0..20 {
            let u = Vec2::new(rng.range(0.3, 0.7), rng.range(0.3, 0.7));
            let at = shape.sample(u).expect("a point").at;
            let before = LightSampleContext::surface(at.p + 1e-4 * at.n, -at.n, -at.n);
            let leaning = (at.n.any_orthonormal_vector() * 0.09 - at.n).normalize();
            let beside = LightSampleContext::surface(at.p + 1e-4 * at.n, leaning, leaning);
            for ctx in [before, beside] {
                // Points of a disk are chosen by area, of which hardly any are so near.
                let [by_light, by_directions] = irradiances(&shape, &ctx, &mut rng);
                assert!(by_light > 0.0, "{shape:?} at {at:?}");
                let error = (by_directions / core::f32::consts::PI - 1.0).abs();
                assert!(error < 0.3, "{shape:?} at {at:?}: {by_directions}");
            }
        }
    }
}
