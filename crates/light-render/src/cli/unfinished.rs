use std::fs::{self, File};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::{Film, PartialPicture, PictureIdentity};

use super::failure::Failure;
use super::output_file::{expect_another, refuse};

/// A picture that somebody stopped before its last sample.
#[derive(Debug)]
pub(super) struct Unfinished<'a> {
    /// All of its files.
    pub(super) outputs: &'a [PathBuf],
    /// Those of them that keep what they held before.
    pub(super) old: &'a [PathBuf],
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
        let holder = self.outputs.iter().find(|path| !self.old.contains(path));
        let holder = holder.map_or_else(String::new, |path| {
            format!(", which {} holds", path.display())
        });
        let old = self.old.first().map_or_else(String::new, |path| {
            format!("; {} stays as it was", path.display())
        });
        let done = format!("interrupted after {samples}{of} samples a pixel{holder}{old}");
        if let Some(path) = self.checkpoint {
            let message = format!("{done}; the same command goes on from {}", path.display());
            return Ok((film, Failure::Interrupted(message)));
        }
        let part = PartialPicture {
            samples: 0..samples,
            film,
            identity: identity(),
        };
        let path = self.write_beside(&part)?;
        let message = format!(
            "{done}; to go on, add --checkpoint {} to the same command",
            path.display()
        );
        Ok((part.film, Failure::Interrupted(message)))
    }

    /// Writes `part` beside the picture, to a file of its own whose name is returned.
    fn write_beside(&self, part: &PartialPicture) -> Result<PathBuf, Failure> {
        // Complete before it gets its name: a second request to end may come at any time.
        let ending = format!("checkpoint-of-{}.exr", std::process::id());
        let unnamed = self.outputs[0].with_extension(ending);
        part.write(&unnamed).map_err(Failure::input)?;
        let named = self.free_path().and_then(|path| {
            let renamed = fs::rename(&unnamed, &path);
            renamed.map_err(|error| {
                drop(fs::remove_file(&path));
                refuse(&path, format!("cannot be written: {error}"))
            })?;
            Ok(path)
        });
        if named.is_err() {
            drop(fs::remove_file(&unnamed));
        }
        named
    }

    /// The first name beside the picture that no file has, which an empty file takes.
    fn free_path(&self) -> Result<PathBuf, Failure> {
        let mut ending = "checkpoint.exr".to_owned();
        let mut number = 1;
        loop {
            let path = self.outputs[0].with_extension(ending);
            if expect_another(&path, self.outputs, "--output").is_ok() {
                match File::create_new(&path) {
                    Ok(_) => return Ok(path),
                    Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                    Err(error) => return Err(refuse(&path, format!("cannot be written: {error}"))),
                }
            }
            number += 1;
            ending = format!("checkpoint-{number}.exr");
        }
    }
}
