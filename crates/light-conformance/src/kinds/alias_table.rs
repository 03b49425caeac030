use crate::{Case, Findings, Malformed, Rule, Tolerance};
use lights::math::distribution::AliasTable;

/// Where the reference's own bins lead.
const BIN_LAYOUT: Rule = Rule {
    name: "bin_layout",
    reason: "which index shares a bin with which is a choice of the builder; the frequencies that \
             the bins give are compared instead",
};

/// Probabilities, the frequencies that the bins really give, and what samples say of themselves.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let weights = case.get("weights")?.floats()?;
    let table = AliasTable::new(&weights).map_err(|e| Malformed(e.to_string()))?;
    let pmf = case.get("pmf")?.floats()?;
    for (index, &theirs) in pmf.iter().enumerate() {
        let ours = findings.ours("pmf", table.pmf(index));
        findings.near("pmf", ours, theirs, Tolerance::GENERAL);
    }

    let mut frequencies = vec![0.0; weights.len()];
    for (index, bin) in table.bins().iter().enumerate() {
        frequencies[index] += bin.q / weights.len() as f32;
        frequencies[bin.alias as usize] += (1.0 - bin.q) / weights.len() as f32;
    }
    for (&ours, &theirs) in frequencies.iter().zip(&pmf) {
        let ours = findings.ours("frequency", ours);
        findings.near("frequency", ours, theirs, Tolerance::GENERAL);
    }

    for sample in case.get("samples")?.items()? {
        let ours = table.sample(f64::from(sample.at(0)?.float()?));
        let own = findings.ours("pmf of a sample", ours.pmf);
        findings.equal("pmf of a sample", own, table.pmf(ours.index));
        findings.check(ours.pmf > 0.0, || format!("{ours:?} has no probability"));
        let theirs = sample.at(1)?.index()?;
        findings.near(
            "pmf of its sample",
            table.pmf(theirs),
            sample.at(2)?.float()?,
            Tolerance::GENERAL,
        );
        findings.exempt(&BIN_LAYOUT);
    }
    Ok(())
}
