use light_math::discrete;
use light_math::distribution::{
    AliasTable, PiecewiseConstant1D, PiecewiseConstant2D, SummedAreaTable, Window,
    WindowedPiecewiseConstant2D,
};
use light_math::glam::Vec2;

use super::input::Input;

/// Cells that one input may hold.
const MAX_CELLS: usize = 64;

/// Tables refuse weights that are invalid, and never return a cell or a point without density.
pub(super) fn distributions(data: &[u8]) {
    let mut input = Input::new(data);
    let us = [
        input.unit(),
        input.unit(),
        input.unit(),
        0.0,
        light_math::float::ONE_MINUS_EPSILON,
    ];
    let width = usize::from(input.byte() % 8 + 1);
    let corners = [input.unit(), input.unit(), input.unit(), input.unit()];
    let mut weights = Vec::new();
    while !input.is_empty() && weights.len() < MAX_CELLS {
        weights.push(input.f32());
    }
    check_discrete(&weights, &us);
    check_1d(&weights, &us);
    let height = weights.len() / width;
    check_2d(&weights[..width * height], [width, height], &us, corners);
}

fn check_discrete(weights: &[f32], us: &[f32]) {
    let valid: Vec<f32> = weights
        .iter()
        .map(|w| if *w >= 0.0 && w.is_finite() { *w } else { 0.0 })
        .collect();
    for &u in us {
        if let Some(chosen) = discrete::sample(&valid, f64::from(u)) {
            let asked = discrete::pmf(&valid, chosen.index);
            assert_eq!(
                chosen.pmf.to_bits(),
                asked.to_bits(),
                "{chosen:?} of {valid:?}"
            );
            assert!(
                valid[chosen.index] > 0.0,
                "{chosen:?} of {valid:?} has no weight"
            );
        }
    }
    if let Ok(table) = AliasTable::new(weights) {
        for &u in us {
            let chosen = table.sample(f64::from(u));
            let asked = table.pmf(chosen.index);
            assert_eq!(
                chosen.pmf.to_bits(),
                asked.to_bits(),
                "{chosen:?} of {weights:?}"
            );
            assert!(
                chosen.pmf > 0.0 && (0.0..1.0).contains(&chosen.u),
                "{chosen:?} of {weights:?}"
            );
        }
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
