use lights::samplers::BvhLightSampler;
use rayon::prelude::*;

use super::ChoiceEstimates;
use super::cell_noise::{CellNoise, gain};
use super::census::{self, Sighting};
use super::choice_plan::ChoicePlan;
use super::fill::{Cell, FEWEST_OF_COARSE, Filled, fill_cell, rays_of_cell};
use super::film_point::FilmPoint;
use crate::{View, World};

/// The samples a pixel that a picture is taken to have. Not those of the picture: parts of it do
/// not know how many it will have in the end.
const SAMPLES: f64 = 64.0;

/// Cells that are filled to see what cells gain, at most.
const PROBES: usize = 12;

/// One of so many cells is filled to see that: it takes a few hundredths of a picture's time.
const CELLS_PER_PROBE: usize = 10;

/// The cost of a ray of filling, in samples from the root at one vertex: by the thread seconds of
/// pictures.
const RAY_COST: f64 = 0.35;

/// The cost of a sample in a cell, in samples from the root.
const SAMPLE_COST: f64 = 1.05;

/// Cells must be expected to divide error times seconds by at least so much.
const LEAST_GAIN: f64 = 1.4;

/// Where more of the light arrives, few cells have factors.
const LARGEST_VISIBLE_SHARE: f64 = 0.97;

/// Where less of the noise is of first vertices, cells hardly pay: there are none for later
/// vertices, and few samples find too little of the rare bright light that comes by them.
const LEAST_FIRST_SHARE: f64 = 0.9;

/// Whether cells may pay at all.
pub(super) fn may_pay(estimates: &ChoiceEstimates) -> bool {
    estimates.first_share(estimates.best()) > LEAST_FIRST_SHARE
        && estimates.visible_share() < LARGEST_VISIBLE_SHARE
}

/// Those cells that are estimated to pay for their rays; none where all of them together do not.
///
/// A few light samples in each cell tell how noisy its pixels will be by the plan of `estimates`. A
/// dozen cells, spread evenly over that noise, are filled, and light samples there tell what part
/// of the noise cells leave. Then cells are taken in the order of noise for each ray that they
/// need, as long as the expected error times seconds falls.
pub(super) fn fill_paying(
    world: &World,
    view: &View,
    lights: &BvhLightSampler,
    cells: &[&[Sighting]],
    estimates: &ChoiceEstimates,
) -> Filled {
    let plan = estimates.best();
    let pixels = pixels_of(cells);
    let cells: Vec<&[Sighting]> = (cells.iter().copied())
        .filter(|cell| census::quarters(cell) >= FilmPoint::QUARTERS * FEWEST_OF_COARSE)
        .collect();
    let cells = &cells[..];
    let noise = PictureNoise::of(world, view, lights, cells, plan);
    let probes = noise.probes();
    let filled: Vec<(Option<Cell>, Option<f64>)> = probes
        .par_iter()
        .map(|&i| {
            let filled = fill_cell(world, view, lights, cells[i]);
            let left = match &filled {
                Some(filled) => gain(world, view, lights, cells[i], filled, plan),
                None => Some(1.0),
            };
            (filled, left)
        })
        .collect();
    let (count, sum) = (filled.iter().filter_map(|(_, left)| *left))
        .fold((0.0, 0.0), |(count, sum), left| (count + 1.0, sum + left));
    if count == 0.0 {
        return Filled::default();
    }
    let left = noise.left_of_all(sum / count);
    let chosen = noise.paying(left, cells, pixels, estimates);
    if chosen.is_empty() {
        return Filled::default();
    }
    let mut filled: Vec<Option<Option<Cell>>> =
        probes
            .into_iter()
            .zip(filled)
            .fold(vec![None; cells.len()], |mut all, (i, (cell, _))| {
                all[i] = Some(cell);
                all
            });
    let rest: Vec<(usize, Option<Cell>)> = chosen
        .into_par_iter()
        .filter(|&i| filled[i].is_none())
        .map(|i| (i, fill_cell(world, view, lights, cells[i])))
        .collect();
    for (i, cell) in rest {
        filled[i] = Some(cell);
    }
    Filled::from_cells(cells.iter().zip(filled.into_iter().map(Option::flatten)))
}

/// How many pixels show one of these cells.
fn pixels_of(cells: &[&[Sighting]]) -> f64 {
    cells.iter().map(|cell| pixels_of_cell(cell)).sum()
}

/// How many pixels show this cell.
fn pixels_of_cell(cell: &[Sighting]) -> f64 {
    f64::from(census::pixels(cell))
}

/// The noise of a picture by one sample a pixel, before any cell is filled.
struct PictureNoise {
    /// Of each cell, summed over its pixels, relative to their light.
    cells: Vec<f64>,
    all: f64,
    /// What no choice of lights removes: the differences within pixels.
    within: f64,
}

impl PictureNoise {
    fn of(
        world: &World,
        view: &View,
        lights: &BvhLightSampler,
        cells: &[&[Sighting]],
        plan: ChoicePlan,
    ) -> Self {
        let noises: Vec<CellNoise> = cells
            .par_iter()
            .map(|cell| CellNoise::of(world, view, lights, cell))
            .collect();
        // One after the other: the sums do not depend on the threads.
        let all = || cells.iter().map(|cell| pixels_of_cell(cell)).zip(&noises);
        let light: f64 = all().map(|(pixels, noise)| pixels * noise.mean).sum();
        let floor = 0.1 * light / pixels_of(cells);
        let relative = |pixels: f64, noise: &CellNoise, variance: f64| {
            let scale = noise.mean * noise.mean + floor * floor;
            if scale > 0.0 {
                pixels * variance / scale
            } else {
                0.0
            }
        };
        let within = all().map(|(pixels, noise)| relative(pixels, noise, noise.within));
        let within = within.sum::<f64>().max(0.0);
        let cells = all().map(|(pixels, noise)| {
            let variance = noise.variances[plan as usize].max(0.0);
            relative(pixels, noise, variance)
        });
        let cells: Vec<f64> = cells.collect();
        let sum = cells.iter().sum::<f64>();
        Self {
            all: sum,
            within,
            cells,
        }
    }

    /// Cells at even steps of the noise, in their order.
    fn probes(&self) -> Vec<usize> {
        let probes = self.cells.len().div_ceil(CELLS_PER_PROBE).min(PROBES);
        let step = self.all / probes as f64;
        let (mut sum, mut probes) = (0.0, Vec::new());
        for (i, noise) in self.cells.iter().enumerate() {
            let before = (sum / step).round();
            sum += noise;
            if (sum / step).round() > before {
                probes.push(i);
            }
        }
        probes
    }

    /// What is left of all noise where cells leave the share `left` of that of choices.
    fn left_of_all(&self, left: f64) -> f64 {
        left.mul_add(self.all, self.within) / (self.all + self.within)
    }

    /// The cells that pay in a picture of so many pixels, where they leave this share of the noise.
    fn paying(
        &self,
        left: f64,
        cells: &[&[Sighting]],
        pixels: f64,
        estimates: &ChoiceEstimates,
    ) -> Vec<usize> {
        let plan = estimates.best();
        let known = pixels_of(cells);
        // Few samples tell little of a single cell: half of its noise is that of its neighbours.
        let noise = |i: usize| 0.5 * (self.cells[i] / self.all + pixels_of_cell(cells[i]) / known);
        let ray = RAY_COST / estimates.vertices();
        let rays = |i: usize| ray * f64::from(rays_of_cell(census::pixels(cells[i])));
        let mut order: Vec<(f64, usize)> =
            (0..cells.len()).map(|i| (noise(i) / rays(i), i)).collect();
        order.sort_by(|(a, i), (b, j)| b.total_cmp(a).then(i.cmp(j)));
        let plain = SAMPLES * pixels * estimates.cost(plan);
        let gained = (1.0 - left) * estimates.first_share(plan) * known / pixels;
        let slower = SAMPLES * (SAMPLE_COST - estimates.cost(plan)).max(0.0);
        let (mut error, mut time) = (1.0, plain);
        let (mut best, mut count) = (plain / LEAST_GAIN, 0);
        for (i, &(_, cell)) in (1..).zip(&order) {
            error -= gained * noise(cell);
            time += rays(cell) + slower * pixels_of_cell(cells[cell]);
            if error * time < best {
                (best, count) = (error * time, i);
            }
        }
        order.truncate(count);
        order.into_iter().map(|(_, cell)| cell).collect()
    }
}
