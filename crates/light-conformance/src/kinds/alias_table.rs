use crate::oracle::Certainty;
use crate::oracle::parts::{PARTS, alias_parts, choose};
use crate::{Case, Findings, Malformed, Rule, Tolerance};
use lights::math::distribution::{AliasBin, AliasTable};
use lights::math::fraction;

/// Where the reference's own bins lead.
const BIN_LAYOUT: Rule = Rule {
    name: "bin_layout",
    reason: "which index shares a bin with which is a choice of the builder; the parts that the \
             bins give are compared instead",
};

pub(super) const WHOLE_PARTS: Rule = Rule {
    name: "whole parts",
    reason: "our probabilities are whole parts of 2^16, or of a bin: those that follow from the \
             weights in double precision; the reference's are in exact proportion to them",
};

/// The reference's own probabilities: a sum in single precision and a division.
pub(super) const PROPORTION: Tolerance = Tolerance::new(2.0 * f32::EPSILON, f32::MIN_POSITIVE);

/// Probabilities, the parts that the bins really give, and what samples say of themselves.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let weights = case.get("weights")?.floats()?;
    let table = AliasTable::new(&weights).map_err(|e| Malformed(e.to_string()))?;
    let theirs = case.get("pmf")?.floats()?;
    let exact = alias_parts(&weights);
    for (index, &theirs) in theirs.iter().enumerate() {
        compare_pmf(&weights, &exact, index, table.pmf(index), theirs, findings);
    }

    let mut given = vec![0; weights.len()];
    for (index, bin) in table.bins().iter().enumerate() {
        let [own, others] = parts_of(bin);
        given[index] += own;
        given[bin.alias as usize] += others;
    }
    for (index, &given) in given.iter().enumerate() {
        let ours = findings.ours("parts", given);
        let stated = table.pmf(index);
        findings.check(is_pmf(stated, ours, weights.len()), || {
            format!("{ours} parts of {index}, whose pmf is {stated:?}")
        });
        findings.settled(Certainty::Determined);
    }

    for sample in case.get("samples")?.items()? {
        let u = fraction::from_f64(f64::from(sample.at(0)?.float()?));
        let ours = table.sample(u);
        let own = findings.ours("pmf of a sample", ours.pmf);
        findings.equal("pmf of a sample", own, table.pmf(ours.index));
        findings.check(ours.pmf > 0.0, || format!("{ours:?} has no probability"));
        let index = findings.ours("index", ours.index as i64);
        let exact = choose_by_bins(table.bins(), u);
        findings.equal("index", Some(index), exact.map(|choice| choice.0));
        let rest = findings.ours("u_remapped", fraction::to_f32(ours.u));
        let exact = exact.map(|choice| fraction::to_f32(choice.1));
        findings.equal("u_remapped", Some(rest), exact);
        findings.settled(Certainty::Determined);
        let theirs = case.get("pmf")?.at(sample.at(1)?.index()?)?.float()?;
        findings.equal("pmf of its sample", sample.at(2)?.float()?, theirs);
        findings.exempt(&BIN_LAYOUT);
    }
    Ok(())
}

/// Compares the probability of an index in an alias table with what its `exact` parts, the fewest
/// and the most, make it, and the reference's with that of its weight.
pub(super) fn compare_pmf(
    weights: &[f32],
    exact: &[[i64; 2]],
    index: usize,
    ours: f32,
    theirs: f32,
    findings: &mut Findings,
) {
    let ours = findings.ours("pmf", ours);
    let [fewest, most] = exact[index];
    let is_right = (fewest..=most).any(|parts| is_pmf(ours, parts, weights.len()));
    findings.check(is_right, || {
        format!("pmf of {index}: {ours:?}, exact parts {fewest} to {most}")
    });
    findings.settled(Certainty::Determined);
    compare_proportion(weights, index, theirs, findings);
    if ours != theirs {
        findings.exempt(&WHOLE_PARTS);
    }
}

/// Compares the reference's probability with the weight in double precision.
pub(super) fn compare_proportion(
    weights: &[f32],
    index: usize,
    theirs: f32,
    findings: &mut Findings,
) {
    let sum: f64 = weights.iter().map(|&w| f64::from(w)).sum();
    let exact = (f64::from(weights[index]) / sum) as f32;
    findings.near("their pmf", theirs, exact, PROPORTION);
}

/// Whether `pmf` is that of so many parts of `bins` bins.
fn is_pmf(pmf: f32, parts: i64, bins: usize) -> bool {
    pmf == (parts as f64 / (bins as i64 * PARTS) as f64) as f32
}

/// The parts of a bin that belong to its index, and those that belong to its alias.
fn parts_of(bin: &AliasBin) -> [i64; 2] {
    let own = i64::from(bin.own);
    [own, PARTS - own]
}

/// The index that `u` leads to, and the rest of `u`, by integers of 128 bits.
fn choose_by_bins(bins: &[AliasBin], u: u64) -> Option<(i64, u64)> {
    let scaled = u128::from(u) * bins.len() as u128;
    let index = (scaled >> 64) as usize;
    let bin = bins.get(index)?;
    let (choice, rest) = choose(&parts_of(bin), scaled as u64)?;
    Some(([index as i64, i64::from(bin.alias)][choice], rest))
}
