//! Visibility of lights from the surfaces that the camera sees: how noisy choices of lights will be
//! among hidden ones, and cells of space, both before the picture.

mod cell_noise;
mod cell_size;
mod cells;
mod census;
mod choice_estimates;
mod choice_plan;
mod fill;
mod film_point;
mod measured_vertex;
mod paying_cells;
mod pixel_moments;
mod sampler;

pub use cells::VisibilityCells;
pub use choice_estimates::ChoiceEstimates;
pub use choice_plan::{ChoicePlan, PlannedLightSampler};
pub use sampler::CellLightSampler;

/// The visibility that the choices of a picture's lights use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Visibility {
    /// Nothing: lights are chosen as if nothing were in the way.
    #[default]
    Off,
    /// The [`ChoiceEstimates`] of the picture: where much light is hidden, one light is chosen
    /// instead of several, from the root or by a cut; and with the factors of those
    /// [`VisibilityCells`] that pay for their rays.
    Share,
    /// The factors of all [`VisibilityCells`].
    Cells,
}

impl Visibility {
    /// The name of the value on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::Share => "share",
            Self::Cells => "cells",
        }
    }
}
