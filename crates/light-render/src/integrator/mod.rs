//! How light reaches the camera: the estimators of the rendering equation.

mod chosen_lights;
mod direct;
mod estimator;
mod li;
mod light_sum;
mod path;
mod path_state;
mod settings;
mod single_scattering;
mod sky;
mod traced;
mod transmittance;
mod volpath;
mod volume_vertex;

pub(crate) use direct::is_in_the_surface;
pub use estimator::Estimator;
pub(crate) use li::add_li;
pub use li::li;
pub(crate) use light_sum::{LayerSums, LightSum, Total};
use path::trace;
pub use settings::{Integrator, PathSettings, SingleScattering};
pub(crate) use single_scattering::coarse_step;
use single_scattering::trace_single_scattering;
pub use traced::Traced;
use volpath::trace_volume;
