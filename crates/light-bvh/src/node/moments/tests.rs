use super::*;
use crate::node::wide_node::WideNode;

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

/// The spread that a node keeps of a group.
fn spread_code(group: &Moments) -> u8 {
    WideNode::encode(core::slice::from_ref(group)).spread[0]
}

#[test]
fn groups_of_equal_lines_are_as_exact_as_their_lights() {
    for light in [
        spot(20.0, 1.0),
        spot(2.0, 1.0),
        diffuse(Vec3::new(0.6, 0.0, -0.8), 1.0),
    ] {
        let powers = [0.1, 3.0, 0.7, 1e-20, 11.0];
        let lights = powers.map(|power| Moments { power, ..light });
        let [left, right] = [Moments::join(&lights[..2]), Moments::join(&lights[2..])];
        for group in [
            Moments::join(&lights),
            left,
            Moments::join(&[left, right, Moments::NOTHING]),
        ] {
            assert_eq!(group.spread_sq, 0.0, "{group:?}");
            assert_eq!(
                (group.axis, group.offset),
                (light.axis, light.offset),
                "{group:?}"
            );
            assert_eq!(spread_code(&group), 0, "{group:?}");
        }
    }
}

/// Whatever cancels or vanishes by rounding: only equal lines have no spread.
#[test]
fn groups_of_unlike_lines_have_a_spread() {
    let next = |x: f32| f32::from_bits(x.to_bits() + 1);
    let one = spot(20.0, 1.0);
    let flat = diffuse(Vec3::NEG_Z, 1.0);
    let both_sides = moments(
        LightBounds {
            two_sided: true,
            cos_theta_e: 0.0,
            ..bounds(Vec3::NEG_Z, 0.0, 0.0)
        },
        1.0,
    );
    let pairs = [
        (spot(8.0, 1.0), spot(60.0, 1.0)),
        (spot(20.0, 1.0), spot(20.001, 1.0)),
        (
            one,
            Moments {
                offset: next(one.offset),
                ..one
            },
        ),
        (
            one,
            Moments {
                axis: one.axis * (1.0 + f32::EPSILON),
                ..one
            },
        ),
        (
            one,
            Moments {
                axis: -one.axis,
                ..one
            },
        ),
        (
            one,
            Moments {
                spread_sq: f32::MIN_POSITIVE,
                ..one
            },
        ),
        (
            one,
            Moments {
                power: 1e-38,
                axis: Vec3::X,
                ..one
            },
        ),
        (flat, both_sides),
        (
            both_sides,
            Moments {
                shape: Shape::Mixed,
                ..both_sides
            },
        ),
    ];
    for (a, b) in pairs {
        for (a, b) in [(a, b), (b, a)] {
            let pair = Moments::join(&[a, b]);
            let groups = [
                pair,
                Moments::join(&[a, a, b]),
                Moments::join(&[pair, b, b]),
            ];
            for group in groups {
                assert!(
                    group.spread_sq >= f32::MIN_POSITIVE,
                    "{a:?} and {b:?}: {group:?}"
                );
                assert!(spread_code(&group) > 0, "{a:?} and {b:?}: {group:?}");
            }
        }
    }
}

#[test]
fn lights_that_are_off_do_not_count() {
    let (one, off) = (
        spot(20.0, 1.0),
        Moments {
            power: 0.0,
            ..spot(60.0, 1.0)
        },
    );
    assert_eq!(Moments::join(&[off, one, off]).spread_sq, 0.0, "one is on");
    assert_eq!(Moments::join(&[off, off]).power, 0.0, "none is on");
    assert_eq!(Moments::join(&[]).power, 0.0, "none at all");
}

/// The line is 1 on the axis and 0 at the sum of the angles.
#[test]
fn a_spot_is_a_line_from_its_axis_to_its_edge() {
    for (o, e) in [(0.1, 0.0), (0.3, 0.2), (0.0, 1.0), (0.5, 1.4)] {
        let light = moments(bounds(Vec3::X, o, e), 1.0);
        let line = |theta: f32| light.axis.x * float::cos(theta) - light.offset;
        assert!((line(0.0) - 1.0).abs() < 1e-5, "{o} and {e}: {light:?}");
        assert!(line(o + e).abs() < 1e-5, "{o} and {e}: {light:?}");
        assert_eq!(
            (light.spread_sq, light.shape),
            (0.0, Shape::Spots),
            "{o} and {e}"
        );
    }
}

#[test]
fn angles_beyond_half_a_turn_shine_everywhere() {
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
