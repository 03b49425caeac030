use core::cell::RefCell;
use core::slice::from_ref;
use core::time::Duration;
use std::path::{Path, PathBuf};

use clap::Args;
use light_scene::{Crop, Diagnostic, read_signed_image, record_read_files, write_atomically};

use crate::integrator::{Estimator, Integrator, PathSettings};
use crate::report::{Reference, ReferenceSource, ReportOptions, SceneReport};
use crate::{AnyLightSamplerError, Film, SamplerKind, ToneMap, View, World};

use super::arguments::{pixel, seconds, threads};
use super::failure::Failure;
use super::memory_check::{PICTURE, check_memory};
use super::output_file::{expect_another, expect_ending, expect_writable};
use super::progress::{ProgressLine, Volume};
use super::sampler_list::samplers;
use super::scene_input::SceneInput;
use super::stdout::{complain, say};
use super::view_args::ViewArgs;
use super::whole::whole;

/// The longer side of pictures, unless their size is asked for.
const SIDE: u32 = 320;

/// Above so many lights the exhaustive sampler takes part only where it is asked for.
const MOST_EXHAUSTIVE: usize = 4096;

/// How much longer than a picture the reference takes.
const REFERENCE_TIMES: u32 = 8;

/// Pictures that are held while the page is made: stages of each sampler, errors, and the page.
const PICTURES: u64 = 32;

/// Compare light samplers on a scene, in one self-contained HTML page: pictures and errors at equal
/// time, convergence, variance at pixels, time, memory and lost light.
#[derive(Args, Debug)]
#[command(allow_negative_numbers = true)]
pub(crate) struct ReportArgs {
    #[command(flatten)]
    input: SceneInput,
    /// The page to write: .html or .htm.
    #[arg(short, long, value_name = "PAGE.html")]
    output: PathBuf,
    /// Time for each picture, the building of its sampler included.
    #[arg(long, value_name = "SECONDS", value_parser = seconds, default_value = "5")]
    time: Duration,
    /// What pictures should be, of the same size; without it a reference is rendered.
    #[arg(long, value_name = "IMAGE")]
    reference: Option<PathBuf>,
    /// Time for the reference; without it eight times that of a picture.
    #[arg(long, value_name = "SECONDS", value_parser = seconds, conflicts_with = "reference")]
    reference_time: Option<Duration>,
    /// Samplers to compare, with commas between; without it all, but the exhaustive one only up to
    /// 4096 lights.
    #[arg(long, value_name = "LIST")]
    samplers: Option<String>,
    /// Show the variance at this pixel; may be repeated. Without it at six pixels.
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    pixel: Vec<[u32; 2]>,
    /// Segments of the longest path: 1 = emitters seen directly, 2 = plus direct light.
    #[arg(
        long,
        value_name = "N",
        default_value_t = 8,
        value_parser = whole(1..=u32::MAX)
    )]
    max_depth: u32,
    /// Chooses the random numbers.
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
    /// Threads, at most 1024; 0 = one a core.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = threads)]
    threads: usize,
    #[command(flatten)]
    view: ViewArgs,
    /// Print one line of JSON with the numbers of the page.
    #[arg(long)]
    json: bool,
    /// Print nothing but results: no progress, no warnings.
    #[arg(long, short)]
    quiet: bool,
}

impl ReportArgs {
    /// Renders, measures and writes the page.
    ///
    /// # Errors
    /// Bad input, a reference of another size, or a page that cannot be written.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        self.expect_output()?;
        let wanted = self.samplers.as_deref().map(samplers).transpose()?;
        record_read_files();
        let scene = self.input.read_lit(self.quiet)?;
        SceneInput::expect_unread(from_ref(&self.output))?;
        let warnings: Vec<String> = scene.warnings.iter().map(ToString::to_string).collect();
        let view = match self.reference {
            Some(_) => self.view.view(&scene)?,
            None => self.view.at_most(&scene, SIDE).view(&scene)?,
        };
        self.expect_pixels(&view)?;
        let exposure = scene.camera.and_then(|camera| camera.exposure);
        let given = self.given_reference(&view)?;
        let (width, height) = view.crop().size();
        let pixels = u64::from(width) * u64::from(height);
        let what = format!("pictures of {width} x {height} pixels (--width, --height)");
        check_memory(&what, pixels * (PICTURE + Film::BYTES_PER_PIXEL) * PICTURES)?;
        let world = self.input.build(scene)?;
        self.input.expect_light(&world)?;
        self.input.expect_few_lights(&world, "report")?;
        let options = self.options(&world, wanted, warnings);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(self.threads)
            .build()
            .map_err(|error| Failure::Input(format!("--threads: {error}")))?;
        let report = pool.install(|| self.measure(&world, &view, given, options));
        let report = report.map_err(|error| self.input.refuse_choice(&error))?;
        if !self.quiet {
            let left_out = report.pixels_left_out();
            left_out
                .iter()
                .for_each(|words| complain(format_args!("{words}")));
        }
        let fit = || ToneMap::fit(&report.reference().pixels);
        let tone_map = exposure.map_or_else(fit, ToneMap::new);
        let page = report
            .page(&self.output, &tone_map)
            .map_err(Failure::input)?;
        write_atomically(&self.output, page.as_bytes()).map_err(Failure::input)?;
        if self.json {
            return say!("{}", report.json());
        }
        say!("{}", report.table().trim_end())?;
        say!("The page is {}.", self.output.display())
    }

    /// Makes sure that the page can be written as one, and is none of the inputs.
    fn expect_output(&self) -> Result<(), Failure> {
        self.input.expect_outputs(from_ref(&self.output))?;
        expect_another(&self.output, self.reference.as_slice(), "the --reference")?;
        expect_ending(&self.output, &["html", "htm"])?;
        expect_writable(&self.output)
    }

    /// Makes sure that the picture has each --pixel.
    fn expect_pixels(&self, view: &View) -> Result<(), Failure> {
        let Crop { min, max } = view.crop();
        let is_in = |pixel: &[u32; 2]| (0..2).all(|k| (min[k]..max[k]).contains(&pixel[k]));
        let Some([x, y]) = self.pixel.iter().find(|pixel| !is_in(pixel)) else {
            return Ok(());
        };
        Err(Failure::Input(format!(
            "--pixel {x},{y}: expected a pixel of the picture, X from {} to {} and Y from {} to {}",
            min[0],
            max[0] - 1,
            min[1],
            max[1] - 1
        )))
    }

    fn given_reference(&self, view: &View) -> Result<Option<Reference>, Failure> {
        let Some(path) = &self.reference else {
            return Ok(None);
        };
        let image = read_signed_image(path).map_err(Failure::input)?.image;
        let (width, height) = view.crop().size();
        if (image.width(), image.height()) != (width, height) {
            let message = format!(
                "is {} x {}, expected {width} x {height} as the picture (--width, --height)",
                image.width(),
                image.height()
            );
            return Err(Failure::input(Diagnostic::file(path, message)));
        }
        Ok(Some(Reference {
            pixels: image.texels().to_vec(),
            source: ReferenceSource::Given(path.clone()),
        }))
    }

    fn options(
        &self,
        world: &World,
        wanted: Option<Vec<SamplerKind>>,
        mut notes: Vec<String>,
    ) -> ReportOptions {
        let lights = world.lights().len();
        let all = || {
            let is_in =
                |kind: &SamplerKind| *kind != SamplerKind::Exhaustive || lights <= MOST_EXHAUSTIVE;
            SamplerKind::ALL.into_iter().filter(is_in).collect()
        };
        if wanted.is_none() && lights > MOST_EXHAUSTIVE {
            notes.push(format!(
                "The exhaustive sampler looks at all {lights} lights for each choice; it takes \
                 part only where it is named."
            ));
        }
        ReportOptions {
            scene: name(&self.input.scene),
            samplers: wanted.unwrap_or_else(all),
            time: self.time,
            path: PathSettings {
                max_depth: self.max_depth,
                estimator: Estimator::Mis,
                light_samples: PathSettings::DEFAULT_LIGHT_SAMPLES,
                integrator: Integrator::fitting(world),
            },
            seed: self.seed,
            pixels: self.pixel.clone(),
            notes,
        }
    }

    fn measure(
        &self,
        world: &World,
        view: &View,
        given: Option<Reference>,
        options: ReportOptions,
    ) -> Result<SceneReport, AnyLightSamplerError> {
        let progress = Stages::new(if self.quiet {
            Volume::Quiet
        } else {
            Volume::Normal
        });
        let reference = match given {
            Some(reference) => reference,
            None => {
                let default = self.time.saturating_mul(REFERENCE_TIMES);
                let time = self.reference_time.unwrap_or(default);
                let show = |share, samples| progress.show("reference", share, samples);
                Reference::make((world, view), &options.path, self.seed, time, show)?
            }
        };
        let show = |stage: &str, share, samples| progress.show(stage, share, samples);
        SceneReport::measure((world, view), reference, options, show)
    }
}

/// One line of progress for each stage.
struct Stages {
    volume: Volume,
    line: RefCell<Option<(String, ProgressLine)>>,
}

impl Stages {
    const fn new(volume: Volume) -> Self {
        Self {
            volume,
            line: RefCell::new(None),
        }
    }

    fn show(&self, stage: &str, share: f64, samples: u32) {
        let mut line = self.line.borrow_mut();
        if line.as_ref().is_none_or(|(name, _)| name != stage) {
            *line = Some((stage.to_owned(), ProgressLine::new(stage, self.volume)));
        }
        if let Some((_, line)) = &*line {
            let message = match samples {
                0 => String::new(),
                samples => format!("{samples} spp"),
            };
            line.show(share, message);
        }
    }
}

/// The name of a scene without folder and ending.
fn name(path: &Path) -> String {
    path.file_stem()
        .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
}
