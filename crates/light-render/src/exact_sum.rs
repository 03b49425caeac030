use core::ops::{Add, AddAssign};

use lights::glam::Vec3;

/// A sum of colours that does not depend on the order and grouping of its terms, so that parts of a
/// picture can be rendered anywhere and merged to the same bits.
///
/// Each channel counts steps of 2^-48 (3.6e-15) in 128 bits: terms smaller than that are lost. Terms
/// of more than 2^46 (7.0e13) count as 2^46, so that no sum of 2^32 terms overflows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExactSum([i128; 3]);

const STEPS: f64 = (1u64 << 48) as f64;
pub(crate) const LARGEST_TERM: f32 = (1u64 << 46) as f32;

impl ExactSum {
    /// The sum that counts so many steps of 2^-48, a number for each channel.
    #[must_use]
    pub const fn from_steps(steps: [i128; 3]) -> Self {
        Self(steps)
    }

    /// The steps of each channel.
    #[must_use]
    pub const fn steps(self) -> [i128; 3] {
        self.0
    }

    /// The sum over `count` terms, divided by their number.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "a mean is rounded to f32")]
    pub fn mean(self, count: u32) -> Vec3 {
        let scale = 1.0 / (STEPS * f64::from(count.max(1)));
        self.0.map(|steps| (steps as f64 * scale) as f32).into()
    }
}

impl From<Vec3> for ExactSum {
    #[inline]
    fn from(color: Vec3) -> Self {
        Self(color.to_array().map(steps))
    }
}

impl Add for ExactSum {
    type Output = Self;

    fn add(self, Self([x, y, z]): Self) -> Self {
        let [a, b, c] = self.0;
        Self([
            a.saturating_add(x),
            b.saturating_add(y),
            c.saturating_add(z),
        ])
    }
}

impl AddAssign<Vec3> for ExactSum {
    fn add_assign(&mut self, color: Vec3) {
        *self = *self + color.into();
    }
}

/// A channel's value in steps; NaN counts as 0.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "clamped; NaN counts as 0")]
fn steps(x: f32) -> i128 {
    (f64::from(x.clamp(-LARGEST_TERM, LARGEST_TERM)) * STEPS) as i128
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Colours over many orders of magnitude.
    pub(crate) fn terms() -> Vec<Vec3> {
        (0..200u16)
            .map(|i| {
                let x = (f32::from(i) * 0.37).sin() * 20.0;
                Vec3::new(x.exp2(), 1.0 / f32::from(i + 3), f32::from(i) * 1e3)
            })
            .collect()
    }

    fn sum(terms: impl IntoIterator<Item = Vec3>) -> ExactSum {
        let sums = terms.into_iter().map(ExactSum::from);
        sums.fold(ExactSum::default(), Add::add)
    }

    #[test]
    fn order_and_grouping_do_not_matter() {
        let terms = terms();
        let all = sum(terms.iter().copied());
        assert_eq!(sum(terms.iter().rev().copied()), all, "backwards");
        let (a, b) = terms.split_at(77);
        assert_eq!(
            sum(a.iter().copied()) + sum(b.iter().copied()),
            all,
            "in two parts"
        );
    }

    #[test]
    fn the_mean_is_that_of_the_terms() {
        let terms = terms();
        let exact: lights::glam::DVec3 = terms.iter().map(|t| t.as_dvec3()).sum();
        let mean = sum(terms).mean(200).as_dvec3();
        let off = mean / (exact / 200.0) - 1.0;
        assert!(off.abs().max_element() < 1e-6, "{mean}");
        assert_eq!(ExactSum::default().mean(0), Vec3::ZERO, "nothing");
    }

    #[test]
    fn nonsense_in_any_order_is_the_same_nonsense() {
        let terms = [Vec3::MAX, Vec3::MIN, Vec3::INFINITY, Vec3::NAN, Vec3::ONE];
        let all = sum(terms);
        assert_eq!(sum(terms.into_iter().rev()), all, "backwards");
        let mean = all.mean(1);
        assert_eq!(mean, Vec3::splat(LARGEST_TERM), "one of two is left");
    }
}
