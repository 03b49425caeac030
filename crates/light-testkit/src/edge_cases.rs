//! Floats at which code tends to fail: strategies for property tests.

use core::f32::consts::TAU;
use light_math::float::ONE_MINUS_EPSILON;
use light_math::glam::{Vec2, Vec3};
use proptest::prelude::*;

/// Values of `u` at which samplers tend to fail: both ends, the middle and their neighbours.
pub const EDGES_OF_U: [f32; 9] = [
    0.0,
    f32::from_bits(1),
    f32::MIN_POSITIVE,
    f32::EPSILON / 2.0,
    0.5 - f32::EPSILON / 4.0,
    0.5,
    0.5 + f32::EPSILON / 2.0,
    1.0 - f32::EPSILON,
    ONE_MINUS_EPSILON,
];

/// Any bit pattern: NaN of both kinds, infinities, subnormals, zeros of both signs.
pub fn anything() -> impl Strategy<Value = f32> + Clone {
    prop_oneof![
        any::<u32>().prop_map(f32::from_bits),
        prop::sample::select(vec![
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            f32::MAX,
            f32::MIN,
            0.0,
            -0.0,
            f32::from_bits(1),
            f32::MIN_POSITIVE,
        ]),
        finite(),
    ]
}

/// Finite numbers of every size and both signs, often neighbours of powers of two.
pub fn finite() -> impl Strategy<Value = f32> + Clone {
    (non_negative(), any::<bool>()).prop_map(|(x, negative)| if negative { -x } else { x })
}

/// Finite numbers from 0 on, subnormal and huge ones included.
pub fn non_negative() -> impl Strategy<Value = f32> + Clone {
    prop_oneof![
        1 => Just(0.0),
        1 => (1u32..0x0080_0000).prop_map(f32::from_bits),
        4 => (0u32..0x7f80_0000).prop_map(f32::from_bits),
        4 => 0.0f32..10.0,
        4 => near_power_of_two(-126..128),
    ]
}

/// Positive numbers whose products and quotients of a few neither overflow nor vanish: 1e-6 to 1e6.
pub fn moderate() -> impl Strategy<Value = f32> + Clone {
    (-20i32..20, 1.0f32..2.0).prop_map(|(e, m)| m * f32::powi(2.0, e))
}

/// `2^e` for `e` of the range (-126 to 127), or one of its two neighbours.
pub fn near_power_of_two(exponents: core::ops::Range<i32>) -> impl Strategy<Value = f32> + Clone {
    (exponents, 0usize..3).prop_map(|(e, neighbour)| {
        let bits = f32::powi(2.0, e).to_bits();
        f32::from_bits([bits, bits + 1, bits - 1][neighbour])
    })
}

/// Random numbers in `[0, 1)`, often at an edge.
pub fn unit() -> impl Strategy<Value = f32> + Clone {
    prop_oneof![
        1 => prop::sample::select(EDGES_OF_U.to_vec()),
        3 => (0u32..1 << 24).prop_map(|bits| bits as f32 / 16_777_216.0),
    ]
}

/// Points of `[0, 1)` squared, often at an edge.
pub fn unit_square() -> impl Strategy<Value = Vec2> + Clone {
    (unit(), unit()).prop_map(|(x, y)| Vec2::new(x, y))
}

/// Random numbers in `[0, 1)` with all bits of a double, often at an edge.
pub fn unit_f64() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![
        1 => unit().prop_map(f64::from),
        1 => prop::sample::select(vec![0.0, f64::from_bits(1), 1.0 - f64::EPSILON / 2.0]),
        3 => 0.0f64..1.0,
    ]
}

/// Unit vectors to rounding: uniform ones, axes, and directions very close to an axis.
pub fn unit_vector() -> impl Strategy<Value = Vec3> + Clone {
    let axes = [
        Vec3::X,
        Vec3::NEG_X,
        Vec3::Y,
        Vec3::NEG_Y,
        Vec3::Z,
        Vec3::NEG_Z,
    ];
    let axis = prop::sample::select(axes.to_vec());
    let hair = (axis.clone(), uniform_direction(), 0i32..30);
    prop_oneof![
        4 => uniform_direction(),
        1 => axis,
        2 => hair.prop_map(|(axis, w, e)| (axis + w * f32::powi(0.5, e)).normalize_or(axis)),
    ]
}

/// Unit vectors whose length is off by a few units in the last place, as real normals are.
pub fn near_unit_vector() -> impl Strategy<Value = Vec3> + Clone {
    (unit_vector(), -4i32..5).prop_map(|(w, ulps)| w * (1.0 + ulps as f32 * f32::EPSILON))
}

/// Finite points: near the origin, far from it, on planes and axes.
pub fn point() -> impl Strategy<Value = Vec3> + Clone {
    let coordinate = prop_oneof![
        1 => prop::sample::select(vec![0.0, -0.0, 1.0, -1.0]),
        4 => -10.0f32..10.0,
        2 => -1e6f32..1e6,
    ];
    vec3(coordinate)
}

/// Finite points with coordinates of every magnitude from 1e-20 to 1e18.
pub fn wild_point() -> impl Strategy<Value = Vec3> + Clone {
    let coordinate = (-66i32..60, 1.0f32..2.0, any::<bool>()).prop_map(|(e, m, negative)| {
        let x = m * f32::powi(2.0, e);
        if negative { -x } else { x }
    });
    vec3(coordinate)
}

/// Weights of a table: none negative, some zero, some tiny and some huge beside small ones; their
/// sum is finite.
pub fn weights(count: core::ops::Range<usize>) -> impl Strategy<Value = Vec<f32>> + Clone {
    let weight = prop_oneof![
        2 => Just(0.0),
        4 => 0.0f32..1.0,
        1 => (-60i32..60).prop_map(|e| f32::powi(2.0, e)),
        1 => (1u32..0x0080_0000).prop_map(f32::from_bits),
    ];
    prop::collection::vec(weight, count)
}

fn vec3(coordinate: impl Strategy<Value = f32> + Clone) -> impl Strategy<Value = Vec3> + Clone {
    [coordinate.clone(), coordinate.clone(), coordinate].prop_map(Vec3::from_array)
}

fn uniform_direction() -> impl Strategy<Value = Vec3> + Clone {
    (-1.0f32..1.0, 0.0f32..TAU).prop_map(|(z, phi)| {
        let r = (1.0 - z * z).sqrt();
        Vec3::new(r * phi.cos(), r * phi.sin(), z).normalize()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    proptest! {
        #[test]
        fn strategies_keep_their_promises(
            u in unit(),
            w in near_unit_vector(),
            x in finite(),
            p in wild_point(),
            table in weights(0..9),
        ) {
            prop_assert!((0.0..1.0).contains(&u), "{u}");
            prop_assert!((w.length() - 1.0).abs() < 2e-6, "{w}");
            prop_assert!(x.is_finite() && p.is_finite(), "{x} {p}");
            prop_assert!(table.iter().all(|w| *w >= 0.0), "{table:?}");
            prop_assert!(table.iter().sum::<f32>().is_finite(), "{table:?}");
        }
    }
}
