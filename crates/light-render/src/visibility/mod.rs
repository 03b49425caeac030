//! Visibility of lights from the surfaces that the camera sees: the share of light that arrives,
//! and cells of space, both before the picture.

mod cell_size;
mod cells;
mod census;
mod fill;
mod sampler;
mod single_choice;
mod visible_share;

pub use cells::VisibilityCells;
pub use sampler::CellLightSampler;
pub use single_choice::SingleChoiceLightSampler;
pub use visible_share::visible_share;

/// The visibility that the choices of a picture's lights use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Visibility {
    /// Nothing: lights are chosen as if nothing were in the way.
    #[default]
    Off,
    /// The [`visible_share`] of the light in the picture: where much is hidden, one light is chosen
    /// instead of several.
    Share,
    /// The factors of [`VisibilityCells`].
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
