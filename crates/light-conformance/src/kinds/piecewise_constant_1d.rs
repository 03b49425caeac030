use super::tables::{
    RUNNING_SUM, U_ROUNDING, check_integral, check_inverse, refuses_signs, unless_zero,
};
use crate::comparison::Comparison;
use crate::oracle::{Certainty, Jitter};
use crate::{Case, Findings, Malformed, Tolerance};
use glam::{DVec2, DVec3};
use lights::math::distribution::PiecewiseConstant1D;

/// Integral, running sum, samples and inverses, on the given domain.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let func = case.get("func")?.floats()?;
    let (min, max) = (case.get("min")?.float()?, case.get("max")?.float()?);
    refuses_signs(&func, |w| PiecewiseConstant1D::new(w).map(|_| ()), findings);
    let weights: Vec<f32> = func.iter().map(|f| f.abs()).collect();
    let table = PiecewiseConstant1D::new(&weights).and_then(|t| t.over(min, max));
    let Some(table) = unless_zero(table, &weights, findings)? else {
        return Ok(());
    };

    check_integral(table.integral(), case, findings)?;
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
        let u = DVec2::new(f64::from(u), 0.5);
        let reach = |i: usize, jitter: &mut Jitter| exact.sample_in(u, [i, 0], jitter);

        // Any bin whose sums rounding may lead to.
        let can_reach = |i: usize| reach(i, &mut Jitter::default()).is_some();
        let index = findings.ours("index", ours.index as i64);
        let is_same = index as f32 == offset;
        let bin = usize::try_from(index).unwrap_or(weights.len());
        let is_exact = bin < weights.len() && can_reach(bin);
        // Of several bins near an edge ours is the one by its own running sums, which are compared
        // above.
        let is_own = table.cdf().get(bin).is_some_and(|&low| low <= u.x as f32)
            && table
                .cdf()
                .get(bin + 1)
                .is_some_and(|&high| (u.x as f32) < high);
        findings.check((is_same || is_exact) && is_own, || {
            format!("index {index}, reference {offset}")
        });
        findings.settled(Certainty::Determined);

        // In our bin, if the reference takes another one. In a bin as narrow as rounding any place
        // is right.
        let theirs = |x: f32| (ours.index as f32 == offset).then_some(x);
        let settle = |comparison: Comparison, part: usize, findings: &mut Findings| {
            comparison.settle(
                findings,
                || &U_ROUNDING,
                |jitter| {
                    let (at, pdf) = reach(ours.index, jitter)?;
                    let parts = [f64::from(min) + at.x * width, pdf / width];
                    Some(vec![DVec3::X * parts[part]])
                },
            );
        };
        let our_x = findings.ours("x", ours.x);
        findings.settled(if exact.is_narrow(ours.index) {
            Certainty::Undetermined
        } else {
            Certainty::Determined
        });
        let mut comparison = Comparison::default();
        let place = Tolerance::new(1e-5, 1e-5 * (max - min));
        comparison.number("x", our_x, theirs(x), place);
        comparison.ill_conditioned();
        settle(comparison, 0, findings);
        let our_pdf = findings.ours("pdf", ours.pdf);
        let mut comparison = Comparison::default();
        comparison.number("pdf", our_pdf, theirs(pdf), Tolerance::GENERAL);
        settle(comparison, 1, findings);
    }
    for inverse in case.get("inverts")?.items()? {
        let x = inverse.at(0)?.float()?;
        let theirs = inverse.at(1)?;
        check_inverse(
            x,
            table.invert(x),
            &theirs,
            Case::float,
            Findings::near,
            findings,
        )?;
    }
    Ok(())
}
