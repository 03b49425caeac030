//! Shapes in units of length from 1e-12 to 1e12: nothing but the unit changes. And boxes of shapes
//! that are hardly tilted.

use light_sources::glam::{Affine3A, Quat, Vec2, Vec3};
use light_sources::light_bounds::LightSampleContext;
use light_sources::shape::{AnyShape, Shape, ShapeDesc};

/// Flat and twisted shapes, in this unit.
fn shapes(unit: f32) -> [AnyShape; 4] {
    [
        ShapeDesc::Triangle([Vec3::NEG_X, Vec3::X, Vec3::Y].map(|p| p * unit)),
        ShapeDesc::Rectangle {
            corner: Vec3::new(-1.0, -0.5, 0.0) * unit,
            edges: [Vec3::X * 2.0, Vec3::Y].map(|edge| edge * unit),
        },
        ShapeDesc::Quad(
            [Vec3::NEG_X, Vec3::X, Vec3::Y, Vec3::new(1.5, 1.0, 0.0)].map(|p| p * unit),
        ),
        ShapeDesc::Quad(
            [Vec3::NEG_X, Vec3::X, Vec3::Y, Vec3::new(1.5, 1.0, 0.7)].map(|p| p * unit),
        ),
    ]
    .map(|desc| desc.build().expect("a shape"))
}

#[test]
fn shapes_are_sampled_and_met_alike_in_every_unit() {
    for exponent in [-40, -36, -20, -3, 3, 20, 31, 33, 40] {
        let unit = 2.0f32.powi(exponent);
        for (plain, scaled) in shapes(1.0).into_iter().zip(shapes(unit)) {
            let area = plain.area() * unit * unit;
            assert!(
                (scaled.area() / area - 1.0).abs() < 1e-6,
                "2^{exponent}: {scaled:?}"
            );
            for (i, u) in
                (0..16u8).map(|i| (i, Vec2::new(f32::from(i), f32::from(i * 7 % 16)) / 16.0))
            {
                let p = Vec3::new(0.3, -0.2, 0.4 + 0.1 * f32::from(i));
                let [ctx, scaled_ctx] = [p, p * unit].map(LightSampleContext::medium);
                let found = scaled.sample_toward(&scaled_ctx, u).expect("a sample");
                let expected = plain.sample_toward(&ctx, u).expect("a sample");
                assert!(
                    found.wi.distance(expected.wi) < 1e-5
                        && (found.pdf / expected.pdf - 1.0).abs() < 1e-4,
                    "2^{exponent}, {u}: {found:?}, {expected:?}"
                );
                let hit = scaled.hit(p * unit, found.wi).expect("it is met");
                let off = (hit.p / unit).distance(expected.at.p);
                assert!(off < 1e-5, "2^{exponent}, {u}: off by {off} of {scaled:?}");
            }
        }
    }
}

/// However little they are tilted: next to 1 a component of the axis has no digits left that tell.
#[test]
fn boxes_hold_shapes_that_are_hardly_tilted() {
    for tilt in [1e-7, 1e-5, 2.4e-4, 1e-3, 0.1] {
        let transform = Affine3A::from_quat(Quat::from_rotation_x(tilt));
        let (radius, length) = (1.0, 0.001);
        for desc in [
            ShapeDesc::Disk {
                transform,
                radius,
                inner_radius: 0.0,
            },
            ShapeDesc::Cylinder {
                transform,
                radius,
                length,
            },
        ] {
            let shape = desc.build().expect("a shape");
            let reach = shape.bounds().max.z;
            let rim = transform.transform_point3(Vec3::Y).z.abs();
            assert!(reach >= rim, "{tilt}: {reach} of {rim}, {desc:?}");
        }
    }
}
