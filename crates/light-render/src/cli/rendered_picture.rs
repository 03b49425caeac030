use lights::glam::Vec3;

use crate::Rendering;

/// The samples of a picture.
#[derive(Debug)]
pub(super) struct RenderedPicture {
    pub(super) rendering: Rendering,
    /// The names and the pixels of parts of its light.
    pub(super) layers: Vec<(String, Vec<Vec3>)>,
    /// Whether somebody asked to stop.
    pub(super) is_stopped: bool,
}
