use lights::bounds::{CompactLightBounds, LightBounds, LightSampleContext};
use lights::math::{Aabb, OctahedralVector, quantize::QuantizedBox};

use super::bounds::{read_box, read_light_bounds};
use super::light_bounds_importance;
use crate::conformance::{Case, Findings, Malformed, Rule, Tolerance};

const BOX_TOO_SMALL: Rule = Rule {
    name: "box too small",
    reason: "the reference's decoded box does not contain the original; ours takes the next code",
};

/// Bounds to codes, back again, and the importance of what comes back.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let lb = read_light_bounds(&case.get("lb")?)?;
    let all = read_box(&case.get("all_bounds")?)?;
    let ours = CompactLightBounds::encode(&lb, &all);
    let decoded = ours.decode(&all);

    compare_codes(&ours, &lb, &all, &case.get("compact")?, findings)?;
    check_containment(&decoded, &lb, findings);
    compare_decoded(&decoded, &lb, &case.get("decoded")?, findings)?;

    let [p, n] = [case.get("p")?.vec3()?, case.get("n")?.vec3()?];
    let ctx = LightSampleContext::surface(p, n, n);
    let theirs = case.get("importance")?.float()?;
    let importance = ours.importance(&all, &ctx);
    light_bounds_importance::compare(&decoded, [p, n], importance, theirs, findings);
    let theirs = case.get("importance_uncompressed")?.float()?;
    light_bounds_importance::compare(&lb, [p, n], lb.importance(&ctx), theirs, findings);
    Ok(())
}

fn compare_codes(
    ours: &CompactLightBounds,
    lb: &LightBounds,
    all: &Aabb,
    theirs: &Case<'_>,
    findings: &mut Findings,
) -> Result<(), Malformed> {
    let codes = compact_codes(theirs)?;
    findings.equal("w_oct", ours.w(), codes.w);
    findings.equal("phi", ours.phi(), theirs.get("phi")?.float()?);
    findings.equal("codes of cosines", ours.packed(), codes.packed);
    let packed = theirs.get("packed_bits")?.index()?;
    findings.equal("packed_bits", ours.packed() as usize, packed);
    let qb = codes.bounds;
    if qb != ours.bounds() && !qb.decode(all).contains_box(&lb.bounds) {
        findings.exempt(&BOX_TOO_SMALL);
    } else {
        findings.equal("qb", ours.bounds(), qb);
    }
    Ok(())
}

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

fn check_containment(decoded: &LightBounds, lb: &LightBounds, findings: &mut Findings) {
    findings.check(decoded.bounds.contains_box(&lb.bounds), || {
        format!("{:?} does not contain {:?}", decoded.bounds, lb.bounds)
    });
    let [a, b] = [decoded.w, lb.w].map(|w| w.to_array().map(f64::from));
    let chord: f64 = (0..3).map(|i| (a[i] - b[i]).powi(2)).sum();
    let [theta, needed] = [decoded, lb].map(|lb| f64::from(lb.cos_theta_o).acos());
    let needed = needed + 2.0 * (0.5 * chord.sqrt()).asin();
    findings.check(decoded.cos_theta_o == -1.0 || theta >= needed, || {
        format!("cone of half angle {theta}, less than {needed}")
    });
    findings.check(decoded.cos_theta_e <= lb.cos_theta_e, || {
        format!("cos_theta_e: {} of {}", decoded.cos_theta_e, lb.cos_theta_e)
    });
}

fn compare_decoded(
    decoded: &LightBounds,
    lb: &LightBounds,
    theirs: &Case<'_>,
    findings: &mut Findings,
) -> Result<(), Malformed> {
    let bounds = read_box(&theirs.get("bounds")?)?;
    if bounds.contains_box(&lb.bounds) {
        findings.near3("min", decoded.bounds.min, bounds.min, Tolerance::GENERAL);
        findings.near3("max", decoded.bounds.max, bounds.max, Tolerance::GENERAL);
    } else {
        findings.exempt(&BOX_TOO_SMALL);
    }
    let w = theirs.get("w")?.vec3()?;
    findings.near3("w", decoded.w, w, Tolerance::GENERAL);
    let cos_theta_e = theirs.get("cos_theta_e")?.float()?;
    findings.near(
        "cos_theta_e",
        decoded.cos_theta_e,
        cos_theta_e,
        Tolerance::GENERAL,
    );

    // Ours is wider by the largest error of an axis, and a unit in the last place.
    let cos_theta_o = theirs.get("cos_theta_o")?.float()?;
    let widened = Tolerance::new(0.0, OctahedralVector::MAX_ANGULAR_ERROR + f32::EPSILON);
    findings.near("cos_theta_o", decoded.cos_theta_o, cos_theta_o, widened);
    Ok(())
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
