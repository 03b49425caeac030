use core::borrow::Borrow;

use lights::bounds::{LightId, LightSampleContext};
use lights::bvh::visibility::CellKey;
use lights::glam::{Vec2, Vec3};
use lights::sources::PdfCoverage;
use rayon::prelude::*;

use super::cell_size::CellSize;
use crate::bsdf::Scattering;
use crate::{Surface, View, World};

/// A pixel, and the cell of the surface that it shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Sighting {
    pub(super) coarse: CellKey,
    pub(super) fine: CellKey,
    pub(super) pixel: u32,
}

/// A point that a pixel shows, and the receiver there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) surface: Surface,
    pub(super) ctx: LightSampleContext,
}

impl Place {
    /// Whether the point of `light` that `u` chooses is visible from here; `None` if it emits
    /// nothing toward this place.
    pub(super) fn sees(&self, world: &World, light: LightId, u: Vec2) -> Option<bool> {
        let Self { surface, ctx } = self;
        let sample = world.sample_light(light, ctx, u, PdfCoverage::Complete)?;
        let is_lit = sample.l != Vec3::ZERO;
        is_lit.then(|| !world.occluded(surface, sample.wi, sample.p_light))
    }
}

impl Borrow<LightSampleContext> for Place {
    fn borrow(&self) -> &LightSampleContext {
        &self.ctx
    }
}

/// The cells that the camera sees, by one ray through the middle of each pixel of the whole
/// picture, in the order of coarse cells, fine cells and pixels.
///
/// Not of the part that is rendered: a pixel has the same cells in a picture and in its parts.
pub(super) fn take(world: &World, view: &View, size: &CellSize) -> Vec<Sighting> {
    let (width, height) = view.resolution();
    let mut sightings: Vec<_> = (0..width * height)
        .into_par_iter()
        .filter_map(|pixel| {
            let fine = size.fine_key(place(world, view, pixel)?.borrow());
            let coarse = fine.coarse();
            Some(Sighting {
                coarse,
                fine,
                pixel,
            })
        })
        .collect();
    sightings.par_sort_unstable();
    sightings
}

/// The first surface behind the middle of a pixel, and the receiver there; `None` if there is none,
/// or a mirror.
pub(super) fn place(world: &World, view: &View, pixel: u32) -> Option<Place> {
    let (surface, scattering, wo) = camera_surface(world, view, pixel, Vec2::splat(0.5))?;
    let ctx = world.light_context(&surface, &scattering, wo);
    Some(Place { surface, ctx })
}

/// The first surface behind the point `at` of a pixel, how it scatters, and the direction to the
/// camera; `None` if there is none, or a mirror.
pub(super) fn camera_surface(
    world: &World,
    view: &View,
    pixel: u32,
    at: Vec2,
) -> Option<(Surface, Scattering, Vec3)> {
    let (width, _) = view.resolution();
    let corner = Vec2::new((pixel % width) as f32, (pixel / width) as f32);
    let ray = view.ray(corner + at, Vec2::splat(0.5));
    let surface = world.closest(&ray, None)?;
    let scattering = world.scattering(&surface);
    if scattering.bsdf().is_dirac() {
        return None;
    }
    Some((surface, scattering, -ray.direction))
}
