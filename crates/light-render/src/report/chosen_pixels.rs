use light_scene::Crop;

use crate::bench::{PixelVariance, SceneBenchOptions, pixel_variance};
use crate::{AnyLightSampler, View, World};

/// Columns and rows of the cells of a picture, each of which shows one pixel.
const CELLS: [u32; 2] = [3, 2];

/// Where pixels of a cell are tried, as shares of its size: the middle first.
const TRIES: [[f64; 2]; 5] = [
    [0.5, 0.5],
    [0.3, 0.7],
    [0.7, 0.3],
    [0.25, 0.25],
    [0.75, 0.75],
];

/// The variance at `wanted` pixels; if none are wanted, at one pixel in each of six cells of the
/// picture, where one receives light.
pub(super) fn chosen_pixels(
    world: &World,
    view: &View,
    wanted: &[[u32; 2]],
    samplers: &[&AnyLightSampler],
) -> Vec<PixelVariance> {
    let strata = SceneBenchOptions::strata_for(world.lights().len());
    let at = |pixels: &[[u32; 2]]| pixel_variance(world, view, pixels, samplers, strata);
    if !wanted.is_empty() {
        return at(wanted);
    }
    let cells = (0..CELLS[1]).flat_map(|row| (0..CELLS[0]).map(move |column| [column, row]));
    cells
        .filter_map(|cell| {
            let tried = TRIES
                .iter()
                .map(|&share| pixel_in(view.crop(), cell, share));
            let mut found = tried.flat_map(|pixel| at(&[pixel]));
            found.find(|pixel| pixel.best.total > 0.0)
        })
        .collect()
}

/// What is said of each of the `wanted` pixels that is not among those `found`.
pub(super) fn left_out(wanted: &[[u32; 2]], found: &[PixelVariance]) -> Vec<String> {
    let is_found = |pixel| found.iter().any(|found| found.pixel == pixel);
    let missing = wanted.iter().filter(|&&pixel| !is_found(pixel));
    let say = |[x, y]: &[u32; 2]| {
        format!(
            "--pixel {x},{y}: no variance there, it shows no surface that scatters light to all \
             sides (nothing, a light or a mirror)"
        )
    };
    missing.map(say).collect()
}

/// The pixel at a place in a cell.
fn pixel_in(crop: Crop, cell: [u32; 2], share: [f64; 2]) -> [u32; 2] {
    [0, 1].map(|axis| {
        let size = f64::from(crop.max[axis] - crop.min[axis]);
        let place = size * (f64::from(cell[axis]) + share[axis]) / f64::from(CELLS[axis]);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "within a picture"
        )]
        let place = place as u32;
        (crop.min[axis] + place).min(crop.max[axis] - 1)
    })
}
