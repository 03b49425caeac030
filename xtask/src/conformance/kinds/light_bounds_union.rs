use lights::math::DirectionCone;

use super::bounds::read_light_bounds;
use crate::conformance::{Case, Findings, Malformed, Tolerance};

/// Bounds of two groups of lights together.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let a = read_light_bounds(&case.get("a")?)?;
    let b = read_light_bounds(&case.get("b")?)?;
    let theirs = read_light_bounds(&case.get("union")?)?;
    let ours = a.union(&b);
    findings.equal("bounds", ours.bounds, theirs.bounds);
    findings.equal("phi", ours.phi, theirs.phi);
    findings.equal("two_sided", ours.two_sided, theirs.two_sided);
    findings.equal("cos_theta_e", ours.cos_theta_e, theirs.cos_theta_e);
    findings.near(
        "cos_theta_o",
        ours.cos_theta_o,
        theirs.cos_theta_o,
        Tolerance::GENERAL,
    );
    // The axis of all directions has no meaning.
    if !DirectionCone::is_whole_sphere(&theirs.cone()) {
        findings.near3("w", ours.w, theirs.w, Tolerance::new(0.0, 1e-4));
    }
    Ok(())
}
