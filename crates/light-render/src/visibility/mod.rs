//! What the camera's surroundings see of the lights: cells of space, filled before the picture.

mod cell_size;
mod cells;
mod census;
mod fill;
mod sampler;

pub use cells::VisibilityCells;
pub use sampler::CellLightSampler;

/// What the choices of a picture's lights know of their visibility.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Visibility {
    /// Nothing: lights are chosen as if nothing were in the way.
    #[default]
    Off,
    /// What [`VisibilityCells`] know.
    Cells,
}

impl Visibility {
    /// The name of the value on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::Cells => "cells",
        }
    }
}
