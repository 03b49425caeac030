//! How light reaches the camera: the estimators of the rendering equation.

mod chosen;
mod direct;
mod estimator;
mod kind;
mod path;
mod single_scattering;
mod through;
mod volpath;
mod volume_vertex;

pub use estimator::Estimator;
pub use kind::{Integrator, follow};
pub use path::{PathSettings, Traced, trace};
pub use single_scattering::{SingleScattering, coarse_step, trace_single_scattering};
pub use volpath::trace_volume;
