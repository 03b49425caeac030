use super::*;
use crate::node::light_emission::Lobe;
use crate::node::spread_code::SpreadCode;
use crate::node::wide_node::WideNode;
use core::f32::consts::{FRAC_PI_2, PI};
use light_bounds::EmissionLobe;
use light_math::float;

fn bounds(w: Vec3, theta_o: f32, theta_e: f32) -> LightBounds {
    LightBounds {
        bounds: Aabb::from_point(Vec3::ZERO),
        w,
        phi: 1.0,
        cos_theta_o: float::cos(theta_o),
        cos_theta_e: float::cos(theta_e),
        two_sided: false,
    }
}

fn moments(light: LightBounds, power: f32) -> Moments {
    let phi = light.phi * power;
    Moments::of_light(&LightExtent::Bounded(LightBounds { phi, ..light }), 1.0)
}

fn spot(degrees: f32, power: f32) -> Moments {
    moments(bounds(Vec3::NEG_Z, degrees.to_radians(), 0.0), power)
}

fn diffuse(w: Vec3, power: f32) -> Moments {
    let cos_theta_e = 0.0;
    moments(
        LightBounds {
            cos_theta_e,
            ..bounds(w, 0.0, 0.0)
        },
        power,
    )
}

/// Whether a node takes the edge of these lights for a proof that none emits beyond.
fn is_sharp(lights: &Moments) -> bool {
    let node = WideNode::encode(core::slice::from_ref(lights));
    !SpreadCode(node.spread[0]).soft().is_set()
}

/// Means of equal lights may differ from each by rounding.
#[test]
fn single_lights_are_sharp_and_groups_and_curved_ones_are_not() {
    let flat = diffuse(Vec3::new(0.6, 0.0, -0.8), 1.0);
    assert!(is_sharp(&flat), "one flat light");
    assert!(is_sharp(&spot(20.0, 1.0)), "one spot");
    for light in [flat, spot(20.0, 1.0), spot(2.0, 1.0)] {
        let powers = [0.1, 3.0, 0.7, 1e-20, 11.0];
        let group = Moments::join(&powers.map(|power| Moments { power, ..light }));
        assert!(!is_sharp(&group), "{group:?}");
    }
    let curved = moments(bounds(Vec3::X, 0.3, FRAC_PI_2), 1.0);
    assert!(!is_sharp(&curved), "{curved:?}");
}

#[test]
fn lights_that_are_off_do_not_count() {
    let (one, off) = (
        diffuse(Vec3::NEG_Z, 1.0),
        Moments {
            power: 0.0,
            ..spot(60.0, 1.0)
        },
    );
    assert_eq!(
        Moments::join(&[off, one, off]).power,
        one.power,
        "one is on"
    );
    assert_eq!(Moments::join(&[off, off]).power, 0.0, "none is on");
    assert_eq!(Moments::join(&[]).power, 0.0, "none at all");
}

/// The mean and the variance of a smooth step from the first angle to the sum of both.
#[test]
fn a_spot_is_a_step_at_the_middle_of_its_rim() {
    for (o, e) in [(0.1, 0.0), (0.3, 0.2), (0.0, 1.0), (0.5, 1.4)] {
        let light = moments(bounds(Vec3::X, o, e), 1.0);
        let steps = 100_000u32;
        let (mut mean, mut square) = (0.0, 0.0);
        let [start, end] = [f64::from(o).cos(), f64::from(o + e).cos()];
        for i in 0..steps {
            // The density of the edge is the slope of the falloff.
            let t = (f64::from(i) + 0.5) / f64::from(steps);
            let (density, cos) = (6.0 * t * (1.0 - t), end + (start - end) * t);
            mean += density * cos / f64::from(steps);
            square += density * cos * cos / f64::from(steps);
        }
        let variance = square - mean * mean;
        assert_eq!(
            (light.axis, light.shape),
            (Vec3::X, Shape::Steps),
            "{o}, {e}"
        );
        assert!(
            (f64::from(light.offset) - mean).abs() < 1e-5,
            "{o}, {e}: {light:?}"
        );
        let found = f64::from(light.spread_sq);
        assert!(
            (found - variance).abs() < 1e-5,
            "{o}, {e}: {found}, not {variance}"
        );
    }
}

/// A line from 1 on the axis to 0 at the cosine 0.7 is a step that is evenly spread between both.
#[test]
fn a_narrow_lobe_is_a_step_along_its_line() {
    let lobe = EmissionLobe {
        power: 2.0,
        mean: Vec3::X * 0.9,
        spread: 0.0,
    };
    let at = bounds(Vec3::X, 0.0, 1.0);
    let found = Moments::of_light(&LightExtent::Lobe(at, lobe), 1.0);
    assert_eq!(found.shape, Shape::Steps, "{found:?}");
    assert!(found.axis.distance(Vec3::X) < 1e-6, "{found:?}");
    assert!((found.offset - 0.85).abs() < 1e-6, "{found:?}");
    assert!((found.spread_sq - 0.0075).abs() < 1e-6, "{found:?}");
}

/// What a group emits toward a direction is the mean of what its lights emit, at any width.
#[test]
fn groups_of_steps_have_the_mean_and_the_variance_of_their_edges() {
    let parts = [spot(8.0, 1.0), spot(60.0, 3.0)];
    let group = Moments::join(&parts);
    let [a, b] = [8.0f32, 60.0].map(|degrees| float::cos(degrees.to_radians()));
    let mean = 0.25 * a + 0.75 * b;
    let variance = 0.25 * (a - mean) * (a - mean) + 0.75 * (b - mean) * (b - mean);
    assert!((group.offset - mean).abs() < 1e-6, "{group:?}");
    assert!((group.spread_sq - variance).abs() < 1e-6, "{group:?}");
    assert!(group.axis.distance(Vec3::NEG_Z) < 1e-6, "{group:?}");
    assert!(group.axis_var < 1e-12, "{group:?}");
    let turned = moments(bounds(Vec3::X, 0.1, 0.0), 1.0);
    let group = Moments::join(&[turned, spot(8.0, 1.0)]);
    assert!((group.axis_var - 0.5).abs() < 1e-6, "{group:?}");
}

/// A flat light is a step whose edge is evenly spread over the cosines of the half space, a point
/// is one that is lit everywhere.
#[test]
fn lights_of_other_kinds_join_spots_as_steps() {
    let dark = Moments {
        power: 1e-30,
        ..spot(20.0, 1.0)
    };
    let flat = Moments::join(&[diffuse(Vec3::X, 1.0), dark]);
    assert_eq!(flat.shape, Shape::Steps, "{flat:?}");
    assert!((flat.offset - 0.5).abs() < 1e-6, "{flat:?}");
    assert!((flat.spread_sq - 1.0 / 12.0).abs() < 1e-6, "{flat:?}");
    let point = moments(bounds(Vec3::Z, PI, 0.0), 1.0);
    let point = Moments::join(&[dark, point]);
    assert!((point.offset + 1.0).abs() < 1e-6, "{point:?}");
    assert!(
        point.spread_sq < 1e-6 && point.axis.length() < 1e-6,
        "{point:?}"
    );
}

#[test]
fn angles_beyond_half_a_turn_emit_everywhere() {
    for (cos_o, cos_e) in [
        (-1.0, -1.0),
        (-1.0, 1.0),
        (1.0, -1.0),
        (0.5, -0.5),
        (-0.9, 0.8),
    ] {
        let lobe = Lobe::new(cos_o, cos_e, false);
        assert_eq!((lobe.axis, lobe.offset), (0.0, -1.0), "{cos_o} and {cos_e}");
    }
}

/// The axis of a light that emits to both sides has no sign: groups of such lights are the same
/// whichever way each points, but for the sign of the axis.
#[test]
fn axes_of_both_sides_join_whatever_their_signs() {
    let both = |w: Vec3, power| {
        let light = LightBounds {
            two_sided: true,
            ..bounds(w.normalize(), 0.0, FRAC_PI_2)
        };
        moments(light, power)
    };
    let (a, b) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.1, 1.0));
    let expected = Moments::join(&[both(a, 1.0), both(b, 3.0)]);
    assert!(expected.axis.length() > 0.9, "alike: {}", expected.axis);
    for [sign_a, sign_b] in [[1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
        let joined = Moments::join(&[both(a * sign_a, 1.0), both(b * sign_b, 3.0)]);
        assert_eq!(joined.shape, Shape::BothSides, "{sign_a}, {sign_b}");
        assert_eq!(joined.axis * sign_a, expected.axis, "{sign_a}, {sign_b}");
        let [found, expected] = [&joined, &expected].map(|m| (m.spread_sq, m.axis_var, m.offset));
        assert_eq!(found, expected, "{sign_a}, {sign_b}");
    }
}

/// Of lamps that face the same way: nothing for a sheet across the axis, the share of the width for
/// a row along it, however the row is grouped.
#[test]
fn the_depth_of_a_group_is_along_its_axis() {
    let lamp = |p: Vec3, power: f32| {
        let bounds = Aabb::from_point(p);
        Moments {
            bounds,
            mean: p,
            ..diffuse(Vec3::X, power)
        }
    };
    let sheet = [Vec3::ZERO, Vec3::Y, 3.0 * Vec3::Z].map(|p| lamp(p, 2.0));
    let sheet = Moments::join(&sheet);
    assert!(sheet.depth_var == 0.0, "{sheet:?}");
    for scale in [1e-30, 1.0, 1e30] {
        let row = [0.0, 1.0, 4.0, 9.0].map(|x| lamp(Vec3::X * (x * scale), 1.0 + x));
        let flat = Moments::join(&row);
        let [near, far] = [&row[..2], &row[2..]].map(Moments::join);
        let grouped = Moments::join(&[near, far]);
        // Powers 1, 2, 5, 10: the mean is at 6.2222, from which the variance is 10.8395.
        let expected = 10.8395 / (6.2222 * 6.2222);
        for group in [flat, grouped] {
            assert!(
                (group.depth_var - expected).abs() < 1e-4,
                "{scale}: {group:?}"
            );
        }
        assert!(flat.total_spread_sq() > flat.spread_sq, "{flat:?}");
    }
    let one_place = Moments::join(&[lamp(Vec3::ONE, 1.0), lamp(Vec3::ONE, 2.0)]);
    assert!(one_place.depth_var == 0.0, "{one_place:?}");
}

#[test]
fn beams_of_opposite_directions_spread_about_their_line() {
    let w = Vec3::new(0.48, -0.6, 0.64);
    let beam = |w: Vec3| moments(bounds(w, 0.2, 0.0), 1.0);
    let tilted = [w, w + 0.1 * Vec3::X, w - 0.1 * Vec3::X].map(Vec3::normalize);
    let one_way = Moments::join(&tilted.map(beam));
    let both_ways = Moments::join(&[
        Moments::join(&tilted.map(beam)),
        Moments::join(&tilted.map(|w| beam(-w))),
    ]);
    assert!(
        both_ways.is_opposed() && !one_way.is_opposed(),
        "{both_ways:?}"
    );
    assert!(both_ways.axis.length() < 1e-6, "{both_ways:?}");
    let (a, b) = (one_way.total_spread_sq(), both_ways.total_spread_sq());
    assert!((a - b).abs() < 1e-3 * a, "{a} and {b}");
    let wide = |w: Vec3| moments(bounds(w, 1.3, 0.0), 1.0);
    assert!(
        !Moments::join(&[wide(w), wide(-w)]).is_opposed(),
        "wide beams"
    );
    let across = Moments::join(&[Vec3::X, Vec3::Y, Vec3::Z, -w].map(beam));
    assert!(!across.is_opposed(), "{across:?}");
}
