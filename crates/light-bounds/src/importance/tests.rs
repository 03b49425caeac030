use super::*;
use light_math::{Aabb, DirectionCone, Frame};
use proptest::prelude::*;

fn lamp(bounds: Aabb) -> LightBounds {
    LightBounds {
        bounds,
        w: Vec3::Z,
        phi: 2.0,
        cos_theta_o: 1.0,
        cos_theta_e: 0.0,
        two_sided: false,
    }
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    let product = |i| f64::from(a[i]) * f64::from(b[i]);
    product(0) + product(1) + product(2)
}

/// The computed angle of a box is hardly larger than the exact one: a box just beyond the edge
/// of its emission has no importance.
#[test]
fn a_box_that_emits_away_has_no_importance() {
    for size in [1e-3, 0.1, 1.0, 3.0] {
        let lamp = lamp(Aabb::new(Vec3::splat(-size), Vec3::splat(size)));
        // From a little less or more below the horizon of its centre than the angle that it
        // subtends.
        let sin_b = size * 3f32.sqrt() / 10.0;
        for (sin, matters) in [(sin_b - 1e-4, true), (sin_b + 1e-4, false)] {
            let p = Vec3::new(light_math::float::safe_sqrt(1.0 - sin * sin), 0.0, -sin);
            let importance = lamp.importance(&LightSampleContext::medium(p * 10.0));
            let is_zero = importance == 0.0;
            assert_eq!(is_zero, !matters, "{size} at {p}: {importance}");
        }
    }
}

/// From the sphere about a box, and as far beyond the edge of the emission as round-off may
/// reach, a light counts.
#[test]
fn a_light_counts_at_the_edges() {
    let away = LightBounds {
        w: Vec3::NEG_Z,
        cos_theta_e: 0.9,
        ..lamp(Aabb::new(Vec3::NEG_X, Vec3::X))
    };
    for (height, counts) in [(SIN_GROWTH, true), (SIN_GROWTH + 0.1, false)] {
        let ctx = LightSampleContext::medium(Vec3::Z * height);
        let importance = away.importance(&ctx);
        assert_eq!(importance > 0.0, counts, "{height}: {importance}");
    }
    for (edge, counts) in [(EDGE_SLACK, true), (1.001 * EDGE_SLACK, false)] {
        let aside = LightBounds {
            cos_theta_e: edge,
            ..lamp(Aabb::from_point(Vec3::ZERO))
        };
        let ctx = LightSampleContext::medium(Vec3::X);
        let importance = aside.importance(&ctx);
        assert_eq!(importance > 0.0, counts, "{edge}: {importance}");
    }
}

#[test]
fn a_point_above_a_lamp() {
    let lamp = lamp(Aabb::from_point(Vec3::ZERO));
    let p = Vec3::new(0.0, 3.0, 4.0);
    assert!(
        (lamp.importance(&LightSampleContext::medium(p)) - 2.0 * 0.8 / 25.0).abs() < 1e-7,
        "phi cos / d^2"
    );
    let ctx = LightSampleContext::surface(p, Vec3::Z, Vec3::Y);
    assert!(
        (lamp.importance(&ctx) - 2.0 * 0.8 * 0.6 / 25.0).abs() < 1e-7,
        "the shading normal counts"
    );
    let below = LightSampleContext::medium(-p);
    assert_eq!(lamp.importance(&below), 0.0, "emits upward only");
    let two_sided = LightBounds {
        two_sided: true,
        ..lamp
    };
    assert!(two_sided.importance(&below) > 0.0, "both sides");
}

#[test]
fn a_light_without_power_does_not_matter() {
    let dark = LightBounds {
        phi: 0.0,
        ..lamp(Aabb::from_point(Vec3::ZERO))
    };
    let ctx = LightSampleContext::medium(Vec3::Z);
    assert_eq!(dark.importance(&ctx), 0.0, "no power");
    assert_eq!(LightBounds::EMPTY.importance(&ctx), 0.0, "no light");
}

/// A spot without a falloff band emits in its cone and nothing beyond: `theta_e` is 0.
#[test]
fn a_spot_without_falloff_is_found() {
    let spot = LightBounds {
        cos_theta_o: 0.9,
        cos_theta_e: 1.0,
        ..lamp(Aabb::from_point(Vec3::ZERO))
    };
    let inside = LightSampleContext::medium(Vec3::new(0.4, 0.0, 1.0));
    let outside = LightSampleContext::medium(Vec3::new(0.6, 0.0, 1.0));
    assert!(spot.importance(&inside) > 0.0, "cos 0.928");
    assert_eq!(spot.importance(&outside), 0.0, "cos 0.857");
}

#[test]
fn receivers_in_the_middle_and_on_a_light_are_ordinary() {
    let half = Aabb::new(Vec3::new(-1.0, -2.0, 0.0), Vec3::new(1.0, 2.0, 0.0));
    for bounds in [half, Aabb::from_point(Vec3::ONE)] {
        for ns in [Vec3::ZERO, Vec3::X] {
            let ctx = LightSampleContext::surface(bounds.center(), ns, ns);
            let importance = lamp(bounds).importance(&ctx);
            assert!(importance > 0.0 && importance.is_finite(), "{importance}");
        }
    }
}

/// The published clamp: a squared distance is at least half of the diagonal's length.
#[test]
fn near_the_centre_the_diagonal_bounds_the_distance() {
    let long = lamp(Aabb::new(
        Vec3::new(-24.0, -32.0, 0.0),
        Vec3::new(24.0, 32.0, 0.0),
    ));
    let importance = long.importance(&LightSampleContext::medium(Vec3::Z));
    assert!((importance - 2.0 / 40.0).abs() < 1e-6, "{importance}");
}

#[test]
fn no_context_gives_nan() {
    let values = [0.0, 1e-38, -1e20, 3e38, f32::INFINITY, f32::NAN];
    let boxes = [1e-40, 1.0, 1e18, 1e20, 3e38].map(|r| Aabb::new(Vec3::ZERO, Vec3::splat(r)));
    for bounds in boxes {
        for x in values {
            for n in [Vec3::ZERO, Vec3::X, Vec3::NAN] {
                let ctx = LightSampleContext::surface(Vec3::new(x, 0.0, x), n, n);
                let importance = lamp(bounds).importance(&ctx);
                assert!((0.0..=MAX_IMPORTANCE).contains(&importance), "at {x}, {n}");
            }
        }
    }
}

/// Importance is scale invariant between the scales at which the result overflows or
/// underflows.
#[test]
fn a_point_light_scales_with_the_squared_distance() {
    let lamp = lamp(Aabb::from_point(Vec3::ZERO));
    let at = |d: f32| lamp.importance(&LightSampleContext::medium(Vec3::new(d, 0.0, d)));
    for d in [2f32.powi(-60), 0.25, 2f32.powi(62)] {
        assert_eq!(at(d) * d * d, at(1.0), "distance {d}");
    }
}

proptest! {
    /// Bounds have a positive importance at every point that an emitter within them lights.
    #[test]
    fn contribution_implies_importance(
        a in prop::array::uniform3(-1.0f32..1.0), b in prop::array::uniform3(-1.0f32..1.0),
        p in prop::array::uniform3(-3.0f32..3.0), t in prop::array::uniform3(0.0f32..=1.0),
        angles in prop::array::uniform3(0.0f32..1.0), theta_e in 0.0f32..1.6,
        size in prop_oneof![Just(0.0f32), Just(1e-6), Just(1e-3), Just(1.0)],
        origin in prop_oneof![Just(0.0f32), Just(1e6)],
    ) {
        let place = |v: [f32; 3]| Vec3::splat(origin) + Vec3::from(v) * size;
        let bounds = Aabb::new(place(a), place(b));
        let p = Vec3::splat(origin) + Vec3::from(p);
        let [theta_o, tilt, turn] = angles;
        let theta_o = theta_o * core::f32::consts::PI;
        let turn = turn * core::f32::consts::TAU;
        let group = LightBounds {
            cos_theta_o: theta_o.cos(),
            cos_theta_e: theta_e.cos(),
            ..lamp(bounds)
        };

        // One emitter: a point of the box, a normal in the cone.
        let emitter = bounds.min + bounds.diagonal() * Vec3::from(t);
        let tilt = tilt * theta_o;
        let normal = Frame::from_z(group.w).from_local(Vec3::new(
            tilt.sin() * turn.cos(), tilt.sin() * turn.sin(), tilt.cos(),
        ));
        let from_light = p - emitter;
        let lengths = dot(normal, normal) * dot(from_light, from_light);
        let cos = dot(normal, from_light) / lengths.sqrt();
        if cos > f64::from(theta_e).cos() {
            let importance = group.importance(&LightSampleContext::medium(p));
            prop_assert!(importance > 0.0, "{:?} to {}: cos {}", group, p, cos);
        }
        prop_assert!(DirectionCone::new(group.w, group.cos_theta_o).contains(normal.normalize()));
    }
}

fn along(light: &LightBounds, a: Vec3, b: Vec3) -> f32 {
    light.importance(&LightSampleContext::segment(a, b - a))
}

/// A ray that passes under a spot: from its start the spot lights nothing.
#[test]
fn a_spot_counts_for_a_segment_that_crosses_its_cone() {
    let spot = LightBounds {
        w: Vec3::NEG_Y,
        cos_theta_e: 0.92,
        ..lamp(Aabb::from_point(Vec3::new(5.0, 3.0, 0.0)))
    };
    let start = LightSampleContext::medium(Vec3::ZERO);
    assert_eq!(spot.importance(&start), 0.0, "aside");
    let [crossing, aside] = [10.0, 3.0].map(|x| along(&spot, Vec3::ZERO, Vec3::X * x));
    assert!(crossing > 0.01 && aside > 0.0, "{crossing}, {aside}");
    assert!(aside < 1e-9 * crossing, "{aside} of {crossing}");
}

#[test]
fn the_importance_for_a_segment_is_the_mean_of_inverse_squares() {
    let bulb = LightBounds {
        cos_theta_o: -1.0,
        ..lamp(Aabb::from_point(Vec3::new(1.0, 2.0, -1.0)))
    };
    for (a, b) in [
        (Vec3::ZERO, Vec3::X * 4.0),
        (Vec3::X * 3.0, Vec3::X * 30.0),
        (Vec3::new(1.0, 2.0, 0.0), Vec3::new(1.0, 2.0, 9.0)),
        (Vec3::new(0.9, 2.1, -9.0), Vec3::new(0.8, 2.0, 9.0)),
        (Vec3::ZERO, Vec3::X * 1e-6),
    ] {
        let n = 20_000;
        let at = |i: i32| a.lerp(b, (i as f32 + 0.5) / n as f32);
        let inverse = |i| 2.0 / f64::from(at(i).distance_squared(bulb.centroid()));
        let mean = (0..n).map(inverse).sum::<f64>() / f64::from(n);
        let importance = f64::from(along(&bulb, a, b));
        assert!(
            (importance / mean - 1.0).abs() < 1e-3,
            "{a} to {b}: {importance}, {mean}"
        );
    }
    // Through the light itself, from it, and through its box.
    let p = bulb.centroid();
    let boxed = LightBounds {
        bounds: Aabb::new(p - 1.0, p + 1.0),
        ..bulb
    };
    for light in [bulb, boxed] {
        for (a, b) in [
            (p - Vec3::X, p + Vec3::X),
            (p, p + Vec3::Y),
            (p - 1e30, p + 1e30),
        ] {
            let importance = along(&light, a, b);
            assert!(importance > 0.0 && importance.is_finite(), "{importance}");
        }
    }
}

proptest! {
    /// The cosine factor is the largest along the segment.
    #[test]
    fn no_point_of_a_segment_has_a_larger_cosine(
        a in prop::array::uniform3(-2.0f32..2.0),
        b in prop::array::uniform3(-2.0f32..2.0),
        p in prop::array::uniform3(-2.0f32..2.0),
        cos_theta_e in -1.0f32..1.0,
        size in prop_oneof![Just(0.0f32), 0.0f32..0.3],
        two_sided in any::<bool>(),
    ) {
        let [a, b, p] = [a, b, p].map(Vec3::from);
        let light = LightBounds {
            cos_theta_e,
            two_sided,
            ..lamp(Aabb::new(p - size, p + size))
        };
        let lit = (0..=64)
            .map(|i| LightSampleContext::medium(a.lerp(b, i as f32 / 64.0)))
            .any(|ctx| light.importance(&ctx) > 0.0);
        let most = along(&LightBounds { cos_theta_o: -1.0, ..light }, a, b);
        let importance = along(&light, a, b);
        prop_assert!(importance > if lit { 1e-6 * most } else { 0.0 }, "{importance} of {most}");
    }
}
