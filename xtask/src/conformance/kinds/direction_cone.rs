use lights::math::{Aabb, DirectionCone};

use crate::conformance::{Case, Findings, Malformed, Rule, Tolerance};

const AT_THE_POINT: Rule = Rule {
    name: "receiver at the point itself",
    reason: "the reference normalises a vector of length zero; we answer with the whole sphere",
};

const ON_THE_SPHERE: Rule = Rule {
    name: "receiver on the bounding sphere",
    reason: "half or all directions, as the last bit of the distance falls",
};

/// Unions of cones, and cones toward boxes.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let theirs = cone(&case.get("out")?)?;
    match case.get("op")?.text() {
        Some("union") => {
            let union = cone(&case.get("a")?)?.union(cone(&case.get("b")?)?);
            compare(union, theirs, findings);
        }
        Some("bound_subtended") => {
            let corners = case.get("bounds")?;
            let bounds = Aabb {
                min: corners.at(0)?.vec3()?,
                max: corners.at(1)?.vec3()?,
            };
            let p = case.get("p")?.vec3()?;
            let ours = DirectionCone::bound_subtended_directions(&bounds, p);
            let (center, radius) = bounds.bounding_sphere();
            if theirs.w.is_nan() {
                findings.exempt(&AT_THE_POINT);
                findings.equal("whole sphere", ours, DirectionCone::WHOLE_SPHERE);
            } else if (p.distance(center) - radius).abs() <= 4.0 * f32::EPSILON * radius
                && (ours.is_whole_sphere() || theirs.is_whole_sphere())
            {
                findings.exempt(&ON_THE_SPHERE);
            } else {
                compare(ours, theirs, findings);
            }
        }
        other => return Err(Malformed(format!("no such op: {other:?}"))),
    }
    Ok(())
}

fn compare(ours: DirectionCone, theirs: DirectionCone, findings: &mut Findings) {
    findings.near(
        "signed square of cos_theta",
        signed_square(ours.cos_theta),
        signed_square(theirs.cos_theta),
        Tolerance::GENERAL,
    );
    if !(theirs.is_empty() || theirs.is_whole_sphere()) {
        findings.near3("w", ours.w, theirs.w, Tolerance::GENERAL);
    }
}

/// The root of `1 - sin^2` near 0 has half of the digits that its square has.
fn signed_square(cos_theta: f32) -> f32 {
    cos_theta * cos_theta.abs()
}

fn cone(case: &Case<'_>) -> Result<DirectionCone, Malformed> {
    Ok(DirectionCone::new(
        case.get("w")?.vec3()?,
        case.get("cos_theta")?.float()?,
    ))
}
