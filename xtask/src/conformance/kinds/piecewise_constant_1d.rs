use super::tables::{ALL_ZERO, RUNNING_SUM, U_ROUNDING, refuses_signs};
use crate::conformance::comparison::Comparison;
use crate::conformance::oracle::Certainty;
use crate::conformance::{Case, Findings, Malformed, Tolerance};
use glam::{DVec2, DVec3};
use lights::math::distribution::{PiecewiseConstant1D, TableError};

/// Integral, running sum, samples and inverses, on the given domain.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let func = case.get("func")?.floats()?;
    let (min, max) = (case.get("min")?.float()?, case.get("max")?.float()?);
    refuses_signs(&func, |w| PiecewiseConstant1D::new(w).map(|_| ()), findings);
    let weights: Vec<f32> = func.iter().map(|f| f.abs()).collect();
    let table = match PiecewiseConstant1D::new(&weights).and_then(|t| t.over(min, max)) {
        Ok(table) => table,
        Err(TableError::AllZero) if weights.iter().all(|&w| w == 0.0) => {
            findings.exempt(&ALL_ZERO);
            return Ok(());
        }
        Err(error) => return Err(Malformed(error.to_string())),
    };

    let integral = findings.ours("integral", table.integral());
    let theirs = case.get("integral")?.float()?;
    findings.near("integral", integral, theirs, Tolerance::GENERAL);
    findings.settled(Certainty::Determined);
    for (&ours, theirs) in table.cdf().iter().zip(case.get("cdf")?.floats()?) {
        let ours = findings.ours("cdf", ours);
        findings.near("cdf", ours, theirs, RUNNING_SUM);
        findings.settled(Certainty::Determined);
    }
    let exact = super::tables::table(&weights, weights.len(), 1);
    let width = f64::from(max) - f64::from(min);
    for sample in case.get("samples")?.items()? {
        let [u, x, pdf, offset] = sample.float_array()?;
        let ours = table.sample(u);
        let mut comparison = Comparison::default();
        let our_x = findings.ours("x", ours.x);
        let place = Tolerance::new(1e-5, 1e-5 * (max - min));
        comparison.number("x", our_x, Some(x), place);
        comparison.ill_conditioned();
        let our_pdf = findings.ours("pdf", ours.pdf);
        comparison.number("pdf", our_pdf, Some(pdf), Tolerance::GENERAL);
        let index = findings.ours("index", ours.index as i64) as f32;
        comparison.number("index", index, Some(offset), Tolerance::new(0.0, 0.0));
        comparison.settle(
            findings,
            || &U_ROUNDING,
            |jitter| {
                // Any bin whose sums rounding may lead to; ours is one of them.
                let u = DVec2::new(f64::from(u), 0.5);
                let (at, pdf) = exact.sample_in(u, [ours.index, 0], jitter)?;
                let parts = [
                    f64::from(min) + at.x * width,
                    pdf / width,
                    ours.index as f64,
                ];
                Some(parts.map(|x| DVec3::X * x).to_vec())
            },
        );
    }
    for inverse in case.get("inverts")?.items()? {
        let x = inverse.at(0)?.float()?;
        match (
            findings.ours_if_any("inverse", table.invert(x)),
            inverse.at(1)?,
        ) {
            (None, theirs) => findings.check(theirs.is_null(), || format!("invert({x}): none")),
            (Some(ours), theirs) => {
                let ours = findings.ours("inverse u", ours);
                findings.near("invert", ours, theirs.float()?, RUNNING_SUM);
            }
        }
        findings.settled(Certainty::Determined);
    }
    Ok(())
}
