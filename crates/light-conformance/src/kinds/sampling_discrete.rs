use super::compact_codes::judge;
use crate::oracle::Certainty;
use crate::{Case, Findings, Malformed, Rule, Tolerance};
use lights::math::discrete;

const ON_EDGE: Rule = Rule {
    name: "u_on_the_edge",
    reason: "u lies between two weights up to rounding: ours is a choice in double precision for u \
             moved by 4 ulps",
};

/// The choice, its probability, and what is left of u.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let weights = case.get("weights")?.floats()?;
    let u = f64::from(case.get("u")?.float()?);
    let theirs = case.get("index")?.index()?;
    let pmf = case.get("pmf")?.float()?;
    let ours = findings.ours("pmf", discrete::pmf(&weights, theirs));
    findings.near("pmf", ours, pmf, Tolerance::GENERAL);
    let ours = discrete::sample(&weights, u).ok_or_else(|| Malformed("no weight".to_owned()))?;
    let own = findings.ours("pmf of the sample", ours.pmf);
    findings.equal(
        "pmf of the sample",
        own,
        discrete::pmf(&weights, ours.index),
    );
    findings.settled(Certainty::Determined);

    // Where the sum of all weights before each index begins and ends, as a part of the sum.
    let sum: f64 = weights.iter().map(|&w| f64::from(w)).sum();
    let before = |index: usize| weights[..index].iter().map(|&w| f64::from(w)).sum::<f64>() / sum;
    let index = findings.ours("index", ours.index as i64);
    let step = 4.0 * f64::from(f32::EPSILON);
    let is_exact = usize::try_from(index)
        .is_ok_and(|i| i < weights.len() && before(i) - step <= u && u < before(i + 1) + step);
    let is_same = index == theirs as i64;
    judge("choice", is_same, is_exact, &ON_EDGE, findings);
    let part = f64::from(*weights.get(ours.index).unwrap_or(&0.0)) / sum;
    let rest = (u - before(ours.index)) / part;
    let our_rest = findings.ours("u_remapped", ours.u as f32);
    let tolerance = Tolerance::new(1e-6, 1e-6);
    findings.near(
        "u_remapped",
        our_rest,
        rest.clamp(0.0, 1.0) as f32,
        tolerance,
    );
    findings.settled(Certainty::Determined);
    if ours.index == theirs {
        // The reference rounds to single precision: an ulp of u grows with what it is stretched by.
        let tolerance = Tolerance::new(1e-5, 2.0 * f32::EPSILON / pmf);
        let theirs = case.get("u_remapped")?.float()?;
        findings.near("their u_remapped", ours.u as f32, theirs, tolerance);
    }
    Ok(())
}
