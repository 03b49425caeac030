//! Samplers compared on a scene: what `lights report` measures, and the page that shows it.

mod chosen_pixels;
mod html;
mod numbers;
mod page;
mod picture;
mod reference;
mod sampler_row;
mod scene_report;
mod tables;
mod timed;

pub(crate) use reference::{Reference, ReferenceSource};
pub(crate) use scene_report::{ReportOptions, SceneReport};
