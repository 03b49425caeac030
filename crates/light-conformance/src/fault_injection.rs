//! The one place where our answers enter the comparison, and where a self-test changes them.

use std::fmt::Debug;

use lights::math::glam::{Vec2, Vec3};

/// What a self-test does to one answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// Twice as much; a half more where that is within tolerance, the other truth value, the next
    /// integer.
    Double,
    /// Half of it; the integer before.
    Halve,
    /// The opposite.
    Negate,
    /// No answer where there is one.
    Lose,
}

impl Change {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Double, Self::Halve, Self::Negate, Self::Lose];
}

/// Smaller answers are within the absolute tolerances, so a factor makes no difference.
const TINY: f64 = 1e-5;

/// An answer of the library under test.
pub trait Answer: Copy + Debug {
    /// The changed answer; none where the change makes no sense or no difference.
    fn changed(self, change: Change) -> Option<Self>;
}

impl<const N: usize> Answer for [f64; N] {
    fn changed(self, change: Change) -> Option<Self> {
        let is_tiny = self.iter().all(|x| x.abs() < TINY);
        let is_number = self.iter().all(|x| x.is_finite());
        match change {
            _ if !is_number => None,
            Change::Double if is_tiny => Some(self.map(|x| x + 0.5)),
            Change::Double => Some(self.map(|x| 2.0 * x)),
            Change::Halve if !is_tiny => Some(self.map(|x| 0.5 * x)),
            Change::Negate if !is_tiny => Some(self.map(|x| -x)),
            Change::Halve | Change::Negate | Change::Lose => None,
        }
    }
}

impl<const N: usize> Answer for [f32; N] {
    fn changed(self, change: Change) -> Option<Self> {
        Some(self.map(f64::from).changed(change)?.map(|x| x as f32))
    }
}

impl Answer for f32 {
    fn changed(self, change: Change) -> Option<Self> {
        [self].changed(change).map(|[x]| x)
    }
}

impl Answer for Vec2 {
    fn changed(self, change: Change) -> Option<Self> {
        self.to_array().changed(change).map(Self::from_array)
    }
}

impl Answer for Vec3 {
    fn changed(self, change: Change) -> Option<Self> {
        self.to_array().changed(change).map(Self::from_array)
    }
}

impl Answer for bool {
    fn changed(self, change: Change) -> Option<Self> {
        (change == Change::Double).then_some(!self)
    }
}

impl Answer for i64 {
    fn changed(self, change: Change) -> Option<Self> {
        match change {
            Change::Double => Some(self + 1),
            Change::Halve => Some(self - 1),
            Change::Negate | Change::Lose => None,
        }
    }
}

impl<const N: usize> Answer for [i64; N] {
    fn changed(self, change: Change) -> Option<Self> {
        let mut changed = self;
        *changed.last_mut()? = changed[N - 1].changed(change)?;
        Some(changed)
    }
}

/// What happens to the answers of one line.
#[derive(Debug, Default)]
pub struct FaultInjection {
    /// The names of the answers so far.
    pub(super) names: Vec<&'static str>,
    /// Which of them is changed, and how.
    pub(super) target: Option<(usize, Change)>,
    /// Whether it was.
    pub(super) is_done: bool,
    /// What it was changed from and to.
    pub(super) change: String,
    /// How many answers have been compared.
    settled: usize,
    /// Whether the changed answer passed because the inputs do not determine it.
    pub(super) is_undetermined: bool,
}

impl FaultInjection {
    /// `answer`, changed if it is the one to change.
    pub(super) fn pass<T: Answer>(&mut self, name: &'static str, answer: T) -> T {
        match self.next(name).and_then(|change| answer.changed(change)) {
            Some(changed) => {
                self.is_done = true;
                self.change = format!("{answer:?} to {changed:?}");
                changed
            }
            None => answer,
        }
    }

    /// `answer`, lost if it is the one to change.
    pub(super) fn pass_option<T>(&mut self, name: &'static str, answer: Option<T>) -> Option<T> {
        if self.next(name) == Some(Change::Lose) && answer.is_some() {
            self.is_done = true;
            self.change = "an answer to none".to_owned();
            return None;
        }
        answer
    }

    /// All answers so far have been compared, those since the last call with one outcome.
    pub(super) fn settle(&mut self, is_undetermined: bool) {
        let compared = self.settled..self.names.len();
        self.settled = compared.end;
        let is_target = self.target.is_some_and(|(i, _)| compared.contains(&i));
        self.is_undetermined |= is_undetermined && is_target;
    }

    fn next(&mut self, name: &'static str) -> Option<Change> {
        let index = self.names.len();
        self.names.push(name);
        let target = self.target.filter(|target| target.0 == index);
        target.map(|(_, change)| change)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_target_changes() {
        let mut faults = FaultInjection {
            target: Some((1, Change::Double)),
            ..FaultInjection::default()
        };
        let answers = ["a", "b", "c"].map(|name| faults.pass(name, 0.25f32));
        assert_eq!(answers, [0.25, 0.5, 0.25], "the second");
        assert!(faults.is_done, "done");
        assert_eq!(0.0f32.changed(Change::Double), Some(0.5), "not zero again");
        assert_eq!(0.0f32.changed(Change::Halve), None, "no difference");
    }
}
