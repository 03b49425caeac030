use crate::conformance::{Case, Findings, Malformed, Rule, Tolerance};
use lights::math::discrete;

const ON_EDGE: Rule = Rule {
    name: "u_on_the_edge",
    reason: "u lies between two weights up to rounding: for u moved by 4 ulps ours is the reference's choice",
};

/// The choice, its probability, and what is left of u.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let weights = case.get("weights")?.floats()?;
    let u = f64::from(case.get("u")?.float()?);
    let theirs = case.get("index")?.index()?;
    let pmf = case.get("pmf")?.float()?;
    findings.near(
        "pmf",
        discrete::pmf(&weights, theirs),
        pmf,
        Tolerance::GENERAL,
    );
    let choose = |u| discrete::sample(&weights, u).ok_or_else(|| Malformed("no weight".to_owned()));
    let ours = choose(u)?;
    findings.equal(
        "pmf of the sample",
        ours.pmf,
        discrete::pmf(&weights, ours.index),
    );
    if ours.index == theirs {
        // An ulp of u grows with what it is stretched by.
        let tolerance = Tolerance::new(1e-5, 2.0 * f32::EPSILON / pmf);
        let rest = case.get("u_remapped")?.float()?;
        findings.near("u_remapped", ours.u as f32, rest, tolerance);
    } else {
        let step = 4.0 * f64::from(f32::EPSILON);
        let beside = [choose(u - step)?.index, choose(u + step)?.index];
        findings.check(beside.contains(&theirs), || {
            format!("index {}, reference {theirs}", ours.index)
        });
        findings.exempt(&ON_EDGE);
    }
    Ok(())
}
