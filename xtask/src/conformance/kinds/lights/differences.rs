use crate::conformance::{Findings, Rule, Tolerance};
use lights::math::glam::{Vec2, Vec3};

/// The comparisons of one answer, to be excused together or not at all.
#[derive(Debug, Default)]
pub(super) struct Differences {
    compared: usize,
    messages: Vec<String>,
}

impl Differences {
    pub(super) fn near(&mut self, what: &str, ours: f32, theirs: f32, tolerance: Tolerance) {
        self.note(tolerance.accepts(ours, theirs), || {
            format!("{what}: {ours:?}, reference {theirs:?}")
        });
    }

    pub(super) fn near2(&mut self, what: &str, ours: Vec2, theirs: Vec2, tolerance: Tolerance) {
        let near = (0..2).all(|i| tolerance.accepts(ours[i], theirs[i]));
        self.note(near, || format!("{what}: {ours:?}, reference {theirs:?}"));
    }

    pub(super) fn near3(&mut self, what: &str, ours: Vec3, theirs: Vec3, tolerance: Tolerance) {
        let near = (0..3).all(|i| tolerance.accepts(ours[i], theirs[i]));
        self.note(near, || format!("{what}: {ours:?}, reference {theirs:?}"));
    }

    fn note(&mut self, holds: bool, message: impl FnOnce() -> String) {
        self.compared += 1;
        if !holds {
            self.messages.push(message());
        }
    }

    /// Reports: nothing differs, or a rule that applies excuses what does, or it fails.
    pub(super) fn settle(
        self,
        findings: &mut Findings,
        excuse: impl FnOnce() -> Option<&'static Rule>,
    ) {
        if self.messages.is_empty() {
            (0..self.compared).for_each(|_| findings.check(true, String::new));
        } else if let Some(rule) = excuse() {
            findings.exempt(rule);
        } else {
            self.messages
                .into_iter()
                .for_each(|message| findings.fail(message));
        }
    }
}
