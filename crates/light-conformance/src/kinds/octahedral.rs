use lights::math::OctahedralVector;

use super::compact_codes::{ROUNDED_CODE, judge};
use crate::oracle::{Certainty, codes};
use crate::{Case, Findings, Malformed, Tolerance};

/// Both codes are the same integers, the decoded vectors the same up to round-off.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let v = case.get("v")?.vec3()?;
    let (x, y) = OctahedralVector::encode(v).xy();
    let ours = findings.ours("codes", [x, y].map(i64::from));
    let enc = case.get("enc")?;
    let theirs = [enc.at(0)?.integer()?, enc.at(1)?.integer()?];
    let is_exact = codes::is_octahedral(ours, v.as_dvec3(), 0.0);
    judge(
        "direction",
        ours == theirs,
        is_exact,
        &ROUNDED_CODE,
        findings,
    );
    if ours == theirs {
        let decoded = findings.ours("decoded", OctahedralVector::from_xy(x, y).decode());
        findings.near3("dec", decoded, case.get("dec")?.vec3()?, Tolerance::GENERAL);
        findings.settled(Certainty::Determined);
    }
    Ok(())
}
