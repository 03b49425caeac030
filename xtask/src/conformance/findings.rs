use super::oracle::Certainty;
use super::sabotage::{Answer, Sabotage};
use lights::math::glam::{Vec2, Vec3};

/// A named reason why a difference is no failure.
#[derive(Debug, PartialEq, Eq)]
pub struct Rule {
    /// Short name, printed with the number of times that the rule was used.
    pub name: &'static str,
    /// Why the reference is wrong there, or why the answer is not determined.
    pub reason: &'static str,
}

/// How far two numbers may be apart: `absolute + relative * |reference|`.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Part that grows with the reference.
    pub relative: f32,
    /// Part that does not.
    pub absolute: f32,
}

impl Tolerance {
    /// The tolerance that the vectors state in general: a relative 1e-5.
    pub const GENERAL: Self = Self::new(1e-5, 1e-6);

    /// A tolerance of `relative * |reference| + absolute`.
    #[must_use]
    pub const fn new(relative: f32, absolute: f32) -> Self {
        Self { relative, absolute }
    }

    /// Whether `ours` is near enough to `theirs`; not-a-number and the infinities are near to themselves alone.
    #[must_use]
    pub fn accepts(self, ours: f32, theirs: f32) -> bool {
        if !(ours.is_finite() && theirs.is_finite()) {
            return ours == theirs || (ours.is_nan() && theirs.is_nan());
        }
        (ours - theirs).abs() <= self.absolute + self.relative * theirs.abs()
    }
}

/// What was seen on one line.
#[derive(Debug, Default)]
pub struct Findings {
    pub(super) holds: usize,
    pub(super) failures: Vec<String>,
    pub(super) exemptions: Vec<&'static Rule>,
    pub(super) sabotage: Sabotage,
}

impl Findings {
    /// Our answer on its way into the comparison, the only one: a self-test changes it here.
    pub fn ours<T: Answer>(&mut self, name: &'static str, answer: T) -> T {
        self.sabotage.pass(name, answer)
    }

    /// The same for whether there is an answer.
    pub fn ours_if_any<T>(&mut self, name: &'static str, answer: Option<T>) -> Option<T> {
        self.sabotage.pass_option(name, answer)
    }

    /// Notes that the answers since the last call have been compared, and whether the inputs determine them.
    pub(super) fn settled(&mut self, certainty: Certainty) {
        self.sabotage.settle(certainty == Certainty::Undetermined);
    }

    /// Notes a failure.
    pub fn fail(&mut self, message: String) {
        self.failures.push(message);
    }

    /// Notes that a comparison was not made, or may differ, for the reason that `rule` gives.
    pub fn exempt(&mut self, rule: &'static Rule) {
        self.exemptions.push(rule);
    }

    /// Notes whether `holds`; `message` says what went wrong otherwise.
    pub fn check(&mut self, holds: bool, message: impl FnOnce() -> String) {
        if holds {
            self.holds += 1;
        } else {
            self.fail(message());
        }
    }

    /// Compares two values that must be the same.
    pub fn equal<T: PartialEq + std::fmt::Debug>(&mut self, what: &str, ours: T, theirs: T) {
        self.check(ours == theirs, || {
            format!("{what}: {ours:?}, reference {theirs:?}")
        });
    }

    /// Compares two numbers.
    pub fn near(&mut self, what: &str, ours: f32, theirs: f32, tolerance: Tolerance) {
        self.check(tolerance.accepts(ours, theirs), || {
            format!("{what}: {ours:?}, reference {theirs:?}")
        });
    }

    /// Compares two points component by component.
    pub fn near2(&mut self, what: &str, ours: Vec2, theirs: Vec2, tolerance: Tolerance) {
        let near = (0..2).all(|i| tolerance.accepts(ours[i], theirs[i]));
        self.check(near, || format!("{what}: {ours:?}, reference {theirs:?}"));
    }

    /// Compares two points component by component.
    pub fn near3(&mut self, what: &str, ours: Vec3, theirs: Vec3, tolerance: Tolerance) {
        let near = (0..3).all(|i| tolerance.accepts(ours[i], theirs[i]));
        self.check(near, || format!("{what}: {ours:?}, reference {theirs:?}"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerance_keeps_oddities_apart() {
        let t = Tolerance::GENERAL;
        assert!(
            t.accepts(f32::NAN, f32::NAN) && !t.accepts(f32::NAN, 0.0),
            "NaN"
        );
        assert!(t.accepts(f32::INFINITY, f32::INFINITY), "same infinity");
        assert!(
            !t.accepts(f32::NEG_INFINITY, f32::INFINITY),
            "opposite infinities"
        );
        assert!(
            !t.accepts(1e38, f32::INFINITY),
            "finite is not near infinite"
        );
        assert!(
            t.accepts(1.000_005, 1.0) && !t.accepts(1.000_02, 1.0),
            "relative"
        );
    }
}
