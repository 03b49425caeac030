use core::ops::{Add, AddAssign};

use lights::glam::Vec3;

/// A sum of colours that is the same in whatever order and grouping its terms are added: so that parts of a picture can be
/// rendered anywhere and put together to the same bits.
///
/// Each channel counts steps of 2^-48 in 128 bits: terms smaller than that are lost, sums saturate at 2^79.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExactSum([i128; 3]);

const STEPS: f64 = (1u64 << 48) as f64;

impl ExactSum {
    /// How many floats a channel is written as; see [`to_lanes`](Self::to_lanes).
    pub const LANES: usize = 4;

    /// The sum over `count` terms, divided by their number.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "a mean is rounded to f32")]
    pub fn mean(&self, count: u32) -> Vec3 {
        let scale = 1.0 / (STEPS * f64::from(count.max(1)));
        self.0.map(|steps| (steps as f64 * scale) as f32).into()
    }

    /// The sum as [`LANES`](Self::LANES) colours of falling size that add up to it, exactly while it is below 2^48.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the next lane holds what this one rounds away"
    )]
    pub fn to_lanes(self) -> [Vec3; Self::LANES] {
        let mut rest = self.0;
        [(); Self::LANES].map(|()| {
            let lane = rest.map(|steps| steps as f32);
            for (steps, taken) in rest.iter_mut().zip(lane) {
                *steps = steps.saturating_sub(taken as i128);
            }
            lane.map(|steps| (f64::from(steps) / STEPS) as f32).into()
        })
    }

    /// The sum that [`to_lanes`](Self::to_lanes) was given.
    #[must_use]
    pub fn from_lanes(lanes: impl IntoIterator<Item = Vec3>) -> Self {
        lanes.into_iter().fold(Self::default(), |mut sum, lane| {
            sum += lane;
            sum
        })
    }
}

impl AddAssign<Vec3> for ExactSum {
    #[inline]
    fn add_assign(&mut self, color: Vec3) {
        for (sum, x) in self.0.iter_mut().zip(color.to_array()) {
            *sum = sum.saturating_add(steps(x));
        }
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

/// A channel's value in steps.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    reason = "saturates; NaN counts as 0"
)]
fn steps(x: f32) -> i128 {
    (f64::from(x) * STEPS) as i128
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Colours over many orders of magnitude.
    fn terms() -> Vec<Vec3> {
        (0..200u16)
            .map(|i| {
                let x = (f32::from(i) * 0.37).sin() * 20.0;
                Vec3::new(x.exp2(), 1.0 / f32::from(i + 3), f32::from(i) * 1e3)
            })
            .collect()
    }

    fn sum(terms: impl IntoIterator<Item = Vec3>) -> ExactSum {
        ExactSum::from_lanes(terms)
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
    fn lanes_hold_every_bit() {
        let sum = sum(terms());
        assert_eq!(ExactSum::from_lanes(sum.to_lanes()), sum, "there and back");
    }

    #[test]
    fn nonsense_saturates() {
        let mut sum = ExactSum::default();
        sum += Vec3::new(f32::INFINITY, f32::NAN, -1.0);
        let mean = sum.mean(1);
        assert!(mean.x > 1e23 && mean.y == 0.0 && mean.z == -1.0, "{mean}");
    }
}
