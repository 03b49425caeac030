//! How the positions of a thin slanted sheet of lights are correlated, in the offset's byte.

#[cfg(feature = "alloc")]
use crate::lane_math::nearest;
#[cfg(feature = "alloc")]
use crate::node::spread_code::SpreadCode;
#[cfg(feature = "alloc")]
use crate::node::wide_node::WideNode;

/// The correlation that one step means. Two are the most: less than 1, for no sheet is without
/// depth. Chosen by V: see `docs/light-bvh-study.md`.
pub(crate) const CORRELATION: f32 = 0.325;

/// The code of three correlations that are 0.
#[cfg(feature = "alloc")]
const NONE: f32 = 63.0;

/// Three correlations, of -2 to 2 steps each, in a number of 1 to 125: above 0, which no offset of
/// a group of ramps is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SheetCode(pub(crate) i8);

impl SheetCode {
    /// The nearest correlations of x and y, y and z, z and x; `None` if all are 0, or any is not a
    /// number.
    #[cfg(feature = "alloc")]
    #[expect(clippy::cast_possible_truncation, reason = "of 1 to 125")]
    pub(crate) fn new(correlations: [f32; 3]) -> Option<Self> {
        let [a, b, c] = correlations.map(|r| nearest(2.0 * r.clamp(-1.0, 1.0)));
        let code = 25.0 * a + 5.0 * b + c;
        (code.abs() > 0.0).then_some(Self((code + NONE) as i8))
    }

    /// The correlations of x and y, y and z, z and x that `code` means, in 1 to 125.
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    pub(crate) fn correlations(code: i32) -> [f32; 3] {
        let steps = code - 1;
        [steps / 25, steps / 5 % 5, steps % 5].map(|step| CORRELATION * (step - 2) as f32)
    }
}

#[cfg(feature = "alloc")]
impl WideNode {
    /// Whether child `k` is a group of lights in a thin slanted sheet.
    pub(crate) const fn is_sheet(&self, k: usize) -> bool {
        let spread = SpreadCode(self.spread[k]);
        let is_ramp_group = spread.soft().and_not(spread.step()).is_set();
        self.has_rare() && is_ramp_group && self.offset[k] > 0
    }
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;

    #[test]
    fn codes_come_back() {
        for code in (1..=125).filter(|&code| code != 63) {
            let correlations = SheetCode::correlations(i32::from(code));
            let steps = correlations.map(|r| r / CORRELATION);
            assert!(steps.iter().all(|s| s.abs() <= 2.0), "{code}: {steps:?}");
            let again = SheetCode::new(steps.map(|s| 0.5 * s));
            assert_eq!(again, Some(SheetCode(code)), "{steps:?}");
        }
    }

    #[test]
    fn no_correlation_is_no_code() {
        for r in [[0.0; 3], [0.2, -0.2, 0.1], [f32::NAN, 1.0, 0.0]] {
            assert_eq!(SheetCode::new(r), None, "{r:?}");
        }
    }
}
