use super::Tolerance;
use super::fault_injection::{Answer, FaultInjection};
use super::oracle::Certainty;
use lights::math::glam::{Vec2, Vec3};

/// A named reason why a difference is no failure.
#[derive(Debug, PartialEq, Eq)]
pub struct Rule {
    /// Short name, printed with the number of times that the rule was used.
    pub name: &'static str,
    /// Why the reference is wrong there, or why the answer is not determined.
    pub reason: &'static str,
}

/// What was seen on one line.
#[derive(Debug, Default)]
pub struct Findings {
    pub(super) holds: usize,
    pub(super) failures: Vec<String>,
    pub(super) exemptions: Vec<&'static Rule>,
    pub(super) faults: FaultInjection,
}

impl Findings {
    /// Our answer on its way into the comparison, the only one: a self-test changes it here.
    pub fn ours<T: Answer>(&mut self, name: &'static str, answer: T) -> T {
        self.faults.pass(name, answer)
    }

    /// The same for whether there is an answer.
    pub fn ours_if_any<T>(&mut self, name: &'static str, answer: Option<T>) -> Option<T> {
        self.faults.pass_option(name, answer)
    }

    /// Notes that the answers since the last call have been compared, and whether the inputs
    /// determine them.
    pub(super) fn settled(&mut self, certainty: Certainty) {
        self.faults.settle(certainty == Certainty::Undetermined);
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
