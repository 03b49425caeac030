use super::tables::{ALL_ZERO, RUNNING_SUM, U_ROUNDING, refuses_signs};
use crate::conformance::{Case, Findings, Malformed, Rule, Tolerance};
use lights::math::distribution::{PiecewiseConstant2D, TableError};
use lights::math::glam::Vec2;

/// A point on the edge of a texel.
const ON_EDGE: Rule = Rule {
    name: "on_edge",
    reason: "the point lies on the edge of a texel up to rounding: the density beside it is the reference",
};

/// Integral, samples, densities and inverses, on the given domain.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let func = case.get("func")?.floats()?;
    let (nx, ny) = (case.get("nx")?.index()?, case.get("ny")?.index()?);
    let domain = case.get("domain")?;
    let (min, max) = (domain.at(0)?.vec2()?, domain.at(1)?.vec2()?);
    refuses_signs(
        &func,
        |w| PiecewiseConstant2D::new(w, nx, ny).map(|_| ()),
        findings,
    );
    let weights: Vec<f32> = func.iter().map(|f| f.abs()).collect();
    let table = match PiecewiseConstant2D::new(&weights, nx, ny).and_then(|t| t.over(min, max)) {
        Ok(table) => table,
        Err(TableError::AllZero) if weights.iter().all(|&w| w == 0.0) => {
            findings.exempt(&ALL_ZERO);
            return Ok(());
        }
        Err(error) => return Err(Malformed(error.to_string())),
    };

    let integral = case.get("integral")?.float()?;
    findings.near("integral", table.integral(), integral, Tolerance::GENERAL);
    let absolute = 1e-5 * (max - min).max_element();
    let place = Tolerance::new(1e-5, absolute);
    for sample in case.get("samples")?.items()? {
        let [u0, u1, x, y, pdf, ix, iy] = sample.float_array()?;
        let (u, p) = (Vec2::new(u0, u1), Vec2::new(x, y));
        let ours = table.sample(u);
        let near = place.accepts(ours.p.x, x) && place.accepts(ours.p.y, y);
        if ours.texel.map(|i| i as f32) == [ix, iy] && near {
            findings.near("pdf", ours.pdf, pdf, Tolerance::GENERAL);
            continue;
        }
        let is_enclosed = is_enclosed(&table, u, [x, y, ix, iy], absolute, max);
        findings.check(is_enclosed, || {
            format!("sample at {u}: {ours:?}, reference {p} of density {pdf} in [{ix}, {iy}]")
        });
        findings.exempt(&U_ROUNDING.rule);
    }
    for query in case.get("pdfs")?.items()? {
        let [x, y, pdf] = query.float_array()?;
        let p = Vec2::new(x, y);
        if Tolerance::GENERAL.accepts(table.pdf(p), pdf) {
            findings.near("pdf", table.pdf(p), pdf, Tolerance::GENERAL);
            continue;
        }
        let step = (max - min).max(p.abs()) * 4.0 * f32::EPSILON;
        let beside = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)];
        let agrees = beside.iter().any(|&(sx, sy)| {
            let density = table.pdf(p + step * Vec2::new(sx, sy));
            Tolerance::GENERAL.accepts(density, pdf)
        });
        findings.check(agrees, || {
            format!("pdf at {p}: {}, reference {pdf}", table.pdf(p))
        });
        findings.exempt(&ON_EDGE);
    }
    for inverse in case.get("inverts")?.items()? {
        let p = inverse.at(0)?.vec2()?;
        match (table.invert(p), inverse.at(1)?) {
            (None, theirs) => findings.check(theirs.is_null(), || format!("invert({p}): none")),
            (Some(ours), theirs) => findings.near2("invert", ours, theirs.vec2()?, RUNNING_SUM),
        }
    }
    Ok(())
}

/// Whether samples for u moved by some ulps enclose the reference: its row among theirs, its column in one of these.
fn is_enclosed(
    table: &PiecewiseConstant2D<Vec<f32>>,
    u: Vec2,
    [x, y, ix, iy]: [f32; 4],
    absolute: f32,
    max: Vec2,
) -> bool {
    let ulps = U_ROUNDING.ulps;
    // No u lies beyond the last one, whose bin reaches to the end of the domain.
    let end = |u: f32, high: f32, max: f32| if u + ulps < 1.0 { high } else { max };
    let at = |dx: f32, dy: f32| table.sample(u + Vec2::new(dx, dy) * ulps);
    let rows = [-1.0, 1.0].map(|dy| (at(-1.0, dy), at(1.0, dy)));
    let is_row_enclosed = rows.iter().any(|row| row.0.texel[1] as f32 == iy)
        && (rows[0].0.p.y - absolute..=end(u.y, rows[1].0.p.y, max.y) + absolute).contains(&y);
    let is_column_enclosed = rows.iter().any(|(low, high)| {
        (low.texel[0] as f32..=high.texel[0] as f32).contains(&ix)
            && (low.p.x - absolute..=end(u.x, high.p.x, max.x) + absolute).contains(&x)
    });
    is_row_enclosed && is_column_enclosed
}
