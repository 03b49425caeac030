use super::tables::{ALL_ZERO, RUNNING_SUM, U_ROUNDING, refuses_signs};
use crate::conformance::{Case, Findings, Malformed, Tolerance};
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

    let integral = case.get("integral")?.float()?;
    findings.near("integral", table.integral(), integral, Tolerance::GENERAL);
    for (&ours, theirs) in table.cdf().iter().zip(case.get("cdf")?.floats()?) {
        findings.near("cdf", ours, theirs, RUNNING_SUM);
    }
    for sample in case.get("samples")?.items()? {
        let [u, x, pdf, offset] = sample.float_array()?;
        let tolerance = Tolerance::new(1e-5, 1e-5 * (max - min));
        let ours = table.sample(u);
        if ours.index as f32 == offset && tolerance.accepts(ours.x, x) {
            findings.near("pdf", ours.pdf, pdf, Tolerance::GENERAL);
            continue;
        }
        let low = table.sample(u - U_ROUNDING.ulps);
        let high = table.sample(u + U_ROUNDING.ulps);
        let end = if u + U_ROUNDING.ulps < 1.0 {
            high.x
        } else {
            max
        };
        let enclosing = low.x - tolerance.absolute..=end + tolerance.absolute;
        let bins = low.index as f32..=high.index as f32;
        findings.check(enclosing.contains(&x) && bins.contains(&offset), || {
            format!("sample at {u}: {ours:?}, reference {x} of density {pdf} in bin {offset}")
        });
        findings.exempt(&U_ROUNDING.rule);
    }
    for inverse in case.get("inverts")?.items()? {
        let x = inverse.at(0)?.float()?;
        match (table.invert(x), inverse.at(1)?) {
            (None, theirs) => findings.check(theirs.is_null(), || format!("invert({x}): none")),
            (Some(ours), theirs) => findings.near("invert", ours, theirs.float()?, RUNNING_SUM),
        }
    }
    Ok(())
}
