use super::tables::{CANCELLATION, cancellation};
use crate::conformance::{Case, Findings, Malformed, Tolerance};
use lights::math::distribution::{SummedAreaTable, Window};

/// Integrals over rectangles.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let func = case.get("func")?.floats()?;
    let (nx, ny) = (case.get("nx")?.index()?, case.get("ny")?.index()?);
    let table = SummedAreaTable::new(&func, nx, ny).map_err(|e| Malformed(e.to_string()))?;
    for query in case.get("integrals")?.items()? {
        let (extent, theirs) = (query.at(0)?, query.at(1)?.float()?);
        let window = Window::new(extent.at(0)?.vec2()?, extent.at(1)?.vec2()?);
        let ours = table.integral(&window);
        let rounding = Tolerance::new(1e-5, cancellation(&table, window.max));
        if !Tolerance::GENERAL.accepts(ours, theirs) && rounding.accepts(ours, theirs) {
            findings.exempt(&CANCELLATION);
        } else {
            findings.near(
                &format!("integral over {window:?}"),
                ours,
                theirs,
                Tolerance::GENERAL,
            );
        }
    }
    Ok(())
}
