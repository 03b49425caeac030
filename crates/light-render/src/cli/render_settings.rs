use core::num::NonZeroU32;
use core::ops::Range;
use core::time::Duration;

use clap::{Args, ValueEnum};
use light_scene::Scene;
use lights::media::StepSize;

use crate::integrator::{self, Integrator, PathSettings, SingleScattering};
use crate::{RenderSettings, SamplerKind, Visibility, World};

use super::arguments::{count, named, positive, sample_range, seconds};
use super::failure::Failure;
use super::visibility::VisibilityName;
use super::whole::whole;

/// Segments of the longest path where nobody says how many.
pub(super) const DEFAULT_DEPTH: u32 = 8;

/// Samples a pixel when nothing is said.
const DEFAULT_SAMPLES: u32 = 64;

/// What the file of a scene asks for, where the command line says nothing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FileSettings {
    /// Segments of the longest path.
    max_depth: Option<u32>,
    /// Samples a pixel.
    samples: Option<u32>,
}

impl FileSettings {
    pub(crate) const fn of(scene: &Scene) -> Self {
        Self {
            max_depth: scene.max_depth,
            samples: scene.samples_per_pixel,
        }
    }
}

/// Which samples are taken, and how.
#[derive(Args, Debug)]
pub(crate) struct SettingsArgs {
    /// Samples a pixel; without it as many as fit into --time, or as the scene's file asks for, or
    /// 64.
    #[arg(long, value_name = "N", value_parser = whole(1..=u32::MAX))]
    spp: Option<u32>,
    /// Render these samples alone, into an .exr that `lights merge` adds to others.
    #[arg(long, value_name = "A..B", value_parser = sample_range, conflicts_with = "spp")]
    pub(crate) samples: Option<Range<u32>>,
    /// Stop at this budget. The estimates and cells of visibility count, but are not cut short; at
    /// least one sample a pixel is taken.
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time: Option<Duration>,
    /// Segments of the longest path: 1 = emitters seen directly, 2 = plus direct light; without it
    /// what the scene's file asks for, or 8.
    #[arg(long, value_name = "N", value_parser = whole(1..=u32::MAX))]
    max_depth: Option<u32>,
    /// What scatters light: surfaces alone (path), or media as well (volpath), or either once
    /// (single-scattering, with lights for the ray as a whole, and -classic, in steps); without it
    /// volpath where the scene has media, else path.
    #[arg(long, value_enum)]
    integrator: Option<IntegratorName>,
    /// Length of the steps of single-scattering-classic, at least 1/65536 of the scene; without it
    /// a hundredth of the scene.
    #[arg(long, value_name = "LENGTH", value_parser = positive)]
    step: Option<f32>,
    /// Same seed, same image.
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
    /// How lights are chosen.
    #[arg(
        long,
        value_name = "SAMPLER",
        default_value_t = SamplerKind::DEFAULT,
        value_parser = named::<SamplerKind>(SamplerKind::ALL.map(SamplerKind::name))
    )]
    pub(crate) light_sampler: SamplerKind,
    /// How many lights are chosen at the first diffuse point of a path, at most as many as there
    /// are; without it 2, or as --visibility says.
    #[arg(long, value_name = "N", value_parser = count)]
    light_samples: Option<NonZeroU32>,
    /// What choices of lights know of their visibility: nothing (off); how much of the light in the
    /// picture arrives and how noisy it is, so that one light is chosen instead of several where
    /// much is hidden, and cells of space are filled where they save time (share); or what all
    /// cells know for what the camera sees of surfaces (cells). Without it share, but off with
    /// --light-samples, with samplers that are not bvh or bvh-morton, and for single scattering.
    /// A pilot picture is not made: pilot is the same as no --visibility, and a line says so.
    #[arg(long, value_enum)]
    visibility: Option<VisibilityName>,
    /// How light is found: by light samples, by material samples, or by both, weighted.
    #[arg(long, value_enum, default_value_t = Estimator::Mis)]
    estimator: Estimator,
}

/// The names of the integrators on the command line.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum IntegratorName {
    Path,
    Volpath,
    SingleScattering,
    SingleScatteringClassic,
}

/// The names of the estimators on the command line.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Estimator {
    Mis,
    Light,
    Bsdf,
}

impl SettingsArgs {
    /// What choices of lights know of their visibility.
    ///
    /// # Errors
    /// When the light sampler does not use visibility.
    pub(crate) fn visibility(&self) -> Result<Visibility, Failure> {
        let is_usable = matches!(
            self.light_sampler,
            SamplerKind::Bvh | SamplerKind::BvhMorton
        );
        let visibility = match self.visibility {
            Some(VisibilityName::Off) => Visibility::Off,
            Some(VisibilityName::Share) => Visibility::Share,
            Some(VisibilityName::Cells) => Visibility::Cells,
            Some(VisibilityName::Pilot) | None => {
                let is_free = self.light_samples.is_none() && !self.is_single_scattering();
                if is_usable && is_free {
                    Visibility::Share
                } else {
                    Visibility::Off
                }
            }
        };
        if visibility == Visibility::Off || is_usable {
            return Ok(visibility);
        }
        Err(Failure::Input(format!(
            "--visibility {}: expected --light-sampler bvh or bvh-morton, found {}",
            visibility.name(),
            self.light_sampler
        )))
    }

    /// What to say of --visibility.
    pub(crate) fn visibility_note(&self) -> Option<&'static str> {
        self.visibility.and_then(VisibilityName::note)
    }

    /// What to say of a --step that nothing takes.
    pub(crate) fn step_doubt(&self) -> Option<String> {
        let is_taken = matches!(
            self.integrator,
            Some(IntegratorName::SingleScatteringClassic)
        );
        let words = "--step has no effect without --integrator single-scattering-classic";
        (self.step.is_some() && !is_taken).then(|| words.to_owned())
    }

    /// What to say of a --light-samples where no lights are chosen.
    pub(crate) fn light_samples_doubt(&self) -> Option<String> {
        let chooses_none =
            matches!(self.estimator, Estimator::Bsdf) && !self.is_single_scattering();
        let words = "--light-samples has no effect with --estimator bsdf, which samples no light";
        (self.light_samples.is_some() && chooses_none).then(|| words.to_owned())
    }

    /// What to say of an --estimator that nothing takes.
    pub(crate) fn estimator_doubt(&self) -> Option<String> {
        let is_taken = matches!(self.estimator, Estimator::Mis) || !self.is_single_scattering();
        let words = "--estimator has no effect with single scattering, which samples lights alone";
        (!is_taken).then(|| words.to_owned())
    }

    /// What to say of media that single scattering does not reach.
    pub(crate) fn medium_doubt(&self, world: &World) -> Option<String> {
        let is_missed = world.has_media() && world.media().camera.is_none();
        let words = "single scattering is that of the medium around the camera, and there is none: \
                     surfaces around other media are black";
        (is_missed && self.is_single_scattering()).then(|| words.to_owned())
    }

    /// Whether lights are chosen for rays as a whole: all of them count.
    const fn is_single_scattering(&self) -> bool {
        matches!(
            self.integrator,
            Some(IntegratorName::SingleScattering | IntegratorName::SingleScatteringClassic)
        )
    }

    /// How many samples a pixel a whole picture has that `command` cuts into parts.
    ///
    /// # Errors
    /// When a part or a time was asked for instead.
    pub(crate) fn samples_of_whole(
        &self,
        command: &str,
        file: FileSettings,
    ) -> Result<u32, Failure> {
        let flag = match (&self.samples, self.time) {
            (None, None) => return Ok(self.spp.unwrap_or_else(|| default_samples(file))),
            (Some(_), _) => "--samples",
            (None, Some(_)) => "--time",
        };
        Err(Failure::Input(format!(
            "{flag}: expected --spp for {command}"
        )))
    }

    /// Samples a pixel, unless they are as many as fit into a time.
    pub(crate) fn wanted_samples(&self, file: FileSettings) -> Option<u32> {
        match (self.spp, self.time) {
            (Some(spp), _) => Some(spp),
            (None, Some(_)) => None,
            (None, None) => Some(default_samples(file)),
        }
    }

    /// The samples a pixel that the file decides, if it does.
    pub(crate) fn samples_of_file(&self, file: FileSettings) -> Option<u32> {
        let is_silent = self.spp.is_none() && self.time.is_none() && self.samples.is_none();
        file.samples.filter(|_| is_silent)
    }

    /// The settings for `world`.
    ///
    /// # Errors
    /// When the steps of a march are so short that it would not reach through the scene.
    pub(crate) fn settings(
        &self,
        world: &World,
        file: FileSettings,
    ) -> Result<RenderSettings, Failure> {
        let samples = match (&self.samples, self.spp, self.time) {
            (Some(samples), _, _) => samples.clone(),
            (None, Some(spp), _) => 0..spp,
            (None, None, Some(_)) => 0..u32::MAX,
            (None, None, None) => 0..default_samples(file),
        };
        Ok(RenderSettings {
            samples,
            time_limit: self.time,
            seed: self.seed,
            path: PathSettings {
                max_depth: self.max_depth.or(file.max_depth).unwrap_or(DEFAULT_DEPTH),
                estimator: match self.estimator {
                    Estimator::Mis => integrator::Estimator::Mis,
                    Estimator::Light => integrator::Estimator::Light,
                    Estimator::Bsdf => integrator::Estimator::Bsdf,
                },
                light_samples: self
                    .light_samples
                    .unwrap_or(PathSettings::DEFAULT_LIGHT_SAMPLES),
                integrator: self.integrator(world)?,
            },
        })
    }

    fn integrator(&self, world: &World) -> Result<Integrator, Failure> {
        Ok(match self.integrator {
            Some(IntegratorName::Path) => Integrator::Path,
            Some(IntegratorName::Volpath) => Integrator::VolPath,
            Some(IntegratorName::SingleScattering) => {
                Integrator::SingleScattering(SingleScattering::NextEvent)
            }
            Some(IntegratorName::SingleScatteringClassic) => {
                let step = self.step.map(|step| long_enough(step, world)).transpose()?;
                let step = step.unwrap_or_else(|| integrator::coarse_step(world));
                Integrator::SingleScattering(SingleScattering::Classic(step))
            }
            None => Integrator::fitting(world),
        })
    }
}

/// Samples a pixel where the command line does not say how many.
fn default_samples(file: FileSettings) -> u32 {
    file.samples.unwrap_or(DEFAULT_SAMPLES)
}

/// Steps of this length, if the most that a march takes reach through the world.
fn long_enough(step: f32, world: &World) -> Result<StepSize, Failure> {
    let refuse = |message: String| Failure::Input(format!("--step {step:e}: {message}"));
    let least = world.bounds().diagonal().length() / StepSize::MAX_STEPS as f32;
    if step < least {
        return Err(refuse(format!("expected at least {least:e} in this scene")));
    }
    StepSize::new(step).map_err(|error| refuse(error.to_string()))
}
