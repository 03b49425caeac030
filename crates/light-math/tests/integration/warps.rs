//! The laws of warps: samples follow the density, the density of a sample is positive, inverses
//! lead back.

use light_math::glam::{Vec2, Vec3};
use light_math::warp::{
    Equiangular, SphericalRectangle, SphericalTriangle, bilinear, concentric_disk,
    cosine_hemisphere, linear, polar_disk, smoothstep, uniform_cone, uniform_hemisphere,
    uniform_sphere, uniform_triangle,
};
use light_math::{float, solid_angle};
use light_testkit::{Cap, DensityTest, Rng, edge_cases};
use proptest::prelude::*;

const TEST: DensityTest = DensityTest {
    samples: 1 << 15,
    grid: [12, 12],
    seed: 1,
    tolerance: 1e-4,
};

#[test]
fn disks_are_even() {
    let square = [Vec2::splat(-1.0), Vec2::ONE];
    for (what, sample) in [
        ("concentric", concentric_disk::sample as fn(Vec2) -> Vec2),
        ("polar", polar_disk::sample),
    ] {
        TEST.rectangle(square, |rng| Some(sample(rng.vec2())), concentric_disk::pdf)
            .assert(what);
    }
}

#[test]
fn directions_follow_their_densities() {
    TEST.sphere(
        |rng| Some(uniform_sphere::sample(rng.vec2())),
        |_| uniform_sphere::pdf(),
    )
    .assert("sphere");
    TEST.sphere(
        |rng| Some(uniform_hemisphere::sample(rng.vec2())),
        |w| uniform_hemisphere::pdf(w.z),
    )
    .assert("uniform hemisphere");
    TEST.sphere(
        |rng| Some(cosine_hemisphere::sample(rng.vec2())),
        |w| cosine_hemisphere::pdf(w.z),
    )
    .assert("cosine hemisphere");
    for angle in [3.0f32, 1.0, 0.1] {
        let height = 1.0 - float::cos(angle);
        TEST.cap(
            &Cap::new(Vec3::Z, f64::from(angle)),
            |rng| Some(uniform_cone::sample(rng.vec2(), height)),
            |_| uniform_cone::pdf(height),
        )
        .assert("cone");
    }
}

#[test]
fn flat_densities() {
    TEST.square(
        |rng| Some(uniform_triangle::sample(rng.vec2()).truncate()),
        |b| {
            if b.x + b.y <= 1.0 {
                uniform_triangle::pdf(0.5)
            } else {
                0.0
            }
        },
    )
    .assert("triangle");
    for w in [
        [1.0, 2.0, 3.0, 4.0],
        [0.0, 0.0, 1.0, 0.0],
        [5.0, 0.0, 0.0, 1.0],
        [0.0; 4],
    ] {
        TEST.square(
            |rng| Some(bilinear::sample(rng.vec2(), w)),
            |p| bilinear::pdf(p, w),
        )
        .assert("bilinear");
    }
}

#[test]
fn densities_on_an_interval() {
    for (a, b) in [(1.0, 3.0), (0.0, 1.0), (2.0, 0.0), (1e-3, 1.0)] {
        TEST.interval(
            [0.0, 1.0],
            |rng| Some(linear::sample(rng.f32(), a, b)),
            |x| linear::pdf(x, a, b),
        )
        .assert("linear");
    }
    for (a, b) in [(0.0, 1.0), (-2.0, 5.0), (0.9, 0.95)] {
        TEST.interval(
            [a, b],
            |rng| Some(smoothstep::sample(rng.f32(), a, b)),
            |x| smoothstep::pdf(x, a, b),
        )
        .assert("smoothstep");
    }
    for to_point in [
        Vec3::new(1.0, 0.0, 0.5),
        Vec3::new(0.1, 0.1, -1.0),
        Vec3::new(0.0, 9.0, 1.5),
    ] {
        let part = Equiangular::new(to_point, Vec3::Z, -0.5, 2.0).expect("a part of the ray");
        TEST.interval(
            [-0.5, 2.0],
            |rng| Some(part.sample(rng.f32())),
            |t| part.pdf(t),
        )
        .assert("equiangular");
    }
}

/// Uniform solid angle weighted by the receiver's cosine at the corners of the random numbers'
/// square.
#[test]
fn warps_compose() {
    let corner = Vec3::new(-0.5, 0.2, 1.0);
    let (ex, ey) = (Vec3::X * 2.0, Vec3::new(0.0, 1.0, 0.5));
    let normal = Vec3::new(0.0, 0.6, 0.8);
    let rectangle = SphericalRectangle::new(corner, ex, ey, Vec3::ZERO).expect("a solid angle");
    let place = |at: Vec2| corner + ex * at.x + ey * at.y;
    let cosine = |x: f32, y: f32| {
        place(rectangle.sample(Vec2::new(x, y)))
            .normalize()
            .dot(normal)
            .max(0.0)
    };
    let weights = [
        cosine(0.0, 0.0),
        cosine(1.0, 0.0),
        cosine(0.0, 1.0),
        cosine(1.0, 1.0),
    ];
    let area_normal = ex.cross(ey);
    let pdf = |at: Vec2| {
        let r = place(at);
        let per_place = r.dot(area_normal).abs() / r.length().powi(3);
        rectangle.pdf() * bilinear::pdf(rectangle.invert(at), weights) * per_place
    };
    let sample = |rng: &mut Rng| Some(rectangle.sample(bilinear::sample(rng.vec2(), weights)));
    TEST.square(sample, pdf).assert("weighted rectangle");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn directions_invert(u in edge_cases::unit_square(), height in 1e-30f32..2.0) {
        let unit = |w: Vec3| (w.length() - 1.0).abs() < 1e-6;
        let near = |back: Vec2| (back - u).abs().max_element() < 2e-6;
        // At a pole the azimuth is lost.
        let is_at_pole = u.x.min(1.0 - u.x) < 1e-6;
        let near_pole = |back: Vec2| near(back) || is_at_pole && (back.x - u.x).abs() < 2e-6;

        let w = uniform_sphere::sample(u);
        prop_assert!(unit(w) && near_pole(uniform_sphere::invert(w)), "sphere {w}");
        let w = uniform_hemisphere::sample(u);
        prop_assert!(unit(w) && uniform_hemisphere::pdf(w.z) > 0.0, "hemisphere {w}");
        prop_assert!(near_pole(uniform_hemisphere::invert(w)), "hemisphere {w}");
        let w = cosine_hemisphere::sample(u);
        prop_assert!(unit(w) && cosine_hemisphere::pdf(w.z) > 0.0, "cosine {w}");
        prop_assert!(near(cosine_hemisphere::invert(w)), "cosine {w}");
        let w = uniform_cone::sample(u, height);
        let back = uniform_cone::invert(w, height);
        prop_assert!(unit(w) && uniform_cone::pdf(height) > 0.0, "cone {w}");
        prop_assert!((back.x - u.x).abs() < 8e-6, "cone {w} of {height}: {back}");
    }

    #[test]
    fn flat_samples_invert(
        u in edge_cases::unit_square(),
        w in prop::array::uniform4(edge_cases::non_negative()),
    ) {
        let p = concentric_disk::sample(u);
        prop_assert!(concentric_disk::pdf(p) > 0.0, "disk {p}");
        prop_assert!((concentric_disk::invert(p) - u).abs().max_element() < 2e-6, "disk {p}");
        let b = uniform_triangle::sample(u);
        prop_assert!((uniform_triangle::invert(b) - u).abs().max_element() < 2e-6, "triangle {b}");
        let p = bilinear::sample(u, w);
        prop_assert!(bilinear::pdf(p, w) > 0.0, "bilinear {p}");
        let x = linear::sample(u.x, w[0], w[1]);
        prop_assert!(linear::pdf(x, w[0], w[1]) > 0.0, "linear {x}");
        prop_assert!((linear::invert(x, w[0], w[1]) - u.x).abs() < 2e-6, "linear {x}");
    }

    #[test]
    fn nothing_panics(
        x in prop::array::uniform12(edge_cases::anything()),
        y in prop::array::uniform4(edge_cases::anything()),
    ) {
        let v = |i: usize| Vec3::new(x[i], x[i + 1], x[i + 2]);
        let u = Vec2::new(y[0], y[1]);
        let _ = (concentric_disk::invert(concentric_disk::sample(u)), polar_disk::sample(u));
        let _ = (polar_disk::invert(u), uniform_sphere::invert(v(0)));
        let _ = uniform_hemisphere::invert(v(3));
        let _ = (cosine_hemisphere::sample(u), cosine_hemisphere::invert(v(6)));
        let _ = (uniform_cone::sample(u, y[2]), uniform_cone::invert(v(0), y[2]));
        let _ = (linear::sample(y[0], y[1], y[2]), linear::invert(y[0], y[1], y[2]));
        let _ = (smoothstep::sample(y[0], y[1], y[2]), smoothstep::invert(y[0], y[1], y[2]));
        let _ = (bilinear::sample(u, y), bilinear::invert(u, y), bilinear::pdf(u, y));
        let _ = solid_angle::quad([v(0), v(3), v(6), v(9)], v(1));
        if let Some(triangle) = SphericalTriangle::new([v(0), v(3), v(6)], v(9)) {
            let _ = (triangle.sample(u), triangle.invert(v(2)), triangle.pdf());
        }
        if let Some(rectangle) = SphericalRectangle::new(v(0), v(3), v(6), v(9)) {
            let _ = (rectangle.sample(u), rectangle.invert(u), rectangle.pdf());
        }
        if let Some(part) = Equiangular::new(v(0), v(3), y[2], y[3]) {
            let _ = (part.sample(y[0]), part.pdf(y[1]), part.invert(y[1]));
        }
    }

    #[test]
    fn steps_and_shapes_stay_positive(
        u in edge_cases::unit(),
        a in edge_cases::finite(),
        width in edge_cases::moderate(),
        v in prop::array::uniform4(edge_cases::point()),
        at in edge_cases::unit_square(),
    ) {
        let b = a + width;
        if b > a && (b - a).is_finite() {
            let x = smoothstep::sample(u, a, b);
            prop_assert!(a <= x && x <= b && smoothstep::pdf(x, a, b) > 0.0, "step {x} in {a} {b}");
        }
        if let Some(triangle) = SphericalTriangle::new([v[0], v[1], v[2]], v[3]) {
            let barycentric = triangle.sample(at);
            prop_assert!(barycentric.min_element() >= 0.0, "triangle {barycentric}");
            prop_assert!((barycentric.element_sum() - 1.0).abs() < 1e-6, "triangle {barycentric}");
            prop_assert!(triangle.pdf() > 0.0, "triangle {triangle:?}");
        }
    }
}
