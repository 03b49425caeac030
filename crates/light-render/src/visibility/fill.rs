use lights::bounds::LightId;
use lights::bvh::visibility::{CoarseCell, FillOptions, FineCell};
use lights::glam::{Vec2, Vec3};
use lights::samplers::BvhLightSampler;
use lights::sources::PdfCoverage;
use rayon::prelude::*;

use super::census::{Place, Sighting, place};
use crate::{View, World};

/// Coarse cells that fewer pixels show are plain.
const FEWEST_OF_COARSE: usize = 12;

/// Fine cells that fewer pixels show have the factors of their coarse cell.
const FEWEST_OF_FINE: usize = 2;

/// Places of a coarse cell, at most.
const COARSE_PLACES: usize = 128;

/// Places of a fine cell, at most.
const FINE_PLACES: usize = 16;

/// The cells of `sightings`, in order, but for the plain ones.
pub(super) fn fill(
    world: &World,
    view: &View,
    sampler: &BvhLightSampler,
    sightings: &[Sighting],
) -> Vec<(CoarseCell, Vec<FineCell>)> {
    let tree = sampler.tree().view();
    let options = FillOptions::default();
    let places = |sightings: &[Sighting], most| -> Vec<Place> {
        let stride = sightings.len().div_ceil(most);
        let pixels = sightings.iter().step_by(stride);
        pixels.filter_map(|s| place(world, view, s.pixel)).collect()
    };
    let visible = |place: &Place, light: LightId, u: Vec2| sees(world, place, light, u);
    let cells: Vec<&[Sighting]> = sightings.chunk_by(|a, b| a.coarse == b.coarse).collect();
    let filled = cells.into_par_iter().filter_map(|cell| {
        if cell.len() < FEWEST_OF_COARSE {
            return None;
        }
        let at = places(cell, COARSE_PLACES);
        let coarse = CoarseCell::fill(tree, cell[0].coarse, &at, &options, visible);
        if coarse.factors().is_plain() {
            return None;
        }
        let parts = cell.chunk_by(|a, b| a.fine == b.fine);
        let fine = parts
            .filter(|part| part.len() >= FEWEST_OF_FINE)
            .map(|part| {
                let at = places(part, FINE_PLACES);
                coarse.fill_fine(tree, part[0].fine, &at, &options, visible)
            });
        let fine = fine.collect();
        Some((coarse, fine))
    });
    filled.collect()
}

/// Whether the point of `light` that `u` chooses is seen from `place`, and shines on it.
fn sees(world: &World, place: &Place, light: LightId, u: Vec2) -> bool {
    let Place { surface, ctx } = place;
    let sample = world.sample_light(light, ctx, u, PdfCoverage::Complete);
    sample.is_some_and(|sample| {
        sample.l != Vec3::ZERO && !world.occluded(surface, sample.wi, sample.p_light)
    })
}
