use glam::DVec3;
use lights::math::{Aabb, DirectionCone};

use crate::conformance::comparison::Comparison;
use crate::conformance::oracle::Jitter;
use crate::conformance::oracle::cone::ExactCone;
use crate::conformance::{Case, Findings, Malformed, Rule, Tolerance};

const AT_THE_POINT: Rule = Rule {
    name: "receiver at the point itself",
    reason: "the reference normalises a vector of length zero; we answer with the whole sphere",
};

const ON_THE_SPHERE: Rule = Rule {
    name: "receiver on the bounding sphere",
    reason: "half or all directions, as the last bit of the distance falls",
};

const SINGLE: Rule = Rule {
    name: "single_precision",
    reason: "the axes are almost opposite or alike, and the reference loses digits; ours is the cone in double precision",
};

/// Unions of cones, and cones toward boxes.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let theirs = cone(&case.get("out")?)?;
    match case.get("op")?.text() {
        Some("union") => {
            let (a, b) = (cone(&case.get("a")?)?, cone(&case.get("b")?)?);
            let exact = |jitter: &mut Jitter| {
                let [a, b] = [a, b].map(|c| ExactCone::new(c.w, c.cos_theta));
                a.union(b, jitter)
            };
            compare(a.union(b), theirs, &SINGLE, exact, findings);
        }
        Some("bound_subtended") => {
            let corners = case.get("bounds")?;
            let bounds = Aabb {
                min: corners.at(0)?.vec3()?,
                max: corners.at(1)?.vec3()?,
            };
            let p = case.get("p")?.vec3()?;
            let ours = DirectionCone::bound_subtended_directions(&bounds, p);
            let [min, max, p] = [bounds.min, bounds.max, p].map(|v| v.as_dvec3());
            let exact = |jitter: &mut Jitter| {
                let magnitude = min.abs().max(max.abs()).max(p.abs()).max_element();
                let (exact, radius) = (0.5 * (min + max) - p, 0.5 * (max - min).length());
                let rounding = 8.0 * f64::from(f32::EPSILON) * magnitude;
                let is_on_sphere = (exact.length() - radius).abs() <= rounding;
                let to_center = jitter.vector(exact, magnitude);
                let sin = jitter.relative(radius) / to_center.length();
                let w = to_center.normalize_or_zero();
                // On the sphere half of all directions is as right as all of them, whose axis has no meaning.
                let cos_theta = if is_on_sphere {
                    jitter.either(-1.0, 0.0)
                } else if sin >= 1.0 {
                    -1.0
                } else {
                    (1.0 - sin * sin).sqrt()
                };
                ExactCone { w, cos_theta }
            };
            let rule = if theirs.w.is_nan() {
                &AT_THE_POINT
            } else {
                &ON_THE_SPHERE
            };
            compare(ours, theirs, rule, exact, findings);
        }
        other => return Err(Malformed(format!("no such op: {other:?}"))),
    }
    Ok(())
}

/// Compares the signed squares of cosines: the root of `1 - sin^2` near 0 has half of the digits that its square has.
fn compare(
    ours: DirectionCone,
    theirs: DirectionCone,
    rule: &'static Rule,
    exact: impl Fn(&mut Jitter) -> ExactCone,
    findings: &mut Findings,
) {
    if ours.is_empty() {
        let is_empty = findings.ours("empty", true);
        return findings.equal("empty", is_empty, theirs.is_empty());
    }
    let mut comparison = Comparison::default();
    let cos_theta = findings.ours("cos_theta", ours.cos_theta);
    comparison.number(
        "signed square of cos_theta",
        cos_theta * cos_theta.abs(),
        Some(theirs.cos_theta * theirs.cos_theta.abs()),
        Tolerance::GENERAL,
    );
    // The axis of all directions has no meaning.
    let is_whole = ours.is_whole_sphere();
    if !is_whole {
        let w = findings.ours("w", ours.w);
        comparison.vec3("w", w, Some(theirs.w), Tolerance::GENERAL);
    }
    comparison.settle(
        findings,
        || rule,
        |jitter| {
            let ExactCone { w, cos_theta } = exact(jitter);
            let mut truth = vec![DVec3::X * cos_theta * cos_theta.abs()];
            if !is_whole {
                truth.push(w);
            }
            Some(truth)
        },
    );
}

fn cone(case: &Case<'_>) -> Result<DirectionCone, Malformed> {
    Ok(DirectionCone::new(
        case.get("w")?.vec3()?,
        case.get("cos_theta")?.float()?,
    ))
}
