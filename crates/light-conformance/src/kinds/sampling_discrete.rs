use super::alias_table::{WHOLE_PARTS, compare_proportion};
use crate::oracle::Certainty;
use crate::oracle::parts::{PARTS, choose, parts};
use crate::{Case, Findings, Malformed, Tolerance};
use lights::math::{discrete, fraction};

/// The parts of all weights, and by them in integers the choice and what is left of u.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let weights = case.get("weights")?.floats()?;
    let u = case.get("u")?.float()?;
    let theirs = case.get("index")?.index()?;
    let their_pmf = case.get("pmf")?.float()?;

    let exactly: Vec<_> = weights.iter().map(|&w| [f64::from(w); 2]).collect();
    let pmfs: Vec<_> = (0..weights.len())
        .map(|index| discrete::pmf(&weights, index))
        .collect();
    for (index, [fewest, most]) in parts(&exactly, 1).into_iter().enumerate() {
        let ours = findings.ours("pmf", pmfs[index]);
        let is_right = (fewest..=most).any(|parts| ours == (parts as f64 / PARTS as f64) as f32);
        findings.check(is_right, || {
            format!("pmf of {index}: {ours:?}, exact parts {fewest} to {most}")
        });
        // The first weight, if it has one part, doubles with what rounding leaves over.
        findings.settled(if most < 2 * fewest || most == 0 {
            Certainty::Determined
        } else {
            Certainty::Undetermined
        });
    }
    let own: Vec<_> = pmfs.iter().map(|pmf| (pmf * PARTS as f32) as i64).collect();
    findings.equal("sum of all parts", own.iter().sum(), PARTS);
    compare_proportion(&weights, theirs, their_pmf, findings);

    let fraction = fraction::from_f64(f64::from(u));
    let ours = discrete::sample(&weights, fraction);
    let ours = ours.ok_or_else(|| Malformed("no weight".to_owned()))?;
    let (index, rest) = choose(&own, fraction).ok_or_else(|| Malformed("no weight".to_owned()))?;
    let pmf = findings.ours("pmf of the sample", ours.pmf);
    findings.equal("pmf of the sample", pmf, pmfs[index]);
    let choice = findings.ours("index", ours.index as i64);
    findings.equal("choice", choice, index as i64);
    let our_rest = findings.ours("u_remapped", fraction::to_f32(ours.u));
    findings.equal("u_remapped", our_rest, fraction::to_f32(rest));
    findings.settled(Certainty::Determined);

    check_theirs(&weights, f64::from(u), theirs, case, findings)?;
    if index != theirs || pmfs[index] != their_pmf {
        findings.exempt(&WHOLE_PARTS);
    }
    Ok(())
}

/// The reference's choice, for u moved by 4 ulps, and what it leaves of u, in double precision.
fn check_theirs(
    weights: &[f32],
    u: f64,
    theirs: usize,
    case: &Case<'_>,
    findings: &mut Findings,
) -> Result<(), Malformed> {
    // Where the sum of all weights before each index begins and ends, as a part of the sum.
    let sum: f64 = weights.iter().map(|&w| f64::from(w)).sum();
    let before = |index: usize| weights[..index].iter().map(|&w| f64::from(w)).sum::<f64>() / sum;
    let step = 4.0 * f64::from(f32::EPSILON);
    let [start, end] = [before(theirs), before(theirs + 1)];
    findings.check(start - step <= u && u < end + step, || {
        format!("their choice {theirs} is from {start} to {end}")
    });
    let part = end - start;
    let exact = ((u - start) / part).clamp(0.0, 1.0) as f32;
    // It rounds to single precision: an ulp of u grows with what it is stretched by.
    let tolerance = Tolerance::new(1e-5, (2.0 * f64::from(f32::EPSILON) / part) as f32);
    let rest = case.get("u_remapped")?.float()?;
    findings.near("their u_remapped", rest, exact, tolerance);
    Ok(())
}
