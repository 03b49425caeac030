use lights::math::{OctahedralVector, quantize::QuantizedBox};

use crate::oracle::Certainty;
use crate::{Case, Findings, Malformed, Rule};

/// Single precision may round a number to either side of the edge between two codes.
pub(super) const ROUNDED_CODE: Rule = Rule {
    name: "rounded_code",
    reason: "a number lies on the edge between two codes up to single precision; ours is one of \
             its codes in double precision",
};

/// The codes of compact bounds.
pub(super) struct Codes {
    pub(super) w: OctahedralVector,
    pub(super) packed: u32,
    pub(super) bounds: QuantizedBox,
}

/// The codes in an object with the fields of compact bounds.
pub(super) fn compact_codes(case: &Case<'_>) -> Result<Codes, Malformed> {
    let w = case.get("w_oct")?;
    let qb = case.get("qb")?;
    let cos_theta_o = code(&case.get("q_cos_theta_o")?)?;
    let cos_theta_e = code(&case.get("q_cos_theta_e")?)?;
    let two_sided = case.get("two_sided")?.flag()?;
    Ok(Codes {
        w: OctahedralVector::from_xy(code(&w.at(0)?)?, code(&w.at(1)?)?),
        packed: u32::from(cos_theta_o) | u32::from(cos_theta_e) << 15 | u32::from(two_sided) << 30,
        bounds: QuantizedBox {
            min: codes(&qb.at(0)?)?,
            max: codes(&qb.at(1)?)?,
        },
    })
}

/// A code of ours is the reference's, or it is exact.
pub(super) fn judge(
    what: &str,
    is_same: bool,
    is_exact: bool,
    rule: &'static Rule,
    findings: &mut Findings,
) {
    findings.check(is_same || is_exact, || {
        format!("code of {what} is not exact")
    });
    if is_same {
        findings.settled(Certainty::Determined);
    } else {
        findings.settled(Certainty::Undetermined);
        findings.exempt(rule);
    }
}

fn codes(case: &Case<'_>) -> Result<[u16; 3], Malformed> {
    Ok([
        code(&case.at(0)?)?,
        code(&case.at(1)?)?,
        code(&case.at(2)?)?,
    ])
}

fn code(case: &Case<'_>) -> Result<u16, Malformed> {
    u16::try_from(case.index()?).map_err(|e| Malformed(e.to_string()))
}
