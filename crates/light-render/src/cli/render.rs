use light_scene::{record_read_files, recorded_read_files};
use serde_json::Value;

use crate::light_sample_time::light_sample_time;
use crate::live::FileStamps;
use crate::{
    Film, PartialPicture, Progress, SceneDigest, View, Visibility, inventory, render_layers,
    render_while,
};

use super::checkpoint::Checkpoint;
use super::doubts;
use super::failure::Failure;
use super::interrupt::GentleStop;
use super::light_choice::LightChoice;
use super::memory_check::{PICTURE, check_cells_memory, check_memory};
use super::output_image::OutputImage;
use super::prepared_picture::PreparedPicture;
use super::progress::{ProgressLine, Volume};
use super::render_args::RenderArgs;
use super::render_report::RenderReport;
use super::render_settings::FileSettings;
use super::rendered_picture::RenderedPicture;
use super::scene_input::SceneInput;
use super::stdout::{complain, say};
use super::unfinished::Unfinished;

impl RenderArgs {
    /// Renders, and writes the image; with --watch again and again.
    ///
    /// # Errors
    /// Bad input, more memory than there is, or an output that cannot be written.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        record_read_files();
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
        self.input.expect_outputs(&self.output)?;
        self.input.expect_outputs(self.checkpoint.file())?;
        let mut outputs = self.outputs()?;
        let mut picture = self.prepare(stamps)?;
        if self.skip_existing && self.is_there(&picture) {
            return Ok(());
        }
        let checkpoint = self.checkpoint.open(|| picture.identity())?;
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(self.threads)
            .build()
            .map_err(|error| Failure::Input(format!("--threads: {error}")))?;
        let choice = pool.install(|| LightChoice::new(&self.input, &picture))?;
        picture.spend(choice.visibility.time);
        let made = pool.install(|| self.render(&picture, &choice, checkpoint, stamps.as_mut()))?;
        let Some(made) = made else {
            return Ok(());
        };
        let report = self.json.then(|| self.report(&picture, &choice, &made));
        let (made, interrupted) = self.keep_unfinished(&picture, made, &mut outputs)?;
        self.write(&outputs, &picture, made)?;
        if let Some(report) = report {
            say!("{report}")?;
        }
        interrupted.map_or(Ok(()), Err)
    }

    /// Reads the scene, and makes ready all that the picture depends on.
    fn prepare(&self, stamps: &mut Option<FileStamps>) -> Result<PreparedPicture, Failure> {
        let visibility = self.settings.visibility()?;
        if let Some(note) = self.settings.visibility_note().filter(|_| !self.quiet) {
            complain(format_args!("{note}"));
        }
        self.doubt(|| self.settings.step_doubt());
        self.doubt(|| self.settings.light_samples_doubt());
        self.doubt(|| self.settings.estimator_doubt());
        self.doubt(|| self.half_doubt());
        self.checkpoint.expect_place(&self.output)?;
        let scene = self.input.read_lit(self.quiet)?;
        SceneInput::expect_unread(&self.output)?;
        SceneInput::expect_unread(self.checkpoint.file())?;
        if self.live.watch {
            *stamps = Some(FileStamps::of(recorded_read_files()));
        }
        let view = self.view.view(&scene)?;
        self.check_memory(&view, visibility)?;
        let file = FileSettings::of(&scene);
        self.say_samples(file);
        let exposure = scene.camera.and_then(|camera| camera.exposure);
        let digest = SceneDigest::new(&scene).map_err(Failure::input)?;
        let may_be_dark = scene.has_black_lights;
        let world = self.input.build(scene)?;
        if !(may_be_dark || world.has_media()) {
            self.input.expect_light(&world)?;
        }
        self.doubt(|| doubts::of_lamps(&inventory(world.lights())));
        self.doubt(|| self.settings.medium_doubt(&world));
        let settings = self.settings.settings(&world, file)?;
        let layers = self.layers.layers(&self.input, &world, &view, &settings)?;
        Ok(PreparedPicture {
            world,
            view,
            settings,
            sampler: self.settings.light_sampler,
            visibility,
            layers,
            exposure,
            file,
            digest,
        })
    }

    /// Takes the samples, in the current `rayon` pool; `None` if a file of the scene has changed
    /// meanwhile.
    fn render(
        &self,
        picture: &PreparedPicture,
        LightChoice { sampler, .. }: &LightChoice,
        checkpoint: Option<Checkpoint>,
        stamps: Option<&mut FileStamps>,
    ) -> Result<Option<RenderedPicture>, Failure> {
        let PreparedPicture {
            world,
            view,
            settings,
            layers,
            ..
        } = picture;
        let volume = if self.quiet {
            Volume::Quiet
        } else {
            Volume::Normal
        };
        let line = ProgressLine::new(self.input.scene.display().to_string(), volume);
        let show = |p: Progress| line.show(p.done, format!("{} spp", p.samples));
        let stop = self.stops_gently().then(GentleStop::begin);
        let size = view.crop().size();
        let mut watcher = self
            .live
            .watcher(&self.output[0], size, stamps, stop.as_ref())?;
        let mut watch = |progress, film: &Film| {
            show(progress);
            watcher.look(film)
        };
        let (rendering, films) = match (checkpoint, layers) {
            (Some(checkpoint), _) => {
                let whole = checkpoint.render(world, view, sampler, settings, &mut watch)?;
                (whole, Vec::new())
            }
            (None, Some(layers)) => {
                let made = render_layers(world, view, sampler, settings, layers, show);
                (made.whole, made.layers)
            }
            (None, None) => {
                let whole = render_while(world, view, sampler, settings, &mut watch);
                (whole, Vec::new())
            }
        };
        drop(line);
        watcher.finish(&rendering.film);
        if watcher.has_changed() {
            return Ok(None);
        }
        let rejected = rendering.rejected;
        self.doubt(|| (rejected > 0).then(|| format!("{rejected} samples were not finite")));
        self.doubt(|| doubts::of_range(&rendering.film));
        let names = layers.iter().flat_map(|layers| layers.names()).cloned();
        Ok(Some(RenderedPicture {
            layers: names.zip(films.iter().map(Film::develop)).collect(),
            is_stopped: stop.as_ref().is_some_and(GentleStop::is_asked),
            rendering,
        }))
    }

    /// What --json says.
    fn report(
        &self,
        picture: &PreparedPicture,
        choice: &LightChoice,
        made: &RenderedPicture,
    ) -> Value {
        RenderReport {
            scene: &self.input.scene,
            sampler: picture.sampler,
            world: &picture.world,
            rendering: &made.rendering,
            build_ms: choice.build_ms,
            sample_time: light_sample_time(&picture.world, &picture.view, &choice.sampler),
            visibility: &choice.visibility,
        }
        .json()
    }

    /// Keeps the sums of a picture that somebody stopped before its last sample, and says how to
    /// go on. Outputs that are there already, perhaps finished, are taken out of `outputs`.
    fn keep_unfinished(
        &self,
        picture: &PreparedPicture,
        mut made: RenderedPicture,
        outputs: &mut Vec<OutputImage>,
    ) -> Result<(RenderedPicture, Option<Failure>), Failure> {
        let is_whole = made.rendering.film.samples() >= picture.settings.samples.end;
        if !made.is_stopped || is_whole {
            return Ok((made, None));
        }
        let mut old = self.output.clone();
        old.retain(|path| path.is_file());
        outputs.retain(|output| !old.iter().any(|path| path == output.path()));
        let unfinished = Unfinished {
            outputs: &self.output,
            old: &old,
            wanted: self.settings.wanted_samples(picture.file),
            checkpoint: self.checkpoint.path(),
        };
        let kept = unfinished.keep(made.rendering.film, || picture.identity())?;
        made.rendering.film = kept.0;
        Ok((made, Some(kept.1)))
    }

    /// Whether Ctrl-C lets the rendering end with what there is: not where a part of a picture or
    /// layers are wanted, which nothing could go on from.
    fn stops_gently(&self) -> bool {
        self.settings.samples.is_none() && !self.layers.is_wanted()
    }

    /// Says how many samples a pixel has, if the file of the scene decides it.
    fn say_samples(&self, file: FileSettings) {
        let samples = self.settings.samples_of_file(file).filter(|_| !self.quiet);
        if let Some(samples) = samples {
            let scene = self.input.scene.display();
            complain(format_args!(
                "{samples} samples a pixel, as {scene} asks for (--spp sets another number)"
            ));
        }
    }

    /// Says what is strange about the picture, if something is.
    pub(super) fn doubt(&self, words: impl FnOnce() -> Option<String>) {
        if self.quiet {
            return;
        }
        if let Some(words) = words() {
            complain(format_args!("warning: {words}"));
        }
    }

    /// Whether all outputs hold the samples of this picture, undamaged.
    fn is_there(&self, picture: &PreparedPicture) -> bool {
        let identity = picture.identity();
        let samples = &picture.settings.samples;
        self.output.iter().all(|path| {
            let part = PartialPicture::read(path);
            part.is_ok_and(|part| part.samples == *samples && part.expect(&identity).is_ok())
        })
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
        if visibility != Visibility::Cells {
            return Ok(());
        }
        let (width, height) = view.resolution();
        check_cells_memory(width, height)
    }
}
