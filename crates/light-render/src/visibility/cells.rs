use lights::bounds::LightSampleContext;
use lights::bvh::visibility::{CellFactors, CellTable, CellTableError, MAX_COPIED_NODES};
use lights::samplers::{BvhLightSampler, VisibilityCache};

use super::cell_size::CellSize;
use super::census::Sighting;
use super::fill::Filled;
use super::film_point::FilmPoint;
use super::{ChoiceEstimates, census, fill, paying_cells};
use crate::{View, World};

/// Pixels of the largest picture that is measured for cells nobody asked for, so that they take
/// less than 4.0 GB.
const MOST_PIXELS: usize = 1 << 21;

/// Which lights are seen from the surfaces that a camera sees, in cells of space: pure functions of
/// the scene and of the whole picture's view, whatever part of it is rendered and by how many
/// threads.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VisibilityCells {
    size: CellSize,
    table: CellTable,
    pixels: usize,
}

impl VisibilityCells {
    /// Bytes that filling takes at most for each pixel of the whole picture: the points that the
    /// census looks at, and the largest cells that so few pixels may have, while the table of all
    /// is made of them.
    pub(crate) const MAX_BYTES_PER_PIXEL: u64 = {
        const KEY: usize = 32;
        let coarse = (KEY + MAX_COPIED_NODES * 36) / fill::FEWEST_OF_COARSE;
        let fine = (KEY + MAX_COPIED_NODES * 16) / fill::FEWEST_OF_FINE;
        census::MAX_BYTES_PER_PIXEL + 2 * (coarse + fine) as u64
    };

    /// The cells of what `view` shows of `world`, for the lights of `sampler`, on the threads of
    /// the current `rayon` pool.
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
        let cells: Vec<&[Sighting]> = sightings.chunk_by(|a, b| a.coarse == b.coarse).collect();
        Self::of(size, fill::fill(world, view, sampler, &cells))
    }

    /// Those cells of what `view` shows of `world` that are estimated to pay for their rays in a
    /// picture of 64 samples a pixel; plain where all of them together do not.
    ///
    /// A picture of more than [`MOST_PIXELS`] has the cells of a smaller one of the same camera.
    ///
    /// # Errors
    /// When there are more cells than 32 bits count.
    pub(crate) fn that_pay(
        world: &World,
        view: &View,
        lights: &BvhLightSampler,
        estimates: &ChoiceEstimates,
    ) -> Result<Self, CellTableError> {
        if !paying_cells::may_pay(estimates) {
            return Ok(Self::default());
        }
        let measured = &view.of_at_most(MOST_PIXELS);
        let size = CellSize::of(measured);
        let sightings = census::take(world, measured, &size);
        let cells: Vec<&[Sighting]> = sightings.chunk_by(|a, b| a.coarse == b.coarse).collect();
        let mut filled = paying_cells::fill_paying(world, measured, lights, &cells, estimates);
        filled.quarters = filled.quarters * view.pixels() / measured.pixels();
        Self::of(size, filled)
    }

    fn of(size: CellSize, filled: Filled) -> Result<Self, CellTableError> {
        let Filled { cells, quarters } = filled;
        let (coarse, fine): (Vec<_>, Vec<_>) = cells.into_iter().unzip();
        let fine: Vec<_> = fine.into_iter().flatten().collect();
        let table = CellTable::new(&coarse, &fine)?;
        Ok(Self {
            size,
            table,
            pixels: quarters / FilmPoint::QUARTERS,
        })
    }

    /// Whether there is no cell with factors.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.table.view().parts().keys.is_empty()
    }

    /// How many coarse and fine cells have factors.
    #[must_use]
    pub fn counts(&self) -> [usize; 2] {
        let keys = self.table.view().parts().keys;
        let coarse = keys.iter().filter(|key| key.is_coarse()).count();
        [coarse, keys.len() - coarse]
    }

    /// How many pixels of the whole picture show a surface in such a cell, by the rays of the
    /// census.
    #[must_use]
    pub const fn pixels(&self) -> usize {
        self.pixels
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
        if self.is_plain() || ctx.ns().is_none() {
            return None;
        }
        let cell = self
            .table
            .view()
            .nearest_factors(ctx, self.size.coarse_edge(ctx));
        (!cell.is_plain()).then_some(cell)
    }
}
