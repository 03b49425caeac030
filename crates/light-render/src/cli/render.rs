use core::num::NonZeroU32;
use core::ops::Range;
use core::time::Duration;
use std::path::PathBuf;
use std::time::Instant;

use clap::{Args, ValueEnum};
use light_render::integrator::{self, Integrator, PathSettings, SingleScattering};
use light_render::{
    AnyLightSampler, PartialPicture, Progress, RenderSettings, Rendering, SamplerKind, ToneMap,
    View, World, light_sample_time, render,
};
use light_scene::{Diagnostic, Image};
use lights::media::StepSize;
use serde_json::json;

use super::arguments::{positive, sample_range};
use super::checkpoint::CheckpointArgs;
use super::failure::Failure;
use super::output_image::{OutputImage, Precision};
use super::progress::{ProgressLine, Volume};
use super::scene_input::{SceneInput, report_warnings};
use super::view_args::ViewArgs;

/// Render a scene into an image.
#[derive(Args, Debug)]
#[command(allow_negative_numbers = true)]
pub(crate) struct RenderArgs {
    #[command(flatten)]
    input: SceneInput,
    /// The image to write: .exr (float32 linear RGB) or .png; more than once for more than one.
    #[arg(short, long, value_name = "IMAGE", required = true)]
    output: Vec<PathBuf>,
    /// Write .exr files of half floats.
    #[arg(long)]
    half: bool,
    /// Samples a pixel; without it 64, or as many as fit into --time.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    spp: Option<u32>,
    /// Render these samples alone, into an .exr that `lights merge` adds to others.
    #[arg(long, value_name = "A..B", value_parser = sample_range, conflicts_with = "spp")]
    samples: Option<Range<u32>>,
    /// Stop at this budget.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    time: Option<f32>,
    /// Segments of the longest path: 1 = emitters seen directly, 2 = plus direct light.
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..))]
    max_depth: u32,
    /// What scatters light: surfaces alone (path), or media as well (volpath), or either once (single-scattering, with
    /// lights for the ray as a whole, and -classic, in steps); without it volpath where the scene has media, else path.
    #[arg(long, value_enum)]
    integrator: Option<IntegratorName>,
    /// Length of the steps of single-scattering-classic; without it a hundredth of the scene.
    #[arg(long, value_name = "LENGTH", value_parser = positive)]
    step: Option<f32>,
    /// Same seed, same image.
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
    /// Threads; 0 = one a core.
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    /// How lights are chosen.
    #[arg(long, value_name = "SAMPLER", default_value_t = SamplerKind::DEFAULT)]
    light_sampler: SamplerKind,
    /// How many lights are chosen at the first diffuse point of a path.
    #[arg(long, value_name = "N", default_value_t = PathSettings::DEFAULT_LIGHT_SAMPLES)]
    light_samples: NonZeroU32,
    /// How light is found: by light samples, by material samples, or by both, weighted.
    #[arg(long, value_enum, default_value_t = Estimator::Mis)]
    estimator: Estimator,
    #[command(flatten)]
    view: ViewArgs,
    #[command(flatten)]
    checkpoint: CheckpointArgs,
    /// Print one line of JSON about the rendering.
    #[arg(long)]
    json: bool,
    /// Print nothing but results: no progress, no warnings.
    #[arg(long)]
    quiet: bool,
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

impl RenderArgs {
    /// Renders, and writes the image.
    ///
    /// # Errors
    /// Bad input, or an output that cannot be written.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let outputs = self.outputs()?;
        let scene = self.input.read()?;
        if !self.quiet {
            report_warnings(&scene.warnings);
        }
        let view = self.view.view(&scene)?;
        let exposure = scene.camera.and_then(|camera| camera.exposure);
        let world = self.input.build(scene)?;
        if world.lights().is_empty() && !world.has_media() {
            let nothing = "no light in the scene: expected a material with Ke, or --env IMAGE";
            return Err(Failure::input(Diagnostic::file(&self.input.scene, nothing)));
        }
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(self.threads)
            .build()
            .map_err(Failure::input)?;
        let start = Instant::now();
        let sampler = pool
            .install(|| AnyLightSampler::new(self.light_sampler, world.lights()))
            .map_err(Failure::input)?;
        let build_ms = start.elapsed().as_secs_f64() * 1e3;
        let volume = if self.quiet {
            Volume::Quiet
        } else {
            Volume::Normal
        };
        let line = ProgressLine::new(self.input.scene.display().to_string(), volume);
        let show = |p: Progress| line.show(p.done, format!("{} spp", p.samples));
        let settings = self.settings(&world);
        let rendering =
            pool.install(
                || match self.checkpoint.open(|| self.subject(&world, &view))? {
                    Some(checkpoint) => checkpoint.render(&world, &view, &sampler, &settings, show),
                    None => Ok(render(&world, &view, &sampler, &settings, show)),
                },
            )?;
        drop(line);
        if rendering.rejected > 0 && !self.quiet {
            eprintln!(
                "lights: warning: {} samples were not finite",
                rendering.rejected
            );
        }
        self.write(&outputs, &world, &view, &rendering, exposure)?;
        if self.json {
            let sample_ns = light_sample_time(&world, &view, &sampler);
            println!("{}", self.report(&world, &rendering, build_ms, sample_ns));
        }
        Ok(())
    }

    /// The files to write, all of them tried.
    fn outputs(&self) -> Result<Vec<OutputImage>, Failure> {
        let precision = if self.half {
            Precision::Half
        } else {
            Precision::Single
        };
        let open = |path: &PathBuf| {
            let output = OutputImage::new(path, precision)?;
            if self.samples.is_some() {
                output.expect_part()?;
            }
            Ok(output)
        };
        self.output.iter().map(open).collect()
    }

    /// Writes the picture, or the part of it that was asked for.
    fn write(
        &self,
        outputs: &[OutputImage],
        world: &World,
        view: &View,
        rendering: &Rendering,
        exposure: Option<f32>,
    ) -> Result<(), Failure> {
        let film = &rendering.film;
        if let Some(Range { start, .. }) = self.samples {
            let part = PartialPicture {
                film: film.clone(),
                samples: start..start + film.samples(),
                subject: self.subject(world, view),
            };
            return outputs
                .iter()
                .try_for_each(|output| output.write_part(&part));
        }
        let (width, height) = film.resolution();
        let image = Image::new(width, height, film.develop()).map_err(Failure::input)?;
        let fit = || ToneMap::fit(image.texels());
        let tone_map = exposure.map_or_else(fit, ToneMap::new);
        outputs
            .iter()
            .try_for_each(|output| output.write(&image, &tone_map))
    }

    /// All that decides what the picture is, but the samples.
    fn subject(&self, world: &World, view: &View) -> String {
        let name = self.input.scene.file_name().unwrap_or_default();
        let RenderSettings { seed, path, .. } = self.settings(world);
        format!(
            "{} with {} triangles and {} lights within {:?}, seed {seed}, {path:?}, {}, {view:?}",
            name.to_string_lossy(),
            world.triangle_count(),
            world.lights().len(),
            world.bounds(),
            self.light_sampler,
        )
    }

    fn integrator(&self, world: &World) -> Integrator {
        match self.integrator {
            Some(IntegratorName::Path) => Integrator::Path,
            Some(IntegratorName::Volpath) => Integrator::VolPath,
            Some(IntegratorName::SingleScattering) => {
                Integrator::SingleScattering(SingleScattering::NextEvent)
            }
            Some(IntegratorName::SingleScatteringClassic) => {
                let step = self.step.and_then(|step| StepSize::new(step).ok());
                let step = step.unwrap_or_else(|| integrator::coarse_step(world));
                Integrator::SingleScattering(SingleScattering::Classic(step))
            }
            None => Integrator::fitting(world),
        }
    }

    fn settings(&self, world: &World) -> RenderSettings {
        let samples = match (&self.samples, self.spp, self.time) {
            (Some(samples), _, _) => samples.clone(),
            (None, Some(spp), _) => 0..spp,
            (None, None, Some(_)) => 0..u32::MAX,
            (None, None, None) => 0..64,
        };
        RenderSettings {
            samples,
            time_limit: self.time.map(Duration::from_secs_f32),
            seed: self.seed,
            path: PathSettings {
                max_depth: self.max_depth,
                estimator: match self.estimator {
                    Estimator::Mis => integrator::Estimator::Mis,
                    Estimator::Light => integrator::Estimator::Light,
                    Estimator::Bsdf => integrator::Estimator::Bsdf,
                },
                light_samples: self.light_samples,
                integrator: self.integrator(world),
            },
        }
    }

    fn report(
        &self,
        world: &World,
        rendering: &Rendering,
        build_ms: f64,
        sample_time: Option<Duration>,
    ) -> serde_json::Value {
        json!({
            "scene": self.input.scene.display().to_string(),
            "sampler": self.light_sampler.name(),
            "seconds": rendering.elapsed.as_secs_f64(),
            "spp": rendering.film.samples(),
            "lights": world.lights().len(),
            "triangles": world.triangle_count(),
            "tree_build_ms": build_ms,
            "ns_per_light_sample": sample_time.map(|time| time.as_secs_f64() * 1e9),
            "rays": rendering.rays,
        })
    }
}
