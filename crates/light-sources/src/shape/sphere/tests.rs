use super::*;
use crate::glam::Affine3A;

fn sphere(center: Vec3, radius: f32) -> Sphere {
    let transform = Affine3A::from_translation(center);
    let transform = RigidTransform::new(transform).expect("a place");
    Sphere::new(transform, radius).expect("a sphere")
}

fn numbers() -> impl Iterator<Item = Vec2> {
    let along = |i: u16| (f32::from(i) / 15.0).min(light_math::float::ONE_MINUS_EPSILON);
    (0..256).map(move |i| Vec2::new(along(i % 16), along(i / 16)))
}

/// Points lie on the side that is asked from by more than rounding: the sphere does not hide its
/// own light.
#[test]
fn samples_lie_before_the_surface() {
    for center in [Vec3::ZERO, Vec3::new(3e4, -1e3, 20.0)] {
        let sphere = sphere(center, 0.7);
        for (from, side) in [
            (Vec3::new(1.5, 0.4, -2.0), 1.0),
            (Vec3::new(0.3, 0.1, 0.2), -1.0),
        ] {
            let ctx = LightSampleContext::medium(center + from);
            let mut taken = 0;
            for u in numbers() {
                let Some(sample) = sphere.sample_toward(&ctx, u) else {
                    continue;
                };
                taken += 1;
                let distance = (sample.at.p.as_dvec3() - center.as_dvec3()).length();
                assert!((distance - f64::from(0.7f32)) * side > 0.0, "{center}, {u}");
            }
            assert!(taken > 240, "{taken} of 256 from {center} and {from}");
        }
    }
}

/// Where rounding may have put a point of the sphere's own surface outside of it, it sees no cone
/// but all of the sphere.
#[test]
fn points_of_the_surface_are_not_outside() {
    let sphere = sphere(Vec3::ZERO, 1.0);
    let p = Vec3::new(0.6, 0.0, 0.8) * (1.0 + 2.0 * f32::EPSILON);
    assert!(p.length() > 1.0, "outside, by rounding");
    let without = LightSampleContext::medium(p);
    let n = p.normalize();
    let with = LightSampleContext::surface(p, n, n).with_error(Vec3::splat(4.0 * f32::EPSILON));
    assert!(sphere.cone(&without).is_some(), "a cone without an error");
    assert!(sphere.cone(&with).is_none(), "none within the error");
    // Of the hemisphere above, of which the cone is nearly all, nothing is light.
    assert_eq!(sphere.pdf_toward(&without, p), 0.0, "above");
    let below = -p.normalize();
    let through = 1.0 / (4.0 * PI) * 4.0;
    assert!(
        (sphere.pdf_toward(&with, below) / through - 1.0).abs() < 1e-5,
        "d^2 / A"
    );
}

/// A floor may be closer to the sphere than the error of its points: it still is outside, and its
/// light comes from the near side.
#[test]
fn other_surfaces_within_rounding_see_the_near_side() {
    let sphere = sphere(Vec3::splat(-1.9375), 1.9375);
    let n = Vec3::NEG_X;
    let ctx = LightSampleContext::surface(Vec3::splat(-0.5), n, n);
    let ctx = ctx.with_error(Vec3::splat(0.5));
    for u in numbers() {
        let sample = sphere.sample_toward(&ctx, u).expect("a point");
        assert!(sample.at.n.dot(sample.wi) < 0.0, "{u}: the near side");
        assert_eq!(sphere.pdf_toward(&ctx, sample.wi), sample.pdf, "{u}");
    }
}

/// From the sphere itself lines leave through the other side, wherever rounding has put the point.
#[test]
fn own_points_see_the_far_side() {
    let sphere = sphere(Vec3::new(1.0, -30.0, 4.0), 1.0);
    let mut taken = 0;
    for u in numbers() {
        let at = sphere.sample(u).expect("a point").at;
        for moved in [-3.0, 0.0, 3.0] {
            let p = at.p + at.n * (moved * 30.0 * f32::EPSILON);
            let ctx = LightSampleContext::surface(p, -at.n, -at.n);
            let ctx = ctx.with_error(Vec3::splat(120.0 * f32::EPSILON));
            for u in numbers() {
                let Some(sample) = sphere.sample_toward(&ctx, u) else {
                    continue;
                };
                taken += 1;
                assert!(sample.at.n.dot(sample.wi) > 0.0, "{u}: the far side");
                let pdf = sphere.pdf_toward(&ctx, sample.wi);
                // Rounding turns the lines to points close by.
                let is_close = sample.at.p.distance(p) < 0.1;
                assert!(
                    is_close || (pdf / sample.pdf - 1.0).abs() < 0.02,
                    "{pdf}, {u}"
                );
            }
        }
    }
    assert!(taken > 150_000, "{taken} of 196,608");
}

/// Directions to the very rim are directions to the sphere.
#[test]
fn the_rim_is_met() {
    for distance in [1.5, 30.0, 1e3, 1e5] {
        let sphere = sphere(Vec3::ZERO, 1.0);
        for i in 0..64u8 {
            let (sin, cos) = sin_cos(f32::from(i) * 0.7);
            let p = Vec3::new(cos, sin, 0.3 * cos).normalize() * distance;
            let ctx = LightSampleContext::medium(p);
            for y in [0.0, 0.2, 0.41, 0.77] {
                let u = Vec2::new(light_math::float::ONE_MINUS_EPSILON, y);
                let sample = sphere.sample_toward(&ctx, u).expect("outside");
                assert_eq!(sphere.pdf_toward(&ctx, sample.wi), sample.pdf, "{p}, {y}");
            }
        }
    }
}

/// A ray inward from a point of the surface leaves through the other side, and one outward meets
/// nothing, wherever rounding has put the point.
#[test]
fn rays_from_the_surface_meet_the_far_side() {
    for center in [Vec3::ZERO, Vec3::new(1.0, -30.0, 4.0)] {
        let sphere = sphere(center, 1.3);
        for (i, u) in (0u16..).zip(numbers()) {
            let at = sphere.sample(u).expect("a point").at;
            for tilt in [-1.0, -0.5, -0.1, 0.1, 0.5, 1.0] {
                let (x, y) = at.n.any_orthonormal_pair();
                let (sin, cos) = sin_cos(f32::from(i));
                let around = (x * cos + y * sin) * safe_sqrt(1.0 - tilt * tilt);
                let direction = around + at.n * tilt;
                let hit = sphere.hit(at.p, direction);
                if tilt > 0.0 {
                    assert_eq!(hit, None, "outward from {}", at.p);
                    continue;
                }
                let chord = hit.expect("the far side").p - at.p;
                let along = -2.0 * 1.3 * tilt;
                let off = (chord - direction * along).length();
                assert!(off < 1e-3, "{off} off from {}, {tilt}", at.p);
            }
        }
    }
}
