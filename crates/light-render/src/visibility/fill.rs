use lights::bounds::LightId;
use lights::bvh::visibility::{CoarseCell, FillOptions, FineCell};
use lights::glam::Vec2;
use lights::samplers::BvhLightSampler;
use rayon::prelude::*;

use super::census::{Place, Sighting, pixels, place, quarters};
use super::film_point::FilmPoint;
use crate::{View, World};

/// Coarse cells that fewer pixels show are plain.
pub(super) const FEWEST_OF_COARSE: usize = 2;

/// Fine cells that fewer pixels show have no factors of their own.
pub(super) const FEWEST_OF_FINE: usize = 1;

/// Places of a coarse cell, at most.
const COARSE_PLACES: usize = 128;

/// Places of a fine cell, at most.
const FINE_PLACES: usize = 8;

/// Rays for each pixel that shows a coarse cell, to lights that the tree chooses; so a cell takes
/// a share of the time of its pixels, however small it is.
const EXPLORING_RAYS_PER_PIXEL: f32 = 40.0;

/// The same to lights that the factors learnt so far choose, in each of two rounds.
const GUIDED_RAYS_PER_PIXEL: f32 = 3.0;

/// The same for a fine cell of which the coarse one knows nothing.
const FINE_RAYS_PER_PIXEL: f32 = 16.0;

/// The part of them that fine cells take, by the scenes of `docs/occlusion.md`.
const MEAN_DOUBT: f32 = 0.5;

/// If cells with factors cover no more than this share of the pixels, they cost more than they
/// gain.
const LEAST_KNOWN_SHARE: f32 = 0.02;

/// A coarse cell with its fine ones.
pub(super) type Cell = (CoarseCell, Vec<FineCell>);

/// The cells that are not plain.
#[derive(Default)]
pub(super) struct Filled {
    /// In the order of their keys.
    pub(super) cells: Vec<Cell>,
    /// How many quarters of pixels show a surface in one of them.
    pub(super) quarters: usize,
}

impl Filled {
    /// Those that are filled, of all in the order of their keys.
    pub(super) fn from_cells<'a>(
        all: impl Iterator<Item = (&'a &'a [Sighting], Option<Cell>)>,
    ) -> Self {
        let mut filled = Self::default();
        for (sightings, cell) in all {
            if let Some(cell) = cell {
                filled.cells.push(cell);
                filled.quarters += quarters(sightings);
            }
        }
        filled
    }
}

/// All `cells` but for the plain ones. None at all where nearly all would be plain.
pub(super) fn fill(
    world: &World,
    view: &View,
    lights: &BvhLightSampler,
    cells: &[&[Sighting]],
) -> Filled {
    let filled: Vec<Option<Cell>> = cells
        .par_iter()
        .map(|cell| fill_cell(world, view, lights, cell))
        .collect();
    let filled = Filled::from_cells(cells.iter().zip(filled));
    let all: usize = cells.iter().map(|cell| quarters(cell)).sum();
    if (filled.quarters as f32) < LEAST_KNOWN_SHARE * all as f32 {
        return Filled::default();
    }
    filled
}

/// The coarse cell of these sightings, with its fine cells; `None` if it is plain.
pub(super) fn fill_cell(
    world: &World,
    view: &View,
    lights: &BvhLightSampler,
    cell: &[Sighting],
) -> Option<Cell> {
    if quarters(cell) < FilmPoint::QUARTERS * FEWEST_OF_COARSE {
        return None;
    }
    let tree = lights.tree().view();
    let visible = |place: &Place, light: LightId, u: Vec2| place.sees(world, light, u);
    let rays = rays_of(pixels(cell));
    let at = places(world, view, cell, COARSE_PLACES);
    let coarse = CoarseCell::fill(tree, cell[0].coarse, &at, &rays, visible);
    if coarse.factors().is_plain() {
        return None;
    }
    let parts = cell.chunk_by(|a, b| a.fine == b.fine);
    let fine = parts
        .filter(|part| quarters(part) >= FilmPoint::QUARTERS * FEWEST_OF_FINE)
        .map(|part| {
            let rays = rays_of(pixels(part));
            let at = places(world, view, part, FINE_PLACES);
            coarse.fill_fine(tree, part[0].fine, &at, &rays, visible)
        });
    let fine = fine.collect();
    Some((coarse.without_rays(), fine))
}

/// At most so many places of a cell, each for an equal share of the pixels that show it.
fn places(world: &World, view: &View, sightings: &[Sighting], most: usize) -> Vec<Place> {
    let stride = quarters(sightings).div_ceil(most);
    let (mut before, mut places) = (0, Vec::new());
    for sighting in sightings {
        let end = before + sighting.point.quarters();
        // The multiples of `stride` from `before` on.
        let count = end.div_ceil(stride) - before.div_ceil(stride);
        before = end;
        if count > 0 {
            let place = place(world, view, sighting.point);
            places.extend(core::iter::repeat_n(place, count).flatten());
        }
    }
    places
}

/// About how many rays fill a cell that so many pixels show, and its fine cells.
pub(super) fn rays_of_cell(pixels: f32) -> u32 {
    let FillOptions {
        first_rays,
        exploring_rays,
        guided_rays,
        ..
    } = rays_of(pixels);
    let coarse = first_rays.max(exploring_rays) + 2 * guided_rays;
    coarse + at_most(u32::MAX, MEAN_DOUBT * FINE_RAYS_PER_PIXEL, pixels)
}

/// How many rays a cell is filled by that so many pixels show.
fn rays_of(pixels: f32) -> FillOptions {
    let all = FillOptions::default();
    FillOptions {
        exploring_rays: at_most(all.exploring_rays, EXPLORING_RAYS_PER_PIXEL, pixels),
        guided_rays: at_most(all.guided_rays, GUIDED_RAYS_PER_PIXEL, pixels),
        fine_rays: at_most(all.fine_rays, FINE_RAYS_PER_PIXEL, pixels),
        ..all
    }
}

/// So many rays for each of the pixels, but no more than `most`.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "at most `most`"
)]
fn at_most(most: u32, per_pixel: f32, pixels: f32) -> u32 {
    (per_pixel * pixels).min(most as f32) as u32
}
