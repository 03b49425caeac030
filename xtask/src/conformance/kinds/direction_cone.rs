use glam::DVec3;
use lights::math::{Aabb, DirectionCone};

use crate::conformance::comparison::Comparison;
use crate::conformance::oracle::cone::ExactCone;
use crate::conformance::oracle::{Conditioning, Jitter};
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
            compare(
                a.union(b),
                theirs,
                &SINGLE,
                Conditioning::Well,
                exact,
                findings,
            );
        }
        Some("bound_subtended") => {
            let corners = case.get("bounds")?;
            let bounds = Aabb {
                min: corners.at(0)?.vec3()?,
                max: corners.at(1)?.vec3()?,
            };
            let p = case.get("p")?.vec3()?;
            let ours = DirectionCone::bound_subtended_directions(&bounds, p);
            let [min, max, p64] = [bounds.min, bounds.max, p].map(|v| v.as_dvec3());
            let exact = |jitter: &mut Jitter| {
                let magnitude = min.abs().max(max.abs()).max(p64.abs()).max_element();
                let (exact, radius) = (0.5 * (min + max) - p64, 0.5 * (max - min).length());
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
            let corners = [bounds.min, bounds.max].map(|v| v.as_dvec3());
            check_corners(ours, corners, p.as_dvec3(), findings);
            // The axis toward a box that is tiny for its coordinates is known to few digits.
            compare(ours, theirs, rule, Conditioning::Ill, exact, findings);
        }
        other => return Err(Malformed(format!("no such op: {other:?}"))),
    }
    Ok(())
}

/// Holds the cone seen from `p` to its promise: the box of two `corners` lies in it, up to what rounding of its centre
/// turns the axis.
fn check_corners(cone: DirectionCone, corners: [DVec3; 2], p: DVec3, findings: &mut Findings) {
    const UNIT: f64 = f32::EPSILON as f64;
    let signed_square = |x: f64| x * x.abs();
    let [min, max] = corners;
    let magnitude = min.abs().max(max.abs()).max(p.abs()).max_element();
    let rounding = 16.0 * UNIT + 4.0 * UNIT * magnitude / (0.5 * (min + max) - p).length();
    let (w, cos_theta) = (cone.w.as_dvec3(), f64::from(cone.cos_theta));
    for i in 0..8 {
        let corner = DVec3::from_array([0, 1, 2].map(|axis| corners[i >> axis & 1][axis]));
        let cos = w.dot((corner - p).normalize_or(w));
        let is_in = signed_square(cos) >= signed_square(cos_theta) - rounding;
        findings.check(cone.is_whole_sphere() || is_in, || {
            format!("{cone:?} lacks {corner} from {p}")
        });
    }
}

/// Compares the signed squares of cosines: the root of `1 - sin^2` near 0 has half of the digits that its square has.
fn compare(
    ours: DirectionCone,
    theirs: DirectionCone,
    rule: &'static Rule,
    axis: Conditioning,
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
        if axis == Conditioning::Ill {
            comparison.ill_conditioned();
        }
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
