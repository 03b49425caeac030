//! Solid angles, and what is sampled by them.

use core::f32::consts::TAU;

use light_math::float::ONE_MINUS_EPSILON;
use light_math::glam::{Vec2, Vec3};
use light_math::solid_angle;
use light_math::warp::{SphericalRectangle, SphericalTriangle};
use light_testkit::Rng;

/// A triangle covers no solid angle from a point in its plane, inside of it or not.
#[test]
fn a_plane_that_holds_the_point_shows_nothing() {
    let mut rng = Rng::new(56);
    for _ in 0..2000 {
        // Coordinates of few digits, so that the plane is exact.
        let mut grid = || (rng.range(-64.0, 64.0)).round() / 16.0;
        let v = [(); 3].map(|()| Vec3::new(grid(), grid(), 0.5));
        let p = v[0] * 0.25 + v[1] * 0.5 + v[2] * 0.25;
        assert_eq!(solid_angle::triangle(v, p), 0.0, "{v:?} from {p}");
        assert_eq!(SphericalTriangle::new(v, p), None, "{v:?} from {p}");
        let corner = v[0];
        assert_eq!(solid_angle::triangle(v, corner), 0.0, "{v:?} from {corner}");
    }
    let rectangle = SphericalRectangle::new(Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(0.5, 0.5, 0.0));
    assert_eq!(rectangle, None, "a rectangle");
}

/// Almost in the plane of a triangle, above its inside and beside it: all of half a sphere, or next
/// to nothing.
#[test]
fn a_plane_that_almost_holds_the_point_shows_half_a_sphere_or_nothing() {
    let v = [
        Vec3::new(-1.0, -0.8, 0.0),
        Vec3::new(0.9, -1.0, 0.0),
        Vec3::new(0.1, 1.2, 0.0),
    ];
    for height in [1e-5, 1e-10, 1e-20, 1e-30] {
        let inside = solid_angle::triangle(v, Vec3::Z * height);
        assert!((inside - TAU).abs() < 1e-4, "inside at {height}: {inside}");
        let beside = solid_angle::triangle(v, Vec3::new(3.0, 0.0, height));
        assert!(
            (0.0..1e-4).contains(&beside),
            "beside at {height}: {beside}"
        );
        let triangle = SphericalTriangle::new(v, Vec3::Z * height);
        let mut rng = Rng::new(57);
        for _ in 0..if triangle.is_some() { 200 } else { 0 } {
            let b = triangle.map_or(Vec3::NAN, |t| t.sample(rng.vec2()));
            let valid = b.min_element() >= 0.0 && (b.element_sum() - 1.0).abs() < 1e-6;
            assert!(valid, "{b} at {height}");
        }
    }
}

/// Rectangles of any size seen from any height, down to where squares of lengths vanish: places are
/// places.
#[test]
fn rectangles_at_the_ends_of_the_range_are_sampled_within() {
    let us = [0.0, 1e-7, 0.3, 0.5, ONE_MINUS_EPSILON];
    let mut seen = 0;
    for size in [1e-15, 1e-6, 1.0, 1e6, 1e12] {
        for aspect in [1.0, 1e-4, 1e4] {
            for height in [1e-25, 1e-18, 1e-12, 1e-6, 1.0, 1e6] {
                for offset in [-2.0, -1.0, -0.5, 0.0, 3.0] {
                    let corner = Vec3::new(offset * size, offset * size * aspect, height);
                    let edges = [Vec3::X * size, Vec3::Y * (size * aspect)];
                    let [x, y] = edges;
                    let Some(rectangle) = SphericalRectangle::new(corner, x, y, Vec3::ZERO) else {
                        continue;
                    };
                    seen += 1;
                    assert!(rectangle.pdf() > 0.0, "{corner} {edges:?}");
                    for u in us.iter().flat_map(|&x| us.map(|y| Vec2::new(x, y))) {
                        let at = rectangle.sample(u);
                        let back = rectangle.invert(at);
                        let unit = |p: Vec2| p.cmpge(Vec2::ZERO).all() && p.cmple(Vec2::ONE).all();
                        assert!(
                            unit(at) && unit(back),
                            "{corner} {edges:?} {u}: {at} {back}"
                        );
                    }
                }
            }
        }
    }
    assert!(seen > 200, "{seen} rectangles");
}

/// A scene in another unit of length has the same solid angles and the same places: to the bit, for
/// units that are powers of two.
#[test]
fn rectangles_are_sampled_alike_in_every_unit() {
    let seen = |unit: f32| {
        let corner = Vec3::new(-0.4, -0.3, 0.3) * unit;
        let edges = [Vec3::X * unit, Vec3::Y * (0.8 * unit)];
        SphericalRectangle::new(corner, edges[0], edges[1], Vec3::ZERO).expect("it is seen")
    };
    let plain = seen(1.0);
    for exponent in (-60..=60).step_by(4) {
        let scaled = seen(2.0f32.powi(exponent));
        assert_eq!(scaled.solid_angle(), plain.solid_angle(), "2^{exponent}");
        let mut rng = Rng::new(58);
        for _ in 0..50 {
            let u = rng.vec2();
            let at = scaled.sample(u);
            assert_eq!(at, plain.sample(u), "{u}, 2^{exponent}");
            assert_eq!(scaled.invert(at), plain.invert(at), "{u}, 2^{exponent}");
        }
    }
}
