use glam::DVec3;
use lights::math::distribution::{SummedAreaTable, Window};

use super::tables::{CANCELLATION, moved_window, windows};
use crate::comparison::Comparison;
use crate::{Case, Findings, Malformed, Tolerance};

/// Integrals over rectangles.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let func = case.get("func")?.floats()?;
    let (nx, ny) = (case.get("nx")?.index()?, case.get("ny")?.index()?);
    let table = SummedAreaTable::new(&func, nx, ny).map_err(|e| Malformed(e.to_string()))?;
    let exact = windows(&func, nx, ny);
    for query in case.get("integrals")?.items()? {
        let (extent, theirs) = (query.at(0)?, query.at(1)?.float()?);
        let window = Window::new(extent.at(0)?.vec2()?, extent.at(1)?.vec2()?);
        let ours = findings.ours("integral", table.integral(&window));
        let mut comparison = Comparison::default();
        comparison.number("integral", ours, Some(theirs), Tolerance::GENERAL);
        comparison.settle(
            findings,
            || &CANCELLATION,
            |jitter| {
                let [low, high] = moved_window(&window, jitter);
                Some(vec![DVec3::X * exact.integral(low, high)])
            },
        );
    }
    Ok(())
}
