use core::ops::ControlFlow;
use core::time::Duration;
use std::path::{Path, PathBuf};
use std::time::Instant;

use crate::{
    AnyLightSampler, Film, PartialPicture, PictureIdentity, Progress, RenderSettings, Rendering,
    View, World, render_while,
};
use clap::Args;

use super::arguments::seconds;
use super::failure::Failure;
use super::output_file::{expect_another, expect_writable, has_ending, refuse};

/// Renderings that may be interrupted.
#[derive(Args, Debug)]
pub(crate) struct CheckpointArgs {
    /// Keep the samples so far in this .exr, and go on from those in it: the image has the same
    /// bits as if it had been rendered at once.
    #[arg(long, value_name = "FILE", conflicts_with = "samples")]
    checkpoint: Option<PathBuf>,
    /// How much work an interruption may lose.
    #[arg(
        long,
        value_name = "SECONDS",
        value_parser = seconds,
        default_value = "30",
        requires = "checkpoint"
    )]
    checkpoint_every: Duration,
}

/// A file with the exact sums of all samples so far.
#[derive(Debug)]
pub(crate) struct Checkpoint {
    path: PathBuf,
    every: Duration,
    /// What is rendered.
    identity: PictureIdentity,
    /// The samples that the file held.
    part: Option<PartialPicture>,
}

impl CheckpointArgs {
    /// Whether there is a checkpoint.
    pub(crate) const fn is_wanted(&self) -> bool {
        self.checkpoint.is_some()
    }

    /// The file that was asked for.
    pub(crate) fn path(&self) -> Option<&Path> {
        self.checkpoint.as_deref()
    }

    /// The file that was asked for, or none, in a list.
    pub(crate) fn file(&self) -> &[PathBuf] {
        self.checkpoint.as_slice()
    }

    /// Makes sure that a checkpoint can be written, and is none of the `outputs`.
    ///
    /// # Errors
    /// When its name does not end in .exr, its folder is missing, or it is one of the outputs.
    pub(crate) fn expect_place(&self, outputs: &[PathBuf]) -> Result<(), Failure> {
        let Some(path) = &self.checkpoint else {
            return Ok(());
        };
        if !has_ending(path, "exr") {
            return Err(refuse(path, "expected a file name that ends in .exr"));
        }
        expect_another(path, outputs, "--output for --checkpoint")?;
        expect_writable(path)
    }

    /// The checkpoint of the picture of the `identity`, which is asked for only if there is one.
    ///
    /// # Errors
    /// When the file cannot be read, or is of another picture.
    pub(crate) fn open(
        &self,
        identity: impl FnOnce() -> PictureIdentity,
    ) -> Result<Option<Checkpoint>, Failure> {
        let Some(path) = &self.checkpoint else {
            return Ok(None);
        };
        let identity = identity();
        let part = path.exists().then(|| read(path, &identity)).transpose()?;
        Ok(Some(Checkpoint {
            path: path.clone(),
            every: self.checkpoint_every,
            identity,
            part,
        }))
    }
}

impl Checkpoint {
    /// Renders the samples that are missing, and writes the file again and again, until `watch`
    /// breaks. Time and rays are those of this run. `watch` sees the picture of the last writing.
    ///
    /// # Errors
    /// When the file holds more samples than requested, or cannot be written.
    pub(crate) fn render(
        self,
        world: &World,
        view: &View,
        sampler: &AnyLightSampler,
        settings: &RenderSettings,
        mut watch: impl FnMut(Progress, &Film) -> ControlFlow<()>,
    ) -> Result<Rendering, Failure> {
        let start = Instant::now();
        let (width, height) = view.crop().size();
        let mut part = self.part.unwrap_or_else(|| PartialPicture {
            film: Film::new(width, height),
            samples: 0..0,
            identity: self.identity,
        });
        let (had, wanted) = (part.samples.end, settings.samples.end);
        if had > wanted {
            let message = format!("expected at most {wanted} samples a pixel, found {had}");
            return Err(refuse(&self.path, message));
        }
        let (mut rays, mut rejected) = (0, 0);
        let mut flow = ControlFlow::Continue(());
        while part.samples.end < wanted && flow.is_continue() {
            let next = part.samples.end;
            let left = settings
                .time_limit
                .map(|limit| limit.saturating_sub(start.elapsed()));
            if next > had && left.is_some_and(|left| left.is_zero()) {
                break;
            }
            let some = RenderSettings {
                samples: next..wanted,
                time_limit: Some(left.map_or(self.every, |left| left.min(self.every))),
                ..settings.clone()
            };
            let show = |p: Progress, film: &Film| {
                let samples = next + p.samples;
                let of_samples = f64::from(samples) / f64::from(wanted);
                let of_time = |limit: Duration| start.elapsed().as_secs_f64() / limit.as_secs_f64();
                let done = settings
                    .time_limit
                    .map_or(of_samples, |limit| of_samples.max(of_time(limit)));
                let progress = Progress {
                    done: done.min(1.0),
                    samples,
                };
                let film = if next == 0 { film } else { &part.film };
                flow = watch(progress, film);
                flow
            };
            let rendering = render_while(world, view, sampler, &some, show);
            rays += rendering.rays;
            rejected += rendering.rejected;
            part.append(&rendering.film);
            part.write(&self.path).map_err(Failure::input)?;
        }
        Ok(Rendering {
            film: part.film,
            elapsed: start.elapsed(),
            rays,
            rejected,
        })
    }
}

/// The samples from 0 on that a file holds, of the picture of this `identity`.
fn read(path: &Path, identity: &PictureIdentity) -> Result<PartialPicture, Failure> {
    let part = PartialPicture::read(path).map_err(Failure::input)?;
    let same = part.expect(identity);
    same.map_err(|error| refuse(path, error.to_string()))?;
    if part.samples.start != 0 {
        return Err(refuse(path, "expected samples from 0 on"));
    }
    Ok(part)
}
