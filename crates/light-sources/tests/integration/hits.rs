//! A short ray to a point of a shape meets the shape there, from both sides; one that leads away
//! from it meets nothing.

use light_sources::SurfacePoint;
use light_sources::glam::{Affine3A, Vec2, Vec3};
use light_sources::shape::{AnyShape, Shape, ShapeDesc};
use light_testkit::Rng;

fn shapes() -> [ShapeDesc; 7] {
    let transform =
        Affine3A::from_axis_angle(Vec3::ONE.normalize(), 1.0) * Affine3A::from_translation(Vec3::Y);
    let radius = 1.5;
    [
        ShapeDesc::Triangle([Vec3::ZERO, Vec3::X, Vec3::new(0.2, 1.0, 0.5)]),
        ShapeDesc::Rectangle {
            corner: Vec3::Z,
            edges: [Vec3::X, 2.0 * Vec3::Y],
        },
        ShapeDesc::Quad([Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.5)]),
        ShapeDesc::Sphere { transform, radius },
        ShapeDesc::Disk {
            transform,
            radius,
            inner_radius: 0.0,
        },
        ShapeDesc::Disk {
            transform,
            radius,
            inner_radius: 1.0,
        },
        ShapeDesc::Cylinder {
            transform,
            radius,
            length: 2.0,
        },
    ]
}

/// Calls `each` with shapes and so many points of each.
fn each_point(seed: u64, count: u32, mut each: impl FnMut(&ShapeDesc, &AnyShape, &SurfacePoint)) {
    let mut rng = Rng::new(seed);
    for desc in shapes() {
        let shape = desc.build().expect("a shape");
        for _ in 0..count {
            let u = Vec2::new(rng.range(0.01, 0.99), rng.range(0.01, 0.99));
            each(&desc, &shape, &shape.sample(u).expect("a point").at);
        }
    }
}

#[test]
fn rays_meet_the_nearest_point_from_both_sides() {
    /// Less than any shape is thick.
    const NEAR: f32 = 0.05;
    each_point(1, 200, |desc, shape, at| {
        for side in [1.0, -1.0] {
            let outward = side * at.n;
            let origin = at.p + NEAR * outward;
            let hit = shape.hit(origin, -outward);
            let hit = hit.unwrap_or_else(|| panic!("{desc:?}: {at:?} is missed"));
            assert!(hit.p.abs_diff_eq(at.p, 1e-5), "{desc:?}: {hit:?}, {at:?}");
            assert!(hit.n.abs_diff_eq(at.n, 1e-3), "{desc:?}: {hit:?}, {at:?}");
            assert!(hit.uv.abs_diff_eq(at.uv, 1e-3), "{desc:?}: {hit:?}, {at:?}");
        }
        let away = shape.hit(at.p + NEAR * at.n, at.n);
        assert_eq!(away, None, "{desc:?}: away from the front");
    });
}

/// A sphere that is not turned is one around its centre; a point of a disk or of a tube is that of
/// its surface parameters.
#[test]
fn short_names_and_parameters() {
    each_point(2, 50, |_, shape, at| {
        let found = match shape {
            AnyShape::Disk(disk) => disk.at_uv(at.uv),
            AnyShape::Cylinder(tube) => tube.at_uv(at.uv),
            _ => return,
        };
        assert!(found.p.abs_diff_eq(at.p, 1e-5), "{found:?}, {at:?}");
        assert!(found.n.abs_diff_eq(at.n, 1e-5), "{found:?}, {at:?}");
        assert_eq!(found.uv, at.uv, "{found:?}");
    });
    let sphere = ShapeDesc::sphere(Vec3::X, 0.5).build().expect("a sphere");
    let hit = sphere.hit(Vec3::ZERO, Vec3::X).expect("its near side");
    assert!(hit.p.abs_diff_eq(Vec3::new(0.5, 0.0, 0.0), 1e-6), "{hit:?}");
}

/// From a point inside, and from beyond both walls.
#[test]
fn closed_shapes_are_met_where_they_are_nearest() {
    let transform = Affine3A::IDENTITY;
    let sphere = ShapeDesc::Sphere {
        transform,
        radius: 2.0,
    };
    let cylinder = ShapeDesc::Cylinder {
        transform,
        radius: 2.0,
        length: 1.0,
    };
    for desc in [sphere, cylinder] {
        let shape = desc.build().expect("a shape");
        let x = |origin: f32, direction: Vec3| {
            let hit = shape.hit(Vec3::new(origin, 0.0, 0.0), direction);
            hit.map(|at| at.p.x)
        };
        assert_eq!(x(5.0, -Vec3::X), Some(2.0), "{desc:?}: the first wall");
        assert_eq!(x(0.0, -Vec3::X), Some(-2.0), "{desc:?}: from inside");
        assert_eq!(x(5.0, Vec3::X), None, "{desc:?}: behind");
        let beside = shape.hit(Vec3::new(5.0, 3.0, 0.0), -Vec3::X);
        assert_eq!(beside, None, "{desc:?}: beside");
    }
}
