use std::path::{Path, PathBuf};

use crate::{Film, PartialPicture, PictureIdentity};

use super::failure::Failure;

/// A picture that somebody stopped before its last sample.
#[derive(Debug)]
pub(super) struct Unfinished<'a> {
    /// The first of its files.
    pub(super) output: &'a Path,
    /// Samples a pixel that were wanted; `None` for as many as fit into a time.
    pub(super) wanted: Option<u32>,
    /// The checkpoint that was asked for, which holds all samples by now.
    pub(super) checkpoint: Option<&'a Path>,
}

impl Unfinished<'_> {
    /// Keeps the sums of all samples in a checkpoint of the picture of `identity`, unless there is
    /// one, and says how to go on.
    ///
    /// # Errors
    /// When the checkpoint cannot be written.
    pub(super) fn keep(
        &self,
        film: Film,
        identity: impl FnOnce() -> PictureIdentity,
    ) -> Result<(Film, Failure), Failure> {
        let samples = film.samples();
        let of = self
            .wanted
            .map_or_else(String::new, |wanted| format!(" of {wanted}"));
        let done = format!(
            "interrupted after {samples}{of} samples a pixel, which {} holds",
            self.output.display()
        );
        if let Some(path) = self.checkpoint {
            let message = format!("{done}; the same command goes on from {}", path.display());
            return Ok((film, Failure::Interrupted(message)));
        }
        let path = self.checkpoint_path();
        let part = PartialPicture {
            samples: 0..samples,
            film,
            identity: identity(),
        };
        part.write(&path).map_err(Failure::input)?;
        let message = format!(
            "{done}; to go on, add --checkpoint {} to the same command",
            path.display()
        );
        Ok((part.film, Failure::Interrupted(message)))
    }

    /// Beside the picture.
    fn checkpoint_path(&self) -> PathBuf {
        self.output.with_extension("checkpoint.exr")
    }
}
