use lights::bounds::LightSampleContext;
use lights::bvh::visibility::{CellFactors, CellKey, CellTable, CellTableError};
use lights::glam::Vec3;
use lights::samplers::{BvhLightSampler, VisibilityCache};

use super::{census, fill};
use crate::{View, World};

/// Which lights are seen from the surfaces that a camera sees, in cells of space: pure functions of
/// the scene and of the whole picture's view, whatever part of it is rendered and by how many
/// threads.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VisibilityCells {
    size: CellSize,
    table: CellTable,
}

/// How large cells are: so many pixels of the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct CellSize {
    camera: Vec3,
    /// Edge of a coarse cell at distance 1.
    edge: f32,
}

impl CellSize {
    /// Edge of a coarse cell, in pixels.
    const PIXELS: f32 = 20.0;

    pub(super) fn of(view: &View) -> Self {
        Self {
            camera: view.camera().position,
            edge: Self::PIXELS * view.pixel_angle(),
        }
    }

    #[inline]
    pub(super) fn fine_key(&self, ctx: &LightSampleContext) -> CellKey {
        CellKey::fine(ctx, self.edge * ctx.p.distance(self.camera))
    }
}

impl VisibilityCells {
    /// The cells of what `view` shows of `world`, for the lights of `sampler`, on the threads of the
    /// current `rayon` pool.
    ///
    /// # Errors
    /// When there are more cells than 32 bits count.
    pub fn fill(
        world: &World,
        view: &View,
        sampler: &BvhLightSampler,
    ) -> Result<Self, CellTableError> {
        let size = CellSize::of(view);
        let sightings = census::take(world, view, &size);
        let cells = fill::fill(world, view, sampler, &sightings);
        let (coarse, fine): (Vec<_>, Vec<_>) = cells.into_iter().unzip();
        let table = CellTable::new(&coarse, &fine.concat())?;
        Ok(Self { size, table })
    }

    /// Bytes that they take.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.table.bytes()
    }
}

impl VisibilityCache for VisibilityCells {
    #[inline]
    fn factors<'a>(&'a self, ctx: &LightSampleContext) -> Option<CellFactors<'a>> {
        let cell = self.table.view().factors(self.size.fine_key(ctx));
        (!cell.is_plain()).then_some(cell)
    }
}
