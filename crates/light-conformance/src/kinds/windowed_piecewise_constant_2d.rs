use super::tables::{CANCELLATION, moved_window, windows};
use crate::comparison::{Comparison, settle_none};
use crate::oracle::Jitter;
use crate::{Case, Findings, Malformed, Rule, Tolerance};
use glam::{DVec2, DVec3};
use lights::math::distribution::{SummedAreaTable, Window, WindowedPiecewiseConstant2D};
use lights::math::glam::Vec2;

const HANG: Rule = Rule {
    name: "hang_or_abort",
    reason: "the reference's bisection does not end there; ours is a search over texels",
};

const PLACE: Tolerance = Tolerance::new(1e-5, 1e-5);

/// How far the sums of a table in whole numbers may move a random number.
const SUMS: f64 = 1e-6;

/// Samples and densities within windows.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let func = case.get("func")?.floats()?;
    let (nx, ny) = (case.get("nx")?.index()?, case.get("ny")?.index()?);
    let sums = SummedAreaTable::new(&func, nx, ny).map_err(|e| Malformed(e.to_string()))?;
    let table = WindowedPiecewiseConstant2D::<Vec<u64>>::new(sums);
    let exact = windows(&func, nx, ny);
    for sample in case.get("samples")?.items()? {
        let (window, u) = (read_window(sample.at(0)?)?, sample.at(1)?.vec2()?);
        let theirs = sample.at(2)?;
        let is_lost = theirs.text() == Some("hang_or_abort");
        if is_lost {
            findings.exempt(&HANG);
        }
        let theirs = match is_lost || theirs.is_null() {
            true => None,
            false => Some(theirs.float_array::<3>()?),
        };
        let truth = |jitter: &mut Jitter| {
            let [low, high] = moved_window(&window, jitter);
            let u = u.as_dvec2();
            let u = DVec2::new(jitter.by(u.x, SUMS), jitter.by(u.y, SUMS));
            let p = exact.sample(u.clamp(DVec2::ZERO, DVec2::ONE), [low, high])?;
            // The point may round into the next texel.
            let near = p.map(|x| jitter.at_scale(x, 1.0)).clamp(low, high);
            let pdf = exact.pdf(near, [low, high]);
            (pdf > 0.0).then(|| vec![p.extend(0.0), DVec3::X * pdf])
        };
        let Some(ours) = findings.ours_if_any("sample", table.sample(u, &window)) else {
            let rule = (theirs.is_some() || is_lost).then_some(&CANCELLATION);
            settle_none(findings, "sample", rule, truth);
            continue;
        };
        let mut comparison = Comparison::default();
        let p = theirs.map(|[x, y, _]| Vec2::new(x, y));
        comparison.vec2("p", findings.ours("p", ours.p), p, PLACE);
        let pdf = theirs.map(|[_, _, pdf]| pdf);
        let our_pdf = findings.ours("pdf of the sample", ours.pdf);
        comparison.number("pdf", our_pdf, pdf, Tolerance::GENERAL);
        comparison.settle(findings, || &CANCELLATION, truth);
    }
    for query in case.get("pdfs")?.items()? {
        let (window, p) = (read_window(query.at(0)?)?, query.at(1)?.vec2()?);
        let ours = findings.ours("pdf", table.pdf(p, &window));
        let mut comparison = Comparison::default();
        let theirs = Some(query.at(2)?.float()?);
        comparison.number("pdf", ours, theirs, Tolerance::GENERAL);
        comparison.settle(
            findings,
            || &CANCELLATION,
            |jitter| {
                let window = moved_window(&window, jitter);
                let p = p.as_dvec2().map(|x| jitter.at_scale(x, 1.0));
                Some(vec![DVec3::X * exact.pdf(p, window)])
            },
        );
    }
    Ok(())
}

fn read_window(extent: Case<'_>) -> Result<Window, Malformed> {
    Ok(Window::new(extent.at(0)?.vec2()?, extent.at(1)?.vec2()?))
}
