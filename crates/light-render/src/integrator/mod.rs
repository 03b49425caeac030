//! How light reaches the camera: the estimators of the rendering equation.

mod direct;
mod estimator;
mod kind;
mod path;
mod through;
mod volpath;
mod volume_vertex;

pub use estimator::Estimator;
pub use kind::{Integrator, follow};
pub use path::{PathSettings, Traced, trace};
pub use volpath::trace_volume;
