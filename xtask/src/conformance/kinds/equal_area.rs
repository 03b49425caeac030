use lights::math::equal_area::{sphere_to_square, square_to_sphere, wrap};

use crate::conformance::{Case, Findings, Malformed, Tolerance};

/// The reference's arc tangent is a polynomial; ours is not.
const POLYNOMIAL: Tolerance = Tolerance::new(0.0, 5e-6);

/// Maps in both directions, and the wrap rule.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    match case.get("op")?.text() {
        Some("square_to_sphere") => {
            let d = square_to_sphere(case.get("p")?.vec2()?);
            findings.near3("d", d, case.get("d")?.vec3()?, Tolerance::GENERAL);
            let back = case.get("back")?.vec2()?;
            findings.near2("back", sphere_to_square(d), back, POLYNOMIAL);
        }
        Some("sphere_to_square") => {
            let p = sphere_to_square(case.get("d")?.vec3()?);
            findings.near2("p", p, case.get("p")?.vec2()?, POLYNOMIAL);
        }
        Some("wrap") => {
            let out = wrap(case.get("p")?.vec2()?);
            findings.near2("out", out, case.get("out")?.vec2()?, Tolerance::GENERAL);
        }
        other => return Err(Malformed(format!("no such op: {other:?}"))),
    }
    Ok(())
}
