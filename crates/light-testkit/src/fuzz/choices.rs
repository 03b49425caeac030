use light_bounds::{LightExtent, LightId, LightSampleContext, SampledLight};
use light_math::fraction;

use crate::may_contribute::may_contribute;

/// How far pmfs may be from the widths of the intervals of `u` that they represent, and their sum
/// from one: `f32` rounding error of all levels.
const ROUNDING: f64 = 2e-5;

/// Overlaps narrower than this are taken for rounding error.
const GAP: f64 = 4.0 * ROUNDING;

/// Values of `u` at which choices are tried.
const GRID: u32 = 128;

/// The `u` that lead to one light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Share {
    /// One interval, as wide as the pmf.
    Interval,
    /// Several, as of an alias table.
    Scattered,
}

/// One way to choose a light: for a receiver, for none, one of several, or by a cut.
pub(super) struct Choice<'a> {
    /// Name of the query, for messages.
    pub(super) name: &'a str,
    pub(super) sample: &'a dyn Fn(u64) -> Option<SampledLight>,
    pub(super) pmf: &'a dyn Fn(LightId) -> f32,
    /// How many lights there are.
    pub(super) count: u32,
    /// The intervals of `u` of each light.
    pub(super) share: Share,
}

impl Choice<'_> {
    /// Checks the sample at `u`: its light is known, and its pmf has the bits of the queried one.
    pub(super) fn checked(&self, u: u64) -> Option<SampledLight> {
        let chosen = (self.sample)(u)?;
        let asked = (self.pmf)(chosen.light);
        let name = self.name;
        assert!(
            chosen.light.0 < self.count,
            "{name}: {chosen:?} at {u} is unknown"
        );
        assert_eq!(
            chosen.pmf.to_bits(),
            asked.to_bits(),
            "{name}: {chosen:?} at {u}, but the queried pmf is {asked}"
        );
        assert!(
            chosen.pmf > 0.0 && chosen.pmf <= 1.0,
            "{name}: {chosen:?} at {u} is out of range"
        );
        Some(chosen)
    }

    /// Checks that every pmf is in `[0, 1]`, that of an unknown light 0, and their sum at most
    /// one; returns the sum.
    pub(super) fn sum(&self) -> f64 {
        let name = self.name;
        for unknown in [self.count, self.count + 1, u32::MAX] {
            let pmf = (self.pmf)(LightId(unknown));
            assert_eq!(pmf, 0.0, "{name}: pmf of the unknown light {unknown}");
        }
        let pmfs = (0..self.count).map(|id| {
            let pmf = (self.pmf)(LightId(id));
            assert!(
                (0.0..=1.0).contains(&pmf),
                "{name}: pmf {pmf} of light {id}"
            );
            f64::from(pmf)
        });
        let sum = pmfs.sum();
        assert!(sum <= 1.0 + ROUNDING, "{name}: the pmfs sum to {sum}");
        sum
    }

    /// Each light owns a part of `[0, 1)` as large as its pmf, no two overlap, and the
    /// rest of `u` chooses `None`.
    ///
    /// So the pmfs and the probability of `None` sum to one: a grid of `u` meets each interval that
    /// is wider than its step.
    pub(super) fn shares_fill_the_unit(&self, us: &[u64]) {
        let (sum, name) = (self.sum(), self.name);
        let mut found: Vec<Interval> = Vec::new();
        let mut is_some = |u: u64| {
            let chosen = self.checked(u);
            if let Some(chosen) = &chosen {
                if self.share == Share::Interval {
                    add(&mut found, Interval::of(u, chosen), name);
                }
            }
            chosen.is_some()
        };
        for u in [0, u64::MAX].iter().chain(us) {
            is_some(*u);
        }
        let step = 1.0 / f64::from(GRID);
        let none = (0..GRID).filter(|i| !is_some(fraction::stratum(*i, GRID, 1 << 63)));
        let none = none.count() as f64 * step;
        for id in (0..self.count).map(LightId) {
            let pmf = f64::from((self.pmf)(id));
            assert!(
                pmf <= step + GAP
                    || self.share == Share::Scattered
                    || found.iter().any(|interval| interval.light == id),
                "{name}: {id:?} has the pmf {pmf} and is never chosen: {found:?}"
            );
        }
        // Each end of an interval is off by a step at most, and narrow intervals are met by chance.
        let slack = step * (2.0 * f64::from(self.count) + 2.0);
        assert!(
            (sum + none - 1.0).abs() <= slack,
            "{name}: the pmfs sum to {sum}, none has about {none}: {found:?}"
        );
    }

    /// A light that certainly contributes at the receiver has a pmf above zero.
    pub(super) fn contributing_lights_are_possible(
        &self,
        lights: &[LightExtent],
        ctx: &LightSampleContext,
    ) {
        for (id, light) in (0..).map(LightId).zip(lights) {
            let pmf = (self.pmf)(id);
            assert!(
                pmf > 0.0 || !may_contribute(light, ctx),
                "{}: {id:?} may contribute and has pmf {pmf}: {light:?} at {ctx:?}",
                self.name
            );
        }
    }
}

/// The part of `[0, 1)` that leads to a light.
#[derive(Clone, Copy, Debug)]
struct Interval {
    light: LightId,
    start: f64,
    end: f64,
}

impl Interval {
    /// By the place that `u` has in it.
    fn of(u: u64, chosen: &SampledLight) -> Self {
        let pmf = f64::from(chosen.pmf);
        let start = fraction::to_f64(u) - fraction::to_f64(chosen.u) * pmf;
        Self {
            light: chosen.light,
            start,
            end: start + pmf,
        }
    }
}

/// Adds an interval, or finds it where it was before.
fn add(found: &mut Vec<Interval>, new: Interval, name: &str) {
    assert!(
        new.start >= -GAP && new.end <= 1.0 + GAP,
        "{name}: {new:?} leaves the unit interval"
    );
    for old in found.iter() {
        if old.light == new.light {
            assert!(
                (old.start - new.start).abs() <= GAP,
                "{name}: {new:?} and {old:?} differ"
            );
            return;
        }
        let overlap = old.end.min(new.end) - old.start.max(new.start);
        assert!(overlap <= GAP, "{name}: {new:?} and {old:?} overlap");
    }
    found.push(new);
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::panic::AssertUnwindSafe;
    use std::panic::catch_unwind;

    /// Whether a choice of three lights passes, of which `change` makes another.
    fn passes(change: impl Fn(u64, SampledLight) -> Option<SampledLight>) -> bool {
        let sample = |u| {
            let (light, rest) = fraction::choose(3, u);
            let chosen = SampledLight {
                light: LightId(light),
                pmf: 1.0 / 3.0,
                u: rest,
            };
            change(u, chosen)
        };
        let choice = Choice {
            name: "thirds",
            sample: &sample,
            pmf: &|light| if light.0 < 3 { 1.0 / 3.0 } else { 0.0 },
            count: 3,
            share: Share::Interval,
        };
        let check = || choice.shares_fill_the_unit(&[1 << 62]);
        catch_unwind(AssertUnwindSafe(check)).is_ok()
    }

    #[test]
    fn faults_are_found() {
        assert!(passes(|_, chosen| Some(chosen)), "a right choice");
        assert!(
            !passes(|u, chosen| Some(SampledLight { u, ..chosen })),
            "the same u is left"
        );
        assert!(
            !passes(|_, chosen| Some(SampledLight {
                pmf: 0.33,
                ..chosen
            })),
            "another pmf than the queried one"
        );
        assert!(
            !passes(|_, chosen| (chosen.light.0 < 2).then_some(chosen)),
            "none in place of the last"
        );
        let light = LightId(0);
        assert!(
            !passes(|_, chosen| Some(SampledLight { light, ..chosen })),
            "always the first"
        );
    }
}
