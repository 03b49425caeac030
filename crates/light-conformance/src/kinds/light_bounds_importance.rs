use glam::DVec3;
use lights::bounds::{LightBounds, LightSampleContext};
use lights::math::glam::Vec3;

use super::bounds::{Margins, read_light_bounds};
use crate::comparison::Comparison;
use crate::oracle::Certainty;
use crate::oracle::cone::importance;
use crate::{Case, Findings, Malformed, Rule, Tolerance};

/// What the vectors state: cosines are known to 3e-4 at worst.
const COS_ERROR: f32 = 5e-4;

/// Round-off of the two cosines together.
const OUR_COS_ERROR: f32 = 5e-7;

/// How near to the bounding sphere, in radii, a point counts as on it.
const SPHERE_ERROR: f64 = 1e-5;

const AT_CENTRE: Rule = Rule {
    name: "receiver at the box centre",
    reason: "the reference normalises a vector of length zero and answers NaN; ours is positive",
};

const NO_FALLOFF: Rule = Rule {
    name: "light without falloff",
    reason: "the reference takes a light that emits nothing beyond its cone (theta_e = 0) for \
             dark; ours finds it",
};

const EMISSION_EDGE: Rule = Rule {
    name: "edge of the emission",
    reason: "at theta' = theta_e, to the reference's round-off, zero and the value beside the step \
             are both right",
};

const SPHERE_EDGE: Rule = Rule {
    name: "receiver on the bounding sphere",
    reason: "on the bounding sphere, to round-off, the box subtends a half space or everything",
};

const SINGLE: Rule = Rule {
    name: "single_precision",
    reason: "the box is small for its distance from the origin, or the point near to it, and the \
             reference loses digits",
};

/// Importance of bounds at a point, with and without a normal.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let lb = read_light_bounds(&case.get("lb")?)?;
    let at = [case.get("p")?.vec3()?, case.get("n")?.vec3()?];
    let ours = lb.importance(&LightSampleContext::surface(at[0], at[1], at[1]));
    let ours = ("importance", ours);
    compare(&lb, at, ours, case.get("importance")?.float()?, findings);
    Ok(())
}

/// Holds our importance of `lb` at the point and normal to the oracle, and compares it with the
/// reference's.
pub(super) fn compare(
    lb: &LightBounds,
    at: [Vec3; 2],
    (name, ours): (&'static str, f32),
    theirs: f32,
    findings: &mut Findings,
) {
    let margins = Margins::new(lb, at[0]);
    if margins.scale.is_infinite() {
        // At a light without extent: ours is a large number.
        let ours = findings.ours(name, ours);
        findings.check(ours > 0.0 && ours.is_finite(), || {
            format!("importance {ours}")
        });
        findings.settled(Certainty::Undetermined);
        return findings.exempt(&AT_CENTRE);
    }
    // The cosines alone, so that what is changed is not small for a light of large power.
    let scale = if margins.scale > 0.0 {
        margins.scale
    } else {
        1.0
    };
    let [cosines] = findings.ours(name, [f64::from(ours) / scale]);
    let mut comparison = Comparison::default();
    let tolerance = Tolerance::new(2e-5, OUR_COS_ERROR);
    comparison.number("importance by distance", cosines as f32, None, tolerance);
    comparison.ill_conditioned();
    comparison.settle(
        findings,
        || &SINGLE,
        |jitter| Some(vec![DVec3::X * importance(lb, at, jitter) / scale]),
    );
    let scale = scale as f32;
    if Tolerance::new(1e-4, COS_ERROR * scale).accepts(ours, theirs) {
        return findings.check(true, String::new);
    }
    let is_step = ours == 0.0 || theirs == 0.0;
    findings.exempt(if theirs.is_nan() {
        &AT_CENTRE
    } else if lb.cos_theta_e == 1.0 && theirs == 0.0 {
        &NO_FALLOFF
    } else if is_step && margins.emission_margin.abs() < f64::from(COS_ERROR) {
        &EMISSION_EDGE
    } else if margins.sphere_margin.abs() < SPHERE_ERROR {
        &SPHERE_EDGE
    } else {
        &SINGLE
    });
}
