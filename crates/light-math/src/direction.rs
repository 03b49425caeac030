use glam::Vec3;

/// How far the squared length of a unit vector may be from one: what a few rotations in single
/// precision leave.
const UNIT_TOLERANCE: f32 = 1e-5;

/// The unit vector along `v`, however short or long that is; `None` if it has no direction: zero,
/// infinite, or not a number.
///
/// A unit vector to rounding, with a squared length within 1e-5 of one, comes back bit for bit.
#[cfg_attr(target_os = "none", inline(never))]
#[cfg_attr(not(target_os = "none"), inline)]
#[must_use]
pub fn direction(v: Vec3) -> Option<Vec3> {
    if (v.length_squared() - 1.0).abs() <= UNIT_TOLERANCE {
        Some(v)
    } else {
        scaled(v)
    }
}

/// Divided by the largest component first, so that no square overflows or vanishes.
#[cold]
fn scaled(v: Vec3) -> Option<Vec3> {
    let largest = v.abs().max_element();
    // A component that is not a number may hide behind the others.
    (largest > 0.0 && v.is_finite()).then(|| (v / largest).normalize())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn vectors_of_any_length_have_one() {
        for length in [1e-45, 1e-40, 1e-20, 1e-3, 0.9999, 1.0001, 7.0, 1e18, 3e38] {
            let exact = Vec3::new(
                0.0,
                -core::f32::consts::FRAC_1_SQRT_2,
                core::f32::consts::FRAC_1_SQRT_2,
            );
            let w = direction(Vec3::new(0.0, -length, length)).expect("a direction");
            assert!(w.distance(exact) < 1e-6, "{length}: {w}");
        }
    }

    #[test]
    fn what_has_no_direction() {
        for x in [0.0, -0.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(direction(Vec3::splat(x)), None, "{x}");
        }
        for v in [
            Vec3::new(f32::NAN, 1.0, 0.0),
            Vec3::new(3.0, 0.0, f32::INFINITY),
        ] {
            assert_eq!(direction(v), None, "{v}");
        }
    }

    #[test]
    fn unit_vectors_come_back_to_the_bit() {
        for scale in [1.0, 1.0 - 4e-6, 1.0 + 4e-6] {
            let w = Vec3::new(0.6, 0.0, -0.8) * scale;
            assert_eq!(direction(w), Some(w), "{scale}");
        }
        let long = Vec3::new(0.6, 0.0, -0.8) * (1.0 + 1e-5);
        assert_ne!(direction(long), Some(long), "beyond rounding");
    }

    proptest! {
        #[test]
        fn a_direction_is_a_unit_vector(bits in prop::array::uniform3(any::<u32>())) {
            let v = Vec3::from_array(bits.map(f32::from_bits));
            match direction(v) {
                Some(w) => {
                    let error = (w.length_squared() - 1.0).abs();
                    prop_assert!(error <= UNIT_TOLERANCE, "{v}: {w}");
                }
                None => prop_assert!(!v.is_finite() || v == Vec3::ZERO, "{v}"),
            }
        }
    }
}
