use lights::math::equal_area::{sphere_to_square, square_to_sphere, wrap};
use lights::math::glam::{Vec2, Vec3};

use crate::comparison::Comparison;
use crate::oracle::{Certainty, equal_area};
use crate::{Case, Findings, Malformed, Rule, Tolerance};

const POLYNOMIAL: Rule = Rule {
    name: "polynomial",
    reason: "the reference's arc tangent is a polynomial; ours is the answer in double precision",
};

const CLOSE: Tolerance = Tolerance::new(1e-6, 1e-6);

/// Maps in both directions, and the wrap rule.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    match case.get("op")?.text() {
        Some("square_to_sphere") => {
            let p = case.get("p")?.vec2()?;
            let d = square_to_sphere(p);
            let mut comparison = Comparison::default();
            let theirs = Some(case.get("d")?.vec3()?);
            comparison.vec3("d", findings.ours("d", d), theirs, Tolerance::GENERAL);
            let exact = equal_area::square_to_sphere(p.as_dvec2());
            comparison.settle(findings, || &POLYNOMIAL, |_| Some(vec![exact]));
            inverse(d, case.get("back")?.vec2()?, findings);
        }
        Some("sphere_to_square") => {
            inverse(case.get("d")?.vec3()?, case.get("p")?.vec2()?, findings);
        }
        Some("wrap") => {
            let out = findings.ours("wrap", wrap(case.get("p")?.vec2()?));
            findings.near2("out", out, case.get("out")?.vec2()?, Tolerance::GENERAL);
            findings.settled(Certainty::Determined);
        }
        other => return Err(Malformed(format!("no such op: {other:?}"))),
    }
    Ok(())
}

fn inverse(d: Vec3, theirs: Vec2, findings: &mut Findings) {
    let ours = findings.ours("p", sphere_to_square(d));
    let mut comparison = Comparison::default();
    comparison.vec2("p", ours, Some(theirs), CLOSE);
    comparison.settle(
        findings,
        || &POLYNOMIAL,
        |jitter| {
            let d = jitter.vector(d.as_dvec3(), f64::from(d.abs().max_element()));
            Some(vec![equal_area::sphere_to_square(d).extend(0.0)])
        },
    );
}
