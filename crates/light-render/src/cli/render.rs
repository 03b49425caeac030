use std::path::PathBuf;
use std::time::Instant;

use light_scene::{Image, record_read_files, recorded_read_files};
use lights::glam::Vec3;

use crate::light_sample_time::light_sample_time;
use crate::live::FileStamps;
use crate::{
    AnyLightSampler, Film, PartialPicture, PictureIdentity, Progress, RenderSettings, SceneDigest,
    View, Visibility, inventory, render_layers, render_while,
};

use super::doubts;
use super::failure::Failure;
use super::interrupt::GentleStop;
use super::memory_check::{PICTURE, check_cells_memory, check_memory};
use super::output_image::{OutputImage, Precision};
use super::progress::{ProgressLine, Volume};
use super::render_args::RenderArgs;
use super::render_report::RenderReport;
use super::stdout::{complain, say};
use super::unfinished::Unfinished;
use super::visibility::with_cells;

impl RenderArgs {
    /// Renders, and writes the image; with --watch again and again.
    ///
    /// # Errors
    /// Bad input, more memory than there is, or an output that cannot be written.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        if !self.live.watch {
            return self.run_once(&mut None);
        }
        let mut rendered = false;
        loop {
            record_read_files();
            let mut stamps = None;
            match self.run_once(&mut stamps) {
                Ok(()) => rendered = true,
                Err(Failure::Input(message)) if rendered => complain(format_args!("{message}")),
                Err(failure) => return Err(failure),
            }
            let stamps = stamps.unwrap_or_else(|| FileStamps::of(recorded_read_files()));
            if let Some(path) = stamps.wait(|| false)
                && !self.quiet
            {
                complain(format_args!("{} has changed", path.display()));
            }
        }
    }

    /// Renders, and writes the image. With --watch, `stamps` become those of the files of the
    /// scene, and nothing is written if one changes meanwhile.
    fn run_once(&self, stamps: &mut Option<FileStamps>) -> Result<(), Failure> {
        let outputs = self.outputs()?;
        let visibility = self.settings.visibility()?;
        self.checkpoint.expect_place(&self.output)?;
        let scene = self.input.read_lit(self.quiet)?;
        if self.live.watch {
            *stamps = Some(FileStamps::of(recorded_read_files()));
        }
        let view = self.view.view(&scene)?;
        self.check_memory(&view, visibility)?;
        let file_depth = scene.max_depth;
        let exposure = scene.camera.and_then(|camera| camera.exposure);
        let digest = (self.keeps_sums() || self.stops_gently()).then(|| SceneDigest::new(&scene));
        let digest = digest.transpose().map_err(Failure::input)?;
        let world = self.input.build(scene)?;
        if !world.has_media() {
            self.input.expect_light(&world)?;
        }
        self.doubt(|| doubts::of_lamps(&inventory(world.lights())));
        let settings = self.settings.settings(&world, file_depth)?;
        let layers = self.layers.layers(&self.input, &world, &view, &settings)?;
        let sampler_kind = self.settings.light_sampler;
        let identity =
            digest.map(|digest| digest.identity(&view, &settings, sampler_kind, visibility));
        let identity = identity.unwrap_or_default();
        if self.skip_existing && self.is_there(&identity, &settings) {
            return Ok(());
        }
        let checkpoint = self.checkpoint.open(&identity)?;
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(self.threads)
            .build()
            .map_err(|error| Failure::Input(format!("--threads: {error}")))?;
        let start = Instant::now();
        let sampler = pool
            .install(|| AnyLightSampler::new(sampler_kind, world.lights()))
            .map_err(Failure::input)?;
        let build_ms = start.elapsed().as_secs_f64() * 1e3;
        let (sampler, cells) = pool.install(|| with_cells(sampler, visibility, &world, &view))?;
        let volume = if self.quiet {
            Volume::Quiet
        } else {
            Volume::Normal
        };
        let line = ProgressLine::new(self.input.scene.display().to_string(), volume);
        let show = |p: Progress| line.show(p.done, format!("{} spp", p.samples));
        let stop = self.stops_gently().then(GentleStop::begin);
        let size = view.crop().size();
        let mut watcher =
            self.live
                .watcher(&self.output[0], size, stamps.as_mut(), stop.as_ref())?;
        let mut watch = |progress, film: &Film| {
            show(progress);
            watcher.look(film)
        };
        let (rendering, films) = pool.install(|| match (checkpoint, &layers) {
            (Some(checkpoint), _) => {
                let whole = checkpoint.render(&world, &view, &sampler, &settings, &mut watch)?;
                Ok((whole, Vec::new()))
            }
            (None, Some(layers)) => {
                let made = render_layers(&world, &view, &sampler, &settings, layers, show);
                Ok((made.whole, made.layers))
            }
            (None, None) => {
                let whole = render_while(&world, &view, &sampler, &settings, &mut watch);
                Ok::<_, Failure>((whole, Vec::new()))
            }
        })?;
        drop(line);
        watcher.finish(&rendering.film);
        if watcher.has_changed() {
            return Ok(());
        }
        let names = layers.iter().flat_map(|layers| layers.names()).cloned();
        let layers: Vec<_> = names.zip(films.iter().map(Film::develop)).collect();
        drop(films);
        if rendering.rejected > 0 && !self.quiet {
            complain(format_args!(
                "warning: {} samples were not finite",
                rendering.rejected
            ));
        }
        let report = self.json.then(|| {
            let sample_time = light_sample_time(&world, &view, &sampler);
            RenderReport {
                scene: &self.input.scene,
                sampler: sampler_kind,
                world: &world,
                rendering: &rendering,
                build_ms,
                sample_time,
                cells: &cells,
            }
            .json()
        });
        let is_stopped = stop.as_ref().is_some_and(GentleStop::is_asked);
        drop(stop);
        let mut film = rendering.film;
        let mut interrupted = None;
        if is_stopped && film.samples() < settings.samples.end {
            let (kept, failure) = self.unfinished().keep(film, identity.clone())?;
            (film, interrupted) = (kept, Some(failure));
        }
        self.write(&outputs, &settings, identity, (film, layers), exposure)?;
        if let Some(report) = report {
            say!("{report}")?;
        }
        interrupted.map_or(Ok(()), Err)
    }

    /// Whether Ctrl-C lets the rendering end with what there is: not where a part of a picture or
    /// layers are wanted, which nothing could go on from.
    fn stops_gently(&self) -> bool {
        self.settings.samples.is_none() && !self.layers.is_wanted()
    }

    fn unfinished(&self) -> Unfinished<'_> {
        Unfinished {
            output: &self.output[0],
            wanted: self.settings.wanted_samples(),
            checkpoint: self.checkpoint.path(),
        }
    }

    /// Says what is strange about the picture, if something is.
    fn doubt(&self, words: impl FnOnce() -> Option<String>) {
        if self.quiet {
            return;
        }
        if let Some(words) = words() {
            complain(format_args!("warning: {words}"));
        }
    }

    /// Whether all outputs hold the samples of `settings` of this picture, undamaged.
    fn is_there(&self, identity: &PictureIdentity, settings: &RenderSettings) -> bool {
        self.output.iter().all(|path| {
            let part = PartialPicture::read(path);
            part.is_ok_and(|part| part.samples == settings.samples && part.expect(identity).is_ok())
        })
    }

    /// Whether files will hold exact sums, and say of which picture.
    fn keeps_sums(&self) -> bool {
        self.settings.samples.is_some() || self.checkpoint.is_wanted()
    }

    /// Makes sure that the picture fits into memory.
    fn check_memory(&self, view: &View, visibility: Visibility) -> Result<(), Failure> {
        let sums = if self.checkpoint.is_wanted() {
            2 * Film::BYTES_PER_PIXEL + PartialPicture::FILE_BYTES_PER_PIXEL
        } else if self.settings.samples.is_some() {
            Film::BYTES_PER_PIXEL + PartialPicture::FILE_BYTES_PER_PIXEL
        } else {
            0
        };
        let (width, height) = view.crop().size();
        let pixels = u64::from(width) * u64::from(height);
        let what = format!("a picture of {width} x {height} pixels (--width, --height)");
        check_memory(&what, pixels * PICTURE.max(sums))?;
        if visibility == Visibility::Off {
            return Ok(());
        }
        let (width, height) = view.resolution();
        check_cells_memory(width, height)
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
            if self.settings.samples.is_some() {
                output.expect_part()?;
            }
            Ok(output)
        };
        let outputs: Vec<OutputImage> = self.output.iter().map(open).collect::<Result<_, _>>()?;
        if self.layers.is_wanted() && !outputs.iter().any(OutputImage::has_layers) {
            let message = "--aov: expected an .exr file to write, which holds the layers";
            return Err(Failure::Input(message.into()));
        }
        Ok(outputs)
    }

    /// Writes the picture, or the requested part of it.
    fn write(
        &self,
        outputs: &[OutputImage],
        settings: &RenderSettings,
        identity: PictureIdentity,
        (film, layers): (Film, Vec<(String, Vec<Vec3>)>),
        exposure: Option<f32>,
    ) -> Result<(), Failure> {
        if self.settings.samples.is_some() {
            let start = settings.samples.start;
            let part = PartialPicture {
                samples: start..start + film.samples(),
                film,
                identity,
            };
            return outputs
                .iter()
                .try_for_each(|output| output.write_part(&part));
        }
        let (width, height) = film.resolution();
        let image = Image::new(width, height, film.develop()).map_err(Failure::input)?;
        drop(film);
        let tone_map = self.display.tone_map(&image, exposure);
        let is_shown = outputs.iter().any(|output| !output.has_layers());
        self.doubt(|| {
            let shown = || is_shown.then(|| doubts::of_shown(&image, &tone_map))?;
            doubts::of_black(&image).or_else(shown)
        });
        outputs.iter().try_for_each(|output| match &layers[..] {
            [] => output.write(&image, &tone_map),
            layers => output.write_layers(&image, layers, &tone_map),
        })
    }
}
