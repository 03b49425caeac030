use lights::math::OctahedralVector;

use crate::conformance::{Case, Findings, Malformed, Tolerance};

/// Both codes are the same integers, the decoded vectors the same up to round-off.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let (x, y) = OctahedralVector::encode(case.get("v")?.vec3()?).xy();
    let enc = case.get("enc")?;
    let theirs = [enc.at(0)?.integer()?, enc.at(1)?.integer()?];
    findings.equal("enc", [i64::from(x), i64::from(y)], theirs);

    let decoded = OctahedralVector::from_xy(x, y).decode();
    findings.near3("dec", decoded, case.get("dec")?.vec3()?, Tolerance::GENERAL);
    Ok(())
}
