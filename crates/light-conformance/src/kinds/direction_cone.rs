use glam::DVec3;
use lights::math::glam::Vec3;
use lights::math::{Aabb, DirectionCone};

use crate::comparison::Comparison;
use crate::oracle::cone::ExactCone;
use crate::oracle::subtended::Subtended;
use crate::oracle::{Certainty, Jitter};
use crate::{Case, Findings, Malformed, Rule, Tolerance};

const AT_THE_POINT: Rule = Rule {
    name: "receiver at the point itself",
    reason: "the reference normalises a vector of length zero; we answer with the whole sphere",
};

const ON_THE_SPHERE: Rule = Rule {
    name: "receiver on the bounding sphere",
    reason: "half or all directions, as the last bit of the distance falls",
};

const ROUNDED_CENTRE: Rule = Rule {
    name: "rounded centre",
    reason: "the box is small for its distance from the origin; ours is the cone in double \
             precision for a centre moved by its rounding",
};

const SINGLE: Rule = Rule {
    name: "single_precision",
    reason: "the axes are almost opposite or alike, and the reference loses digits; ours is the \
             cone in double precision",
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
            compare(a.union(b), theirs, exact, findings);
        }
        Some("bound_subtended") => {
            let corners = case.get("bounds")?;
            let bounds = Aabb {
                min: corners.at(0)?.vec3()?,
                max: corners.at(1)?.vec3()?,
            };
            compare_subtended(&bounds, case.get("p")?.vec3()?, theirs, findings);
        }
        other => return Err(Malformed(format!("no such op: {other:?}"))),
    }
    Ok(())
}

/// Holds the cone that a box subtends to its promise, and to the range that rounding leaves it.
fn compare_subtended(bounds: &Aabb, p: Vec3, theirs: DirectionCone, findings: &mut Findings) {
    let ours = DirectionCone::bound_subtended_directions(bounds, p);
    if ours.is_empty() {
        let is_empty = findings.ours("empty", true);
        return findings.equal("empty", is_empty, theirs.is_empty());
    }
    let exact = Subtended::new(bounds, p);
    let cos_theta = findings.ours("cos_theta", ours.cos_theta);
    exact.check_cosine(cos_theta, findings);
    exact.check_corners(DirectionCone::new(ours.w, cos_theta), findings);
    findings.settled(exact.certainty(ours.cos_theta));
    // The axis of all directions has no meaning.
    if !ours.is_whole_sphere() {
        let w = findings.ours("w", ours.w);
        exact.check_axis(w, findings);
        exact.check_corners(DirectionCone::new(w, ours.cos_theta), findings);
        findings.settled(Certainty::Determined);
    }
    if theirs.w.is_nan() {
        findings.exempt(&AT_THE_POINT);
    } else if ours.is_whole_sphere() != theirs.is_whole_sphere() {
        findings.exempt(&ON_THE_SPHERE);
    } else if !is_near(ours, theirs) {
        findings.exempt(&ROUNDED_CENTRE);
    }
}

/// Whether two cones have about the same axis and signed squares of their cosines: the root of
/// `1 - sin^2` near 0 has half of the digits that its square has.
fn is_near(ours: DirectionCone, theirs: DirectionCone) -> bool {
    let signed_square = |x: f32| x * x.abs();
    let [a, b] = [ours, theirs].map(|cone| signed_square(cone.cos_theta));
    let is_same_axis = |i: usize| Tolerance::GENERAL.accepts(ours.w[i], theirs.w[i]);
    Tolerance::GENERAL.accepts(a, b) && (ours.is_whole_sphere() || (0..3).all(is_same_axis))
}

/// Compares the cosines and the axes of unions.
fn compare(
    ours: DirectionCone,
    theirs: DirectionCone,
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
        "cos_theta",
        cos_theta,
        Some(theirs.cos_theta),
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
        || &SINGLE,
        |jitter| {
            let ExactCone { w, cos_theta } = exact(jitter);
            let mut truth = vec![DVec3::X * cos_theta];
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
