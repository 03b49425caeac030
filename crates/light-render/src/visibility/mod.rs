//! Visibility of lights from the surfaces that the camera sees: cells of space, filled before the
//! picture.

mod cell_size;
mod cells;
mod census;
mod fill;
mod sampler;

pub use cells::VisibilityCells;
pub use sampler::CellLightSampler;

/// The visibility that the choices of a picture's lights use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Visibility {
    /// Nothing: lights are chosen as if nothing were in the way.
    #[default]
    Off,
    /// The factors of [`VisibilityCells`].
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
