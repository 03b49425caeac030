//! Solid angles and the shapes that are sampled by them, against double precision and against their
//! own densities.

#![expect(
    clippy::cast_possible_truncation,
    reason = "doubles are rounded to what the tested code takes"
)]

use light_math::float::ONE_MINUS_EPSILON;
use light_math::glam::{Vec2, Vec3};
use light_math::solid_angle;
use light_math::warp::{SphericalRectangle, SphericalTriangle, uniform_triangle};
use light_testkit::{DensityTest, Rng};

use crate::real3::{Real3, cross, dot, length, minus};

/// A triangle in double precision, from the same corners.
struct Exact {
    solid_angle: f64,
    /// By how much a rounding of the corners may move the solid angle: large where the point is
    /// almost in the plane.
    condition: f64,
}

impl Exact {
    fn new(v: [Vec3; 3], p: Vec3) -> Self {
        let r = v.map(|v| minus(v, p));
        let l = r.map(length);
        let cos = l[0] * l[1] * l[2]
            + dot(r[0], r[1]) * l[2]
            + dot(r[1], r[2]) * l[0]
            + dot(r[2], r[0]) * l[1];
        let normal = cross(minus(v[1], v[0]), minus(v[2], v[0]));
        let volume = dot(r[0], normal).abs();
        Self {
            solid_angle: 2.0 * f64::atan2(volume, cos),
            condition: l.into_iter().fold(f64::MAX, f64::min) * length(normal) / volume,
        }
    }
}

/// Triangles of all sizes in front of a point at all distances, some seen edge-on.
fn triangles() -> impl Iterator<Item = ([Vec3; 3], Vec3)> {
    let sizes = [1e-6, 1e-4, 1e-2, 0.3, 1.0, 10.0, 1e3];
    let dists = [1e-2, 0.3, 1.0, 30.0, 1e3];
    let pairs = sizes
        .into_iter()
        .flat_map(move |size| dists.map(|dist| (size, dist)));
    let far = pairs.enumerate().map(|(i, (size, dist))| {
        let tilt = Vec3::new(0.3, -0.2 * (i % 5) as f32, 1.0);
        let at = |x: f32, y: f32| tilt * dist + Vec3::new(x, y, 0.2 * x) * size;
        let p = Vec3::new(0.1, 0.2, -0.05) * dist;
        ([at(0.0, 0.1), at(1.0, 0.2), at(0.3, 0.9)], p)
    });
    // Close to the middle of a triangle, up to almost half of the sphere.
    let near = [1.0, 0.1, 1e-2, 1e-4, 1e-6].into_iter().map(|height| {
        let at = |x: f32, y: f32| Vec3::new(x, y, height);
        ([at(-1.0, -0.8), at(0.9, -1.0), at(0.1, 1.2)], Vec3::ZERO)
    });
    // Where the corners round to the same float there is nothing left to see.
    far.chain(near)
        .filter(|&(v, p)| Exact::new(v, p).solid_angle > 0.0)
}

#[test]
fn solid_angles_keep_their_digits() {
    for (v, p) in triangles() {
        let exact = Exact::new(v, p);
        let error = f64::from(solid_angle::triangle(v, p)) / exact.solid_angle - 1.0;
        let rounding = f64::from(f32::EPSILON) * (8.0 + exact.condition);
        assert!(
            error.abs() < rounding,
            "{v:?} {p}: {error}, allowed {rounding}"
        );
    }
}

#[test]
fn spherical_triangles_of_all_sizes_invert() {
    let mut rng = Rng::new(7);
    for (v, p) in triangles() {
        let exact = Exact::new(v, p);
        let allowed = 8.0 * f32::EPSILON * (4.0 + exact.condition as f32);
        let triangle = SphericalTriangle::new(v, p).expect("a solid angle");
        assert_eq!(
            triangle.solid_angle(),
            solid_angle::triangle(v, p),
            "one formula"
        );
        for _ in 0..200 {
            let u = rng.vec2();
            let b = triangle.sample(u);
            assert!(
                b.min_element() >= 0.0 && (b.element_sum() - 1.0).abs() < 1e-6,
                "inside {b}"
            );
            let error = (triangle.invert(b) - u).abs().max_element();
            assert!(error < allowed, "{v:?} {p} {u}: {error}, allowed {allowed}");
        }
    }
}

#[test]
fn spherical_triangles_are_even() {
    for (v, p) in triangles().filter(|&(v, p)| Exact::new(v, p).condition < 1e4) {
        let triangle = SphericalTriangle::new(v, p).expect("a solid angle");
        let normal = cross(minus(v[1], v[0]), minus(v[2], v[0]));
        // Per unit of the square that maps evenly to the triangle.
        let pdf = |square: Vec2| {
            let b = uniform_triangle::sample(square);
            let r = v.map(|v| minus(v, p));
            let q: Real3 =
                core::array::from_fn(|i| (0..3).map(|k| f64::from(b[k]) * r[k][i]).sum());
            let per_square = 0.5 * dot(q, normal).abs() / length(q).powi(3);
            (per_square * f64::from(triangle.pdf())) as f32
        };
        let sample = |rng: &mut Rng| Some(uniform_triangle::invert(triangle.sample(rng.vec2())));
        DensityTest::default()
            .square(sample, pdf)
            .assert(&format!("triangle {v:?} from {p}"));
    }
}

/// A rectangle in front of the origin, with edges along x and y.
#[derive(Debug)]
struct Rectangle {
    corner: Vec3,
    size: Vec2,
}

impl Rectangle {
    fn spherical(&self) -> SphericalRectangle {
        let (ex, ey) = (Vec3::X * self.size.x, Vec3::Y * self.size.y);
        SphericalRectangle::new(self.corner, ex, ey, Vec3::ZERO).expect("a solid angle")
    }

    /// How coarse places on the rectangle are, seen from the origin.
    fn resolution(&self) -> f32 {
        let largest = self
            .corner
            .abs()
            .max(self.corner + self.size.extend(0.0))
            .max_element();
        f32::EPSILON * (4.0 + largest / self.corner.z)
    }

    /// The solid angle as the sum of four corners, in double precision.
    fn exact(&self) -> f64 {
        let [x0, y0, z] = self.corner.to_array().map(f64::from);
        let [x1, y1] = [x0 + f64::from(self.size.x), y0 + f64::from(self.size.y)];
        let corner = |x: f64, y: f64| f64::atan2(x * y, z * (x * x + y * y + z * z).sqrt());
        corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0)
    }
}

/// Rectangles of all sizes and shapes.
fn rectangles() -> impl Iterator<Item = Rectangle> {
    let sizes = [1e-6, 1e-3, 0.1, 1.0, 30.0];
    let shapes = sizes
        .into_iter()
        .flat_map(move |x| sizes.map(|y| Vec2::new(x, y)));
    shapes.flat_map(|size| {
        [1e-3, 0.1, 1.0].map(|height| {
            let corner = Vec3::new(-0.3 * size.x, 0.2 - 0.3 * size.y, height);
            Rectangle { corner, size }
        })
    })
}

#[test]
fn spherical_rectangles_of_all_sizes_invert() {
    let mut rng = Rng::new(7);
    let us = [0.0, 0.5, ONE_MINUS_EPSILON];
    let ends = us.map(|x| us.map(|y| Vec2::new(x, y))).concat();
    for rectangle in rectangles() {
        let spherical = rectangle.spherical();
        let error = f64::from(spherical.solid_angle()) / rectangle.exact() - 1.0;
        // Four corners of 1e-16 each, over what is left of them.
        let rounding = 1e-6 + 1e-15 / rectangle.exact();
        assert!(error.abs() < rounding, "{rectangle:?}: solid angle {error}");
        for &u in ends.iter().chain(&[(); 100].map(|()| rng.vec2())) {
            let at = spherical.sample(u);
            assert!(
                at.cmpge(Vec2::ZERO).all() && at.cmple(Vec2::ONE).all(),
                "inside {at}"
            );
            let error = (spherical.invert(at) - u).abs().max_element();
            assert!(error < rectangle.resolution(), "{rectangle:?} {u}: {error}");
        }
    }
}

#[test]
fn spherical_rectangles_are_even() {
    for rectangle in rectangles().filter(|r| r.size.max_element() < 100.0 * r.corner.z) {
        let spherical = rectangle.spherical();
        let pdf = |at: Vec2| {
            let r = (rectangle.corner + (rectangle.size * at).extend(0.0))
                .to_array()
                .map(f64::from);
            let area = f64::from(rectangle.size.x) * f64::from(rectangle.size.y);
            (r[2] * area / length(r).powi(3) * f64::from(spherical.pdf())) as f32
        };
        let sample = |rng: &mut Rng| Some(spherical.sample(rng.vec2()));
        DensityTest::default()
            .square(sample, pdf)
            .assert(&format!("{rectangle:?}"));
    }
}

/// A point just above the middle of a large square sees the same at both ends, where 2^-24 is a
/// long way.
#[test]
fn far_ends_of_large_spherical_rectangles_mirror_near_ends() {
    for height in [0.01, 0.03, 0.1] {
        let corner = Vec3::new(-25.0, -25.0, height);
        let size = Vec2::splat(50.0);
        let spherical = Rectangle { corner, size }.spherical();
        for u in [1.0, 2.0, 16.0].map(|x| x * (1.0 - ONE_MINUS_EPSILON)) {
            for axis in [Vec2::X, Vec2::Y] {
                let middle = (Vec2::ONE - axis) * 0.5;
                let near = spherical.sample(middle + axis * u).dot(axis);
                let far = spherical.sample(middle + axis * (1.0 - u)).dot(axis);
                let ratio = (1.0 - far) / near;
                assert!((ratio - 1.0).abs() < 0.01, "{height} {u} {axis}: {ratio}");
            }
        }
    }
}

/// The area below a sample is its part of the whole also where the first guess is far off.
#[test]
fn small_spherical_rectangles_seen_aslant_are_cut_where_u_says() {
    let corner = Vec3::new(-10.0, 0.17, 0.02);
    let size = Vec2::new(0.06, 0.018);
    let whole = Rectangle { corner, size };
    let spherical = whole.spherical();
    for i in 0..200 {
        let u = (i as f32 + 0.5) / 200.0;
        let at = spherical.sample(Vec2::new(u, 0.5));
        let size = Vec2::new(size.x * at.x, size.y);
        let part = Rectangle { corner, size }.exact() / whole.exact();
        let error = part - f64::from(u);
        assert!(error.abs() < 2e-6, "{u}: {error}");
    }
}
