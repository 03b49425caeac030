use lights::bounds::LightId;
use lights::bvh::visibility::{CoarseCell, FillOptions, FineCell};
use lights::glam::Vec2;
use lights::samplers::BvhLightSampler;
use rayon::prelude::*;

use super::census::{Place, Sighting, place};
use crate::{View, World};

/// Coarse cells that fewer pixels show are plain.
pub(super) const FEWEST_OF_COARSE: usize = 4;

/// Fine cells that fewer pixels show have the factors of their coarse cell.
pub(super) const FEWEST_OF_FINE: usize = 2;

/// Places of a coarse cell, at most.
const COARSE_PLACES: usize = 128;

/// Places of a fine cell, at most.
const FINE_PLACES: usize = 16;

/// Rays for each pixel that shows a coarse cell, to lights that the tree chooses; so a cell takes
/// a share of the time of its pixels, however small it is.
const EXPLORING_RAYS_PER_PIXEL: f32 = 24.0;

/// The same to lights that the factors learnt so far choose, in each of two rounds.
const GUIDED_RAYS_PER_PIXEL: f32 = 3.0;

/// The same for a fine cell.
const FINE_RAYS_PER_PIXEL: f32 = 8.0;

/// If cells with factors cover no more than this share of the pixels, they cost more than they
/// gain.
const LEAST_KNOWN_SHARE: f32 = 0.02;

/// The cells that are not plain.
#[derive(Default)]
pub(super) struct Filled {
    /// In the order of their keys.
    pub(super) cells: Vec<(CoarseCell, Vec<FineCell>)>,
    /// How many pixels show a surface in one of them.
    pub(super) pixels: usize,
}

/// The cells of `sightings` but for the plain ones. None at all where nearly all would be plain.
pub(super) fn fill(
    world: &World,
    view: &View,
    sampler: &BvhLightSampler,
    sightings: &[Sighting],
) -> Filled {
    let tree = sampler.tree().view();
    let places = |sightings: &[Sighting], most| -> Vec<Place> {
        let stride = sightings.len().div_ceil(most);
        let pixels = sightings.iter().step_by(stride);
        pixels.filter_map(|s| place(world, view, s.pixel)).collect()
    };
    let visible =
        |place: &Place, light: LightId, u: Vec2| place.sees(world, light, u) == Some(true);
    let cells: Vec<&[Sighting]> = sightings.chunk_by(|a, b| a.coarse == b.coarse).collect();
    let filled = cells.into_par_iter().filter_map(|cell| {
        if cell.len() < FEWEST_OF_COARSE {
            return None;
        }
        let rays = rays_of(cell.len());
        let at = places(cell, COARSE_PLACES);
        let coarse = CoarseCell::fill(tree, cell[0].coarse, &at, &rays, visible);
        if coarse.factors().is_plain() {
            return None;
        }
        let parts = cell.chunk_by(|a, b| a.fine == b.fine);
        let fine = parts
            .filter(|part| part.len() >= FEWEST_OF_FINE)
            .map(|part| {
                let rays = rays_of(part.len());
                let at = places(part, FINE_PLACES);
                coarse.fill_fine(tree, part[0].fine, &at, &rays, visible)
            });
        let fine = fine.collect();
        Some((cell.len(), (coarse, fine)))
    });
    let (pixels, cells): (Vec<usize>, Vec<_>) = filled.unzip();
    let pixels = pixels.iter().sum();
    if (pixels as f32) < LEAST_KNOWN_SHARE * sightings.len() as f32 {
        return Filled::default();
    }
    Filled { cells, pixels }
}

/// How many rays a cell is filled by that so many pixels show.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "at most the default numbers"
)]
fn rays_of(pixels: usize) -> FillOptions {
    let all = FillOptions::default();
    let at_most = |most: u32, per_pixel: f32| (per_pixel * pixels as f32).min(most as f32) as u32;
    FillOptions {
        exploring_rays: at_most(all.exploring_rays, EXPLORING_RAYS_PER_PIXEL),
        guided_rays: at_most(all.guided_rays, GUIDED_RAYS_PER_PIXEL),
        fine_rays: at_most(all.fine_rays, FINE_RAYS_PER_PIXEL),
        ..all
    }
}
