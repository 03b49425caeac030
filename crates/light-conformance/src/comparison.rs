use super::oracle::{Certainty, Conditioning, Jitter, Ours, confirm};
use super::{Findings, Rule, Tolerance};
use glam::{DVec3, Vec2, Vec3};

/// One answer with all its parts, to be right together.
#[derive(Debug, Default)]
pub(super) struct Comparison {
    parts: Vec<Part>,
}

/// A number (with zeros) or a vector of an answer.
#[derive(Debug)]
struct Part {
    what: &'static str,
    ours: Ours,
    /// None where the reference does not say.
    theirs: Option<DVec3>,
}

impl Part {
    /// None if the reference does not say.
    fn is_near(&self) -> Option<bool> {
        let theirs = self.theirs?;
        let Ours {
            answer, tolerance, ..
        } = self.ours;
        let accepts = |i: usize| tolerance.accepts(answer[i] as f32, theirs[i] as f32);
        Some((0..3).all(accepts))
    }
}

impl Comparison {
    /// Small moves of the inputs may move the last part far.
    pub(super) fn ill_conditioned(&mut self) {
        if let Some(part) = self.parts.last_mut() {
            part.ours.conditioning = Conditioning::Ill;
        }
    }

    pub(super) fn number(
        &mut self,
        what: &'static str,
        ours: f32,
        theirs: Option<f32>,
        tolerance: Tolerance,
    ) {
        let number = |x: f32| Vec3::new(x, 0.0, 0.0);
        self.vec3(what, number(ours), theirs.map(number), tolerance);
    }

    pub(super) fn vec2(
        &mut self,
        what: &'static str,
        ours: Vec2,
        theirs: Option<Vec2>,
        tolerance: Tolerance,
    ) {
        let theirs = theirs.map(|v| v.extend(0.0));
        self.vec3(what, ours.extend(0.0), theirs, tolerance);
    }

    pub(super) fn vec3(
        &mut self,
        what: &'static str,
        ours: Vec3,
        theirs: Option<Vec3>,
        tolerance: Tolerance,
    ) {
        self.parts.push(Part {
            what,
            ours: Ours {
                answer: ours.as_dvec3(),
                tolerance,
                conditioning: Conditioning::Well,
            },
            theirs: theirs.map(|v| v.as_dvec3()),
        });
    }

    /// Holds if the reference says the same of all parts. Otherwise ours has to be the `truth`, and
    /// `rule` says why the reference is not.
    pub(super) fn settle(
        self,
        findings: &mut Findings,
        rule: impl FnOnce() -> &'static Rule,
        truth: impl Fn(&mut Jitter) -> Option<Vec<DVec3>>,
    ) {
        if self.parts.iter().all(|part| part.is_near() == Some(true)) {
            findings.settled(Certainty::Determined);
            return findings.check(true, String::new);
        }
        let ours: Vec<_> = self.parts.iter().map(|part| part.ours).collect();
        let confirmed = confirm(&ours, truth);
        findings.settled(*confirmed.as_ref().unwrap_or(&Certainty::Determined));
        match confirmed {
            Ok(_) if self.parts.iter().any(|part| part.is_near() == Some(false)) => {
                findings.exempt(rule());
            }
            Ok(_) => findings.check(true, String::new),
            Err(truth) => {
                let parts = self.parts.iter().map(|Part { what, ours, theirs }| {
                    let ours = ours.answer;
                    theirs.map_or(format!("{what} {ours}"), |theirs| {
                        format!("{what} {ours}, reference {theirs}")
                    })
                });
                let parts: Vec<_> = parts.collect();
                findings.fail(format!("{}; exact {truth}", parts.join("; ")));
            }
        }
    }
}

/// The same where ours has no result: the truth has none either, for inputs as near as
/// rounding moves them. `rule` says why the reference has one, if it has.
pub(super) fn settle_none<T>(
    findings: &mut Findings,
    what: &str,
    rule: Option<&'static Rule>,
    truth: impl Fn(&mut Jitter) -> Option<T>,
) {
    if confirm(&[], |jitter| match truth(jitter) {
        None => Some(Vec::new()),
        Some(_) => None,
    })
    .is_ok()
    {
        findings.settled(Certainty::Undetermined);
        match rule {
            Some(rule) => findings.exempt(rule),
            None => findings.check(true, String::new),
        }
    } else {
        findings.fail(format!("{what}: none, and in double precision one"));
    }
}
