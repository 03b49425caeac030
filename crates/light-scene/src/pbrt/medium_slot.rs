use std::path::PathBuf;

use lights::media::AnyMedium;
use lights::sources::Rgb;

/// A medium by its name: a file may use it before it defines it.
#[derive(Debug)]
pub(super) struct MediumSlot {
    pub(super) name: String,
    pub(super) first_use: (PathBuf, usize),
    pub(super) medium: Option<AnyMedium<Rgb>>,
}
