use super::tables::{CANCELLATION, cancellation};
use crate::conformance::{Case, Findings, Malformed, Rule, Tolerance};
use lights::math::distribution::{Sample2D, SummedAreaTable, Window, WindowedPiecewiseConstant2D};
use lights::math::glam::Vec2;

const HANG: Rule = Rule {
    name: "hang_or_abort",
    reason: "the reference's bisection does not end there; ours is a search over texels",
};

const BEYOND: Rule = Rule {
    name: "column_beyond_the_square",
    reason: "u is so near 1 that the reference's bisection ends at x = 1, in a column that holds nothing",
};

const ON_EDGE: Rule = Rule {
    name: "texel_edge",
    reason: "the reference's point lies on the edge of a texel up to rounding: the density beside it is the reference",
};

type Table = WindowedPiecewiseConstant2D<Vec<u64>>;

/// Samples and densities within windows.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let func = case.get("func")?.floats()?;
    let (nx, ny) = (case.get("nx")?.index()?, case.get("ny")?.index()?);
    let sums = SummedAreaTable::new(&func, nx, ny).map_err(|e| Malformed(e.to_string()))?;
    let table = Table::new(sums);
    for sample in case.get("samples")?.items()? {
        let (window, u) = (read_window(sample.at(0)?)?, sample.at(1)?.vec2()?);
        let ours = table.sample(u, &window);
        if let Some(ours) = ours {
            let agrees = ours.pdf == table.pdf(ours.p, &window) && ours.pdf > 0.0;
            findings.check(agrees, || format!("density of {ours:?} in {window:?}"));
        }
        let theirs = sample.at(2)?;
        if theirs.text() == Some("hang_or_abort") {
            findings.exempt(&HANG);
        } else if theirs.is_null() {
            compare_with_none(&table, ours, u, &window, findings);
        } else {
            compare(&table, ours, theirs.float_array()?, u, &window, findings);
        }
    }
    for query in case.get("pdfs")?.items()? {
        let (window, p) = (read_window(query.at(0)?)?, query.at(1)?.vec2()?);
        compare_density(&table, p, query.at(2)?.float()?, &window, findings);
    }
    Ok(())
}

/// The reference found nothing in the window, or in the column that it reached.
fn compare_with_none(
    table: &Table,
    ours: Option<Sample2D>,
    u: Vec2,
    window: &Window,
    findings: &mut Findings,
) {
    let Some(ours) = ours else {
        findings.equal("nothing in the window", ours, None);
        return;
    };
    let columns = enclosure(table, u, 0, window);
    if columns[1] == 1.0 && ours.p.x > 1.0 - 4.0 * f32::EPSILON {
        findings.exempt(&BEYOND);
        return;
    }
    let is_empty = |x: f32| noise(table, &column(table, x, window)) >= 1.0;
    let is_lost = noise(table, window) >= 1.0 || columns.into_iter().any(is_empty);
    findings.check(is_lost, || {
        format!("sample in {window:?}: {ours:?}, reference none")
    });
    findings.exempt(&CANCELLATION);
}

/// The reference found a point.
fn compare(
    table: &Table,
    ours: Option<Sample2D>,
    [x, y, pdf]: [f32; 3],
    u: Vec2,
    window: &Window,
    findings: &mut Findings,
) {
    const NEAR: f32 = 1e-5;
    let theirs = Vec2::new(x, y);
    compare_density(table, theirs, pdf, window, findings);
    if ours.is_some_and(|ours| ours.p.abs_diff_eq(theirs, NEAR)) {
        findings.check(true, String::new);
        return;
    }
    // First the place in x, then the one in the reference's column.
    let [left, right] = enclosure(table, u, 0, window);
    let [low, high] = enclosure(table, u, 1, &column(table, x, window));
    let is_enclosed =
        (left - NEAR..=right + NEAR).contains(&x) && (low - NEAR..=high + NEAR).contains(&y);
    findings.check(is_enclosed, || {
        format!("sample in {window:?} at {u}: {ours:?}, reference {theirs} of {left}..{right}, {low}..{high}")
    });
    findings.exempt(&CANCELLATION);
}

/// Between which coordinates on `axis` the reference's answer may lie: those of our samples for u moved by the noise
/// of its sums, and the window's own beyond both ends of u.
fn enclosure(table: &Table, u: Vec2, axis: usize, window: &Window) -> [f32; 2] {
    let noise = noise(table, window);
    [
        (u[axis] - noise, window.min[axis]),
        (u[axis] + noise, window.max[axis]),
    ]
    .map(|(moved, end)| {
        let mut u = u;
        u[axis] = moved;
        let is_inside = (0.0..1.0).contains(&moved) && moved != 0.0;
        let sample = table.sample(u, window).filter(|_| is_inside);
        sample.map_or(end, |sample| sample.p[axis])
    })
}

/// Densities are inverse to the window's integral, so its relative error is theirs.
fn compare_density(table: &Table, p: Vec2, theirs: f32, window: &Window, findings: &mut Findings) {
    let ours = table.pdf(p, window);
    if Tolerance::GENERAL.accepts(ours, theirs) {
        findings.near("pdf", ours, theirs, Tolerance::GENERAL);
        return;
    }
    let noise = noise(table, window);
    let loose = Tolerance::new(1e-5 + noise, 0.0);
    if noise >= 1.0 || loose.accepts(ours, theirs) {
        findings.exempt(&CANCELLATION);
        return;
    }
    let beside = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)];
    let is_edge = beside.iter().any(|&(dx, dy)| {
        let q = (p + Vec2::new(dx, dy) * 4.0 * f32::EPSILON).clamp(window.min, window.max);
        loose.accepts(table.pdf(q, window), theirs)
    });
    findings.check(is_edge, || {
        format!("pdf at {p} in {window:?}: {ours}, reference {theirs}")
    });
    findings.exempt(&ON_EDGE);
}

/// The relative error of the reference's integral over `window`, infinite where the integral is 0.
fn noise(table: &Table, window: &Window) -> f32 {
    cancellation(table.table(), window.max) / table.table().integral(window)
}

/// The texel column of `window` that holds `x`.
fn column(table: &Table, x: f32, window: &Window) -> Window {
    let texels = table.table().resolution()[0] as f32;
    let index = (x * texels).floor().min(texels - 1.0);
    let (left, right) = (index / texels, (index + 1.0) / texels);
    Window::new(
        Vec2::new(left, window.min.y),
        Vec2::new(right, window.max.y),
    )
}

fn read_window(extent: Case<'_>) -> Result<Window, Malformed> {
    Ok(Window::new(extent.at(0)?.vec2()?, extent.at(1)?.vec2()?))
}
