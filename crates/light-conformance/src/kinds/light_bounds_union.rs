use glam::DVec3;
use lights::math::DirectionCone;

use super::bounds::read_light_bounds;
use crate::comparison::Comparison;
use crate::oracle::Certainty;
use crate::oracle::cone::ExactCone;
use crate::{Case, Findings, Malformed, Rule, Tolerance};

const SINGLE: Rule = Rule {
    name: "single_precision",
    reason: "the axes are almost opposite or alike, and the reference loses digits; ours is the \
             cone in double precision",
};

/// Bounds of two groups of lights together.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let a = read_light_bounds(&case.get("a")?)?;
    let b = read_light_bounds(&case.get("b")?)?;
    let theirs = read_light_bounds(&case.get("union")?)?;
    let ours = a.union(&b);
    let min = findings.ours("min", ours.bounds.min);
    findings.equal("min", min, theirs.bounds.min);
    let max = findings.ours("max", ours.bounds.max);
    findings.equal("max", max, theirs.bounds.max);
    let phi = findings.ours("phi", ours.phi);
    findings.equal("phi", phi, theirs.phi);
    let two_sided = findings.ours("two_sided", ours.two_sided);
    findings.equal("two_sided", two_sided, theirs.two_sided);
    let cos_theta_e = findings.ours("cos_theta_e", ours.cos_theta_e);
    findings.equal("cos_theta_e", cos_theta_e, theirs.cos_theta_e);
    findings.settled(Certainty::Determined);

    let mut comparison = Comparison::default();
    let cos_theta_o = findings.ours("cos_theta_o", ours.cos_theta_o);
    comparison.number(
        "cos_theta_o",
        cos_theta_o,
        Some(theirs.cos_theta_o),
        Tolerance::GENERAL,
    );
    // The axis of all directions has no meaning.
    let is_whole = DirectionCone::is_whole_sphere(&ours.cone());
    if !is_whole {
        let w = findings.ours("w", ours.w);
        comparison.vec3("w", w, Some(theirs.w), Tolerance::new(0.0, 1e-4));
    }
    comparison.settle(
        findings,
        || &SINGLE,
        |jitter| {
            let [v, w] = [a, b].map(|lb| ExactCone::new(lb.w, lb.cos_theta_o));
            // Lights without power do not count.
            let cone = match [a, b].map(|lb| lb.phi == 0.0) {
                [true, _] => w,
                [_, true] => v,
                _ => v.union(w, jitter),
            };
            let mut truth = vec![DVec3::X * cone.cos_theta];
            if !is_whole {
                truth.push(cone.w);
            }
            Some(truth)
        },
    );
    Ok(())
}
