//! Quantised directions, cosines and boxes as real numbers, before they are rounded to codes.

use glam::DVec3;

/// How far rounding in single precision moves such a number, in codes.
const ROUNDING: f64 = 0.06;

/// Whether `code` is that of the direction `w`, which rounding has moved by an angle of up to
/// `moved` before it is encoded.
///
/// The lower half of the octahedron is unfolded to the outside of the square, each coordinate with
/// the sign of its own: where one is zero, as +0 or as -0, the direction lies on the edge of the
/// square and has a code on either side of it.
pub(crate) fn is_octahedral(code: [i64; 2], w: DVec3, moved: f64) -> bool {
    let slack = TURNED.max(ROUNDING + STRETCH * moved / CODE);
    let p = w / (w.x.abs() + w.y.abs() + w.z.abs());
    let signs = |x: f64| {
        [-1.0, 1.0]
            .into_iter()
            .filter(move |s| s * x >= -slack * CODE)
    };
    let code_of = |x: f64| (x.clamp(-1.0, 1.0) + 1.0) / CODE;
    let is_code = |x: f64, y: f64| {
        [x, y]
            .into_iter()
            .zip(code)
            .all(|(x, c)| is_nearest(c, code_of(x), slack))
    };
    if p.z >= 0.0 {
        return is_code(p.x, p.y);
    }
    signs(p.x).any(|x| signs(p.y).any(|y| is_code((1.0 - p.y.abs()) * x, (1.0 - p.x.abs()) * y)))
}

/// The length of a code on the square.
const CODE: f64 = 2.0 / 65535.0;

/// The number that is rounded down to the code of a cosine.
pub(crate) fn cosine(cos_theta: f64) -> f64 {
    32767.0 * (cos_theta.clamp(-1.0, 1.0) + 1.0) / 2.0
}

/// What the code of a cosine stands for.
pub(crate) fn cosine_of(code: i64) -> f64 {
    2.0 * code as f64 / 32767.0 - 1.0
}

/// How far the roundings of an encoder or a decoder of cosines in single precision move that
/// number: three of a sum up to 2, in codes.
const COSINE_ROUNDING: f64 = 3.0 * 32767.0 * 0.5 * f32::EPSILON as f64;

/// Whether `code` is that of a cosine, rounded down, or the one below if rounding may lift the
/// decoded cosine above.
pub(crate) fn is_cosine(code: i64, cos_theta: f64) -> bool {
    let (code, exact) = (code as f64, cosine(cos_theta));
    code <= exact && exact - COSINE_ROUNDING < code + 1.0
}

/// A number that is rounded to a code, and by how much single precision moves it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Number {
    exact: f64,
    rounding: f64,
}

impl From<f64> for Number {
    fn from(exact: f64) -> Self {
        Self {
            exact,
            rounding: ROUNDING,
        }
    }
}

/// The number of a coordinate in the interval of a box, which loses digits far from the origin.
pub(crate) fn coordinate(x: f32, min: f32, max: f32) -> Number {
    let [x, min, max] = [x, min, max].map(f64::from);
    if max <= min {
        return Number::from(0.0);
    }
    let codes = 65535.0 / (max - min);
    let lost = 2.0 * f64::from(f32::EPSILON) * min.abs().max(max.abs());
    Number {
        exact: (codes * (x - min)).clamp(0.0, 65535.0),
        rounding: ROUNDING + codes * lost,
    }
}

/// The same for a direction, at least.
const TURNED: f64 = 0.15;

/// A direction `w` has the coordinates `w[i] / L` on the square, where `L` is the sum of its
/// absolute components, at least 1. If `w` moves by `d`, the numerator moves by at most `|d|`, and
/// `L` by at most `sqrt(3) |d|`, so that no coordinate moves by more than `1 + sqrt(3)` times
/// `|d|`.
const STRETCH: f64 = 2.733;

/// Whether `code` is a number rounded to the nearest code, which may be off by `slack` codes.
fn is_nearest(code: i64, exact: f64, slack: f64) -> bool {
    (code as f64 - exact).abs() <= 0.5 + slack
}

/// Whether `code` is a number rounded down.
pub(crate) fn is_below(code: i64, number: impl Into<Number>) -> bool {
    let (code, Number { exact, rounding }) = (code as f64, number.into());
    code <= exact + rounding && exact - rounding < code + 1.0
}

/// Whether `code` is a number rounded up.
pub(crate) fn is_above(code: i64, number: impl Into<Number>) -> bool {
    let (code, Number { exact, rounding }) = (code as f64, number.into());
    code >= exact - rounding && exact + rounding > code - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_direction_on_the_edge_of_the_square_has_a_code_on_either_side() {
        let top = 65535;
        for zero in [0.0, -0.0] {
            let down = DVec3::new(zero, zero, -1.0);
            for code in [[0, 0], [0, top], [top, 0], [top, top]] {
                assert!(is_octahedral(code, down, 0.0), "{code:?} of {down}");
            }
            let slanted = DVec3::new(zero, -0.5, -0.5);
            for x in [16384, 49151] {
                assert!(is_octahedral([x, 0], slanted, 0.0), "{x} of {slanted}");
                assert!(
                    !is_octahedral([x, top], slanted, 0.0),
                    "the other end of {x}"
                );
                assert!(!is_octahedral([x + 1, 0], slanted, 0.0), "beside {x}");
            }
        }
        let beside = DVec3::new(1e-4, -0.5, -0.5);
        assert!(is_octahedral([49153, 3], beside, 0.0), "its code");
        assert!(
            !is_octahedral([16382, 3], beside, 0.0),
            "that of its mirror image"
        );
        let up = DVec3::new(0.0, 0.5, 0.5);
        assert!(is_octahedral([32768, 49151], up, 0.0), "within the square");
        assert!(!is_octahedral([32768, 16384], up, 0.0), "its mirror image");
        // A direction that is moved by one code, 2 / 65535.
        assert!(!is_octahedral([32768, 49152], up, 0.0), "not moved");
        assert!(is_octahedral([32768, 49152], up, 2.0 / 65535.0), "moved");
        assert!(!is_octahedral([32768, 49155], up, 2.0 / 65535.0), "too far");
    }

    #[test]
    fn cosines_have_their_own_code_and_at_a_code_the_one_below() {
        let decoded = |number: f64| 2.0 * number / 32767.0 - 1.0;
        assert!(is_cosine(1000, decoded(1000.5)), "rounded down");
        assert!(is_cosine(999, decoded(1000.001)), "rounding may lift it");
        assert!(!is_cosine(999, decoded(1000.01)), "a whole code lost");
        assert!(!is_cosine(1001, decoded(1000.999)), "a narrower cone");
    }
}
