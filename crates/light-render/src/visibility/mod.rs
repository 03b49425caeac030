//! What the camera's surroundings see of the lights: cells of space, filled before the picture.

mod cells;
mod census;
mod fill;

pub use cells::VisibilityCells;
