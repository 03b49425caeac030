use light_math::distribution::{
    AliasTable, PiecewiseConstant1D, PiecewiseConstant2D, SummedAreaTable, Window,
    WindowedPiecewiseConstant2D,
};
use light_math::glam::Vec2;
use light_math::{discrete, fraction};

use super::input::Input;

/// Cells that one input may hold.
const MAX_CELLS: usize = 64;

/// Tables refuse weights that are invalid, and never return a cell or a point without density.
pub(super) fn distributions(data: &[u8]) {
    let mut input = Input::new(data);
    let us = [
        input.fraction(),
        input.fraction(),
        input.fraction(),
        0,
        u64::MAX,
    ];
    let width = usize::from(input.byte() % 8 + 1);
    let corners = [input.unit(), input.unit(), input.unit(), input.unit()];
    let mut weights = Vec::new();
    while !input.is_empty() && weights.len() < MAX_CELLS {
        weights.push(input.f32());
    }
    check_discrete(&weights, &us);
    check_alias_table(&weights, &us);
    let us = us.map(fraction::to_f32);
    check_1d(&weights, &us);
    let height = weights.len() / width;
    check_2d(&weights[..width * height], [width, height], &us, corners);
}

/// So few weights are shared out by one choice: each owns as many parts of 2^16 as its probability
/// says, in their order, and what is left of `u` is its place among them, rounded down.
fn check_discrete(weights: &[f32], us: &[u64]) {
    let pmfs: Vec<f32> = (0..weights.len())
        .map(|i| discrete::pmf(weights, i))
        .collect();
    let parts: Vec<u128> = pmfs
        .iter()
        .map(|&pmf| (pmf * discrete::PARTS as f32) as u128)
        .collect();
    for (&weight, &pmf) in weights.iter().zip(&pmfs) {
        assert_eq!(pmf > 0.0, weight > 0.0, "{pmf} for {weight} of {weights:?}");
    }
    let is_some = weights.iter().any(|&w| w > 0.0);
    let sum: f64 = pmfs.iter().map(|&pmf| f64::from(pmf)).sum();
    let all = f64::from(u8::from(is_some));
    assert_eq!(sum, all, "pmfs of {weights:?}: {pmfs:?}");
    for &u in us {
        let chosen = discrete::sample(weights, u);
        assert_eq!(chosen.is_some(), is_some, "{u} of {weights:?}");
        let Some(chosen) = chosen else { continue };
        let own = parts[chosen.index];
        let start = parts[..chosen.index].iter().sum::<u128>() << 48;
        let place = u128::from(u).checked_sub(start).map(|place| place << 16);
        let rest = u128::from(chosen.u);
        assert!(
            place.is_some_and(|place| (rest * own..(rest + 1) * own).contains(&place))
                && chosen.pmf.to_bits() == pmfs[chosen.index].to_bits(),
            "{chosen:?} for {u} of {weights:?}, which have {pmfs:?}"
        );
    }
}

/// The parts of the bins that lead to an index are its probability.
fn check_alias_table(weights: &[f32], us: &[u64]) {
    let Ok(table) = AliasTable::new(weights) else {
        return;
    };
    let mut parts = vec![0; weights.len()];
    for (index, bin) in table.bins().iter().enumerate() {
        parts[index] += bin.own;
        parts[bin.alias as usize] += discrete::PARTS - bin.own;
    }
    let all = weights.len() as f64 * f64::from(discrete::PARTS);
    for (index, (&parts, &weight)) in parts.iter().zip(weights).enumerate() {
        let pmf = table.pmf(index);
        assert!(
            pmf == (f64::from(parts) / all) as f32 && (parts > 0) == (weight > 0.0),
            "{pmf} for {parts} parts of {index} of {weights:?}"
        );
    }
    for &u in us {
        let chosen = table.sample(u);
        let asked = table.pmf(chosen.index);
        assert!(
            chosen.pmf.to_bits() == asked.to_bits() && chosen.pmf > 0.0,
            "{chosen:?} for {u}, asked {asked}, of {weights:?}"
        );
    }
}

fn check_1d(weights: &[f32], us: &[f32]) {
    let Ok(table) = PiecewiseConstant1D::new(weights) else {
        return;
    };
    for &u in us {
        let sample = table.sample(u);
        let asked = table.pdf(sample.x);
        assert!(
            sample.pdf > 0.0 && (0.0..=1.0).contains(&sample.x) && weights[sample.index] > 0.0,
            "{sample:?} for u = {u} of {weights:?}"
        );
        assert!(asked > 0.0, "density {asked} at {sample:?} of {weights:?}");
    }
}

fn check_2d(weights: &[f32], [nx, ny]: [usize; 2], us: &[f32], corners: [f32; 4]) {
    let points = us
        .iter()
        .flat_map(|&x| us.iter().map(move |&y| Vec2::new(x, y)));
    if let Ok(table) = PiecewiseConstant2D::new(weights, nx, ny) {
        for u in points.clone() {
            let sample = table.sample(u);
            let [x, y] = sample.texel;
            let asked = table.pdf(sample.p);
            assert!(
                sample.pdf > 0.0 && asked > 0.0 && weights[y * nx + x] > 0.0,
                "{sample:?} with density {asked} for {u} of {nx} x {ny} {weights:?}"
            );
        }
    }
    if let Ok(table) = SummedAreaTable::new(weights, nx, ny) {
        let [ax, ay, bx, by] = corners;
        let window = Window::new(
            Vec2::new(ax, ay).min(Vec2::new(bx, by)),
            Vec2::new(ax, ay).max(Vec2::new(bx, by)),
        );
        let windowed = WindowedPiecewiseConstant2D::new(table);
        for u in points {
            let Some(sample) = windowed.sample(u, &window) else {
                continue;
            };
            let asked = windowed.pdf(sample.p, &window);
            assert!(
                sample.pdf > 0.0 && asked > 0.0 && window.contains(sample.p),
                "{sample:?} with density {asked} for {u} in {window:?} of {nx} x {ny} {weights:?}"
            );
        }
    }
}
