use lights::bounds::{CompactLightBounds, LightBounds, LightSampleContext};
use lights::math::{Aabb, OctahedralVector, quantize::QuantizedBox};

use super::bounds::{read_box, read_light_bounds};
use super::compact_codes::{ROUNDED_CODE, compact_codes, judge};
use super::light_bounds_importance;
use crate::oracle::{Certainty, codes};
use crate::{Case, Findings, Malformed, Rule, Tolerance};

const BOX_TOO_SMALL: Rule = Rule {
    name: "box too small",
    reason: "the reference's decoded box does not contain the original; ours takes the next code",
};

const COSINE_ON_CODE: Rule = Rule {
    name: "cosine at a code",
    reason: "the reference's code decodes to more than the cosine, a narrower cone; ours is the \
             one below, which is right in double precision",
};

/// Bounds to codes, back again, and the importance of what comes back.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let lb = read_light_bounds(&case.get("lb")?)?;
    let all = read_box(&case.get("all_bounds")?)?;
    let ours = CompactLightBounds::encode(&lb, &all);
    let decoded = ours.decode(&all);

    compare_codes(&ours, &lb, &all, &case.get("compact")?, findings)?;
    check_containment(&decoded, &lb, findings);
    let codes = compact_codes(&case.get("compact")?)?;
    let is_same = codes.w == ours.w() && codes.bounds == ours.bounds();
    let theirs = case.get("decoded")?;
    let cosines = cosine_codes(i64::from(ours.packed()));
    compare_decoded(&decoded, &lb, &all, &theirs, is_same, cosines, findings)?;

    let [p, n] = [case.get("p")?.vec3()?, case.get("n")?.vec3()?];
    let ctx = LightSampleContext::surface(p, n, n);
    let theirs = case.get("importance")?.float()?;
    let importance = ("importance", ours.importance(&all, &ctx));
    light_bounds_importance::compare(&decoded, [p, n], importance, theirs, findings);
    let theirs = case.get("importance_uncompressed")?.float()?;
    let exact = ("uncompressed", lb.importance(&ctx));
    light_bounds_importance::compare(&lb, [p, n], exact, theirs, findings);
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
    let xy = |w: OctahedralVector| [w.xy().0, w.xy().1].map(i64::from);
    let w = findings.ours("w_oct", xy(ours.w()));
    let is_exact = codes::is_octahedral(w, lb.w.as_dvec3(), 0.0);
    judge("w", w == xy(codes.w), is_exact, &ROUNDED_CODE, findings);
    let phi = findings.ours("phi", ours.phi());
    findings.equal("phi", phi, theirs.get("phi")?.float()?);
    let packed = findings.ours("packed", i64::from(ours.packed()));
    let their_packed = theirs.get("packed_bits")?.integer()?;
    findings.equal("their packed bits", i64::from(codes.packed), their_packed);
    let [our_cos, their_cos] = [packed, their_packed].map(cosine_codes);
    findings.equal("two_sided", packed >> 30, their_packed >> 30);
    for (i, cos_theta) in [lb.cos_theta_o, lb.cos_theta_e].into_iter().enumerate() {
        let is_exact = codes::is_cosine(our_cos[i], f64::from(cos_theta));
        findings.check(our_cos[i] == their_cos[i] || is_exact, || {
            format!("code of cosine {i}: {our_cos:?}, reference {their_cos:?}")
        });
    }
    if packed == their_packed {
        findings.settled(Certainty::Determined);
    } else {
        findings.settled(Certainty::Undetermined);
        findings.exempt(&COSINE_ON_CODE);
    }

    // Ours may take the next code, so that the decoded box holds the original.
    let qb = codes.bounds;
    let is_too_small = !qb.decode(all).contains_box(&lb.bounds);
    let rule = if is_too_small {
        &BOX_TOO_SMALL
    } else {
        &ROUNDED_CODE
    };
    for axis in 0..3 {
        let number = |x: f32| codes::coordinate(x, all.min[axis], all.max[axis]);
        let low = findings.ours("qb min", i64::from(ours.bounds().min[axis]));
        let is_exact = codes::is_below(low, number(lb.bounds.min[axis]));
        let is_same = low == i64::from(qb.min[axis]);
        let is_held = decoded_coordinate(low, axis, all) <= lb.bounds.min[axis];
        judge(
            "min",
            is_same && is_held,
            is_exact && is_held,
            rule,
            findings,
        );
        let high = findings.ours("qb max", i64::from(ours.bounds().max[axis]));
        let is_exact = codes::is_above(high, number(lb.bounds.max[axis]));
        let is_same = high == i64::from(qb.max[axis]);
        let is_held = decoded_coordinate(high, axis, all) >= lb.bounds.max[axis];
        judge(
            "max",
            is_same && is_held,
            is_exact && is_held,
            rule,
            findings,
        );
    }
    Ok(())
}

/// What a code of a coordinate stands for, as the library decodes it; not a number if it is none.
fn decoded_coordinate(code: i64, axis: usize, all: &Aabb) -> f32 {
    let Ok(code) = u16::try_from(code) else {
        return f32::NAN;
    };
    let codes = [code; 3];
    let corner = QuantizedBox {
        min: codes,
        max: codes,
    };
    corner.decode(all).min[axis]
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
    all: &Aabb,
    theirs: &Case<'_>,
    is_same: bool,
    cosines: [i64; 2],
    findings: &mut Findings,
) -> Result<(), Malformed> {
    let bounds = read_box(&theirs.get("bounds")?)?;
    if bounds.contains_box(&lb.bounds) {
        // By at most one code, where one of both is rounded.
        let code = all.diagonal().max_element() / 65535.0;
        let tolerance = Tolerance::new(1e-5, 1e-6 + if is_same { 0.0 } else { code });
        let min = findings.ours("decoded min", decoded.bounds.min);
        findings.near3("min", min, bounds.min, tolerance);
        let max = findings.ours("decoded max", decoded.bounds.max);
        findings.near3("max", max, bounds.max, tolerance);
    } else {
        findings.exempt(&BOX_TOO_SMALL);
    }
    let w = theirs.get("w")?.vec3()?;
    let our_w = findings.ours("decoded w", decoded.w);
    let tolerance = Tolerance::new(1e-5, if is_same { 1e-6 } else { 1e-4 });
    findings.near3("w", our_w, w, tolerance);
    // What our codes stand for; the reference's code may be one too high, and its cone is not
    // widened.
    let [code_o, code_e] = cosines.map(codes::cosine_of);
    let ours = findings.ours("decoded cos_theta_e", decoded.cos_theta_e);
    let tolerance = Tolerance::new(0.0, f32::EPSILON);
    findings.near("cos_theta_e", ours, code_e as f32, tolerance);
    findings.settled(Certainty::Determined);
    let widened = code_o.acos() + f64::from(OctahedralVector::MAX_ANGULAR_ERROR);
    let ours = findings.ours("decoded cos_theta_o", decoded.cos_theta_o);
    let exact = widened.min(std::f64::consts::PI).cos() as f32;
    let tolerance = Tolerance::new(0.0, 3.0 * f32::EPSILON);
    findings.near("cos_theta_o", ours, exact, tolerance);
    findings.settled(Certainty::Determined);
    Ok(())
}

/// Of `cos_theta_o` and `cos_theta_e`.
fn cosine_codes(packed: i64) -> [i64; 2] {
    [packed & 0x7fff, packed >> 15 & 0x7fff]
}
