//! How light reaches the camera: the estimators of the rendering equation.

mod direct;
mod estimator;
mod path;

pub use estimator::Estimator;
pub use path::{PathSettings, Traced, trace};
