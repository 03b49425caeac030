use lights::bounds::{LightBounds, LightSampleContext};
use lights::math::glam::Vec3;

use super::bounds::{PreciseImportance, read_light_bounds};
use crate::conformance::{Case, Findings, Malformed, Rule, Tolerance};

/// What the vectors state: cosines are known to 3e-4 at worst.
const COS_ERROR: f32 = 5e-4;

/// How near to the bounding sphere, in radii, a point counts as on it.
const SPHERE_ERROR: f64 = 2e-6;

const AT_CENTRE: Rule = Rule {
    name: "receiver at the box centre",
    reason: "the reference normalises a vector of length zero and answers NaN; ours is positive",
};

const NO_FALLOFF: Rule = Rule {
    name: "light without falloff",
    reason: "the reference takes a light that emits nothing beyond its cone (theta_e = 0) for dark; ours finds it",
};

const EMISSION_EDGE: Rule = Rule {
    name: "edge of the emission",
    reason: "at theta' = theta_e, to round-off, zero and the value beside the step are both right",
};

const SPHERE_EDGE: Rule = Rule {
    name: "receiver on the bounding sphere",
    reason: "on the bounding sphere, to round-off, the box subtends a half space or everything; ours takes the larger",
};

/// Importance of bounds at a point, with and without a normal.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let lb = read_light_bounds(&case.get("lb")?)?;
    let [p, n] = [case.get("p")?.vec3()?, case.get("n")?.vec3()?];
    let ours = lb.importance(&LightSampleContext::surface(p, n, n));
    compare(
        &lb,
        [p, n],
        ours,
        case.get("importance")?.float()?,
        findings,
    );
    Ok(())
}

/// Compares our importance of `lb` at the point and normal with the reference's.
pub(super) fn compare(
    lb: &LightBounds,
    [p, n]: [Vec3; 2],
    ours: f32,
    theirs: f32,
    findings: &mut Findings,
) {
    findings.check(ours.is_finite() && ours >= 0.0, || {
        format!("importance: {ours:?} is no importance")
    });
    let precise = PreciseImportance::new(lb, p, n);
    if theirs.is_nan() && p == lb.bounds.center() && (ours > 0.0) == (lb.phi > 0.0) {
        return findings.exempt(&AT_CENTRE);
    }

    let tolerance = Tolerance::new(1e-4, COS_ERROR * precise.scale as f32);
    if tolerance.accepts(ours, theirs) {
        return findings.near("importance", ours, theirs, tolerance);
    }
    if lb.cos_theta_e == 1.0 && theirs == 0.0 && precise.emission_margin > -f64::from(COS_ERROR) {
        return findings.exempt(&NO_FALLOFF);
    }
    let at_step = ours == 0.0 || theirs == 0.0;
    if at_step && precise.emission_margin.abs() < f64::from(COS_ERROR) {
        return findings.exempt(&EMISSION_EDGE);
    }
    if precise.sphere_margin.abs() < SPHERE_ERROR && ours >= theirs {
        return findings.exempt(&SPHERE_EDGE);
    }
    findings.fail(format!(
        "importance: {ours:?}, reference {theirs:?}, precisely {:e} (margins: emission {:e}, sphere {:e})",
        precise.importance, precise.emission_margin, precise.sphere_margin
    ));
}
