use core::time::Duration;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use light_render::{
    AnyLightSampler, Film, PartialPicture, PartialPictureError, Progress, RenderSettings,
    Rendering, View, World, render,
};
use light_scene::{ChannelFile, Crop, Diagnostic};

use super::arguments::positive;
use super::failure::Failure;

/// Renderings that may be interrupted.
#[derive(Args, Debug)]
pub(crate) struct CheckpointArgs {
    /// Keep the samples so far in this .exr, and go on from those in it: the image has the same bits as if it had been rendered at once.
    #[arg(long, value_name = "FILE", conflicts_with = "samples")]
    checkpoint: Option<PathBuf>,
    /// How much work an interruption may lose.
    #[arg(long, value_name = "SECONDS", value_parser = positive, default_value_t = 30.0, requires = "checkpoint")]
    checkpoint_every: f32,
}

/// A file with the exact sums of all samples so far.
#[derive(Debug)]
pub(crate) struct Checkpoint {
    path: PathBuf,
    every: Duration,
    /// What is rendered.
    subject: String,
    /// The samples that the file held.
    part: Option<PartialPicture>,
}

impl CheckpointArgs {
    /// The checkpoint that was asked for, of the picture that `subject` describes.
    ///
    /// # Errors
    /// When the file cannot be read, or is of another picture.
    pub(crate) fn open(
        &self,
        subject: impl FnOnce() -> String,
    ) -> Result<Option<Checkpoint>, Failure> {
        let Some(path) = &self.checkpoint else {
            return Ok(None);
        };
        if path.extension().is_none_or(|ending| ending != "exr") {
            return Err(refuse(path, "expected a file name that ends in .exr"));
        }
        let subject = subject();
        let part = path.exists().then(|| read(path, &subject)).transpose()?;
        Ok(Some(Checkpoint {
            path: path.clone(),
            every: Duration::from_secs_f32(self.checkpoint_every),
            subject,
            part,
        }))
    }
}

impl Checkpoint {
    /// Renders the samples that are missing, and writes the file again and again. Time and rays are those of this run.
    ///
    /// # Errors
    /// When the file holds more samples than are asked for, or cannot be written.
    pub(crate) fn render(
        self,
        world: &World,
        view: &View,
        sampler: &AnyLightSampler,
        settings: &RenderSettings,
        report: impl Fn(Progress),
    ) -> Result<Rendering, Failure> {
        let start = Instant::now();
        let Crop { min, max } = view.crop();
        let mut part = self.part.unwrap_or_else(|| PartialPicture {
            film: Film::new(max[0] - min[0], max[1] - min[1]),
            samples: 0..0,
            subject: self.subject,
        });
        let (had, wanted) = (part.samples.end, settings.samples.end);
        if had > wanted {
            let message = format!("expected at most {wanted} samples a pixel, found {had}");
            return Err(refuse(&self.path, message));
        }
        let (mut rays, mut rejected) = (0, 0);
        while part.samples.end < wanted {
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
            let show = |p: Progress| {
                let samples = next + p.samples;
                let of_samples = f64::from(samples) / f64::from(wanted);
                let of_time = |limit: Duration| start.elapsed().as_secs_f64() / limit.as_secs_f64();
                let done = settings
                    .time_limit
                    .map_or(of_samples, |limit| of_samples.max(of_time(limit)));
                report(Progress {
                    done: done.min(1.0),
                    samples,
                });
            };
            let rendering = render(world, view, sampler, &some, show);
            rays += rendering.rays;
            rejected += rendering.rejected;
            part.append(&rendering.film);
            part.to_file().write(&self.path).map_err(Failure::input)?;
        }
        Ok(Rendering {
            film: part.film,
            elapsed: start.elapsed(),
            rays,
            rejected,
        })
    }
}

/// The samples from 0 on that a file holds, of the picture that `subject` describes.
fn read(path: &Path, subject: &str) -> Result<PartialPicture, Failure> {
    let file = ChannelFile::read(path).map_err(Failure::input)?;
    let part = PartialPicture::from_file(&file);
    let part = part.map_err(|error| refuse(path, error.to_string()))?;
    if part.subject != subject {
        return Err(refuse(path, PartialPictureError::OtherPicture.to_string()));
    }
    if part.samples.start != 0 {
        return Err(refuse(path, "expected samples from 0 on"));
    }
    Ok(part)
}

fn refuse(path: &Path, message: impl Into<String>) -> Failure {
    Failure::input(Diagnostic::file(path, message.into()))
}
