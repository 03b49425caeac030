use core::num::NonZeroU32;
use std::fs;
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{ArgMatches, Args, Command};
use light_scene::write_atomically;

use crate::farm::{
    FarmEngine, FarmFrames, FarmPlan, FarmPlanError, FrameNumbers, is_job_file, job_file_names,
};

use super::arguments::count;
use super::failure::Failure;
use super::output_file::{make_folder, refuse};
use super::render_settings::{FileSettings, SettingsArgs};
use super::scene_input::SceneInput;
use super::stdout::{complain, say};
use super::view_args::ViewArgs;

/// Write a job for a render farm: parts of a picture, or of each frame of an animation, and a merge
/// that waits for them.
///
/// Takes the flags of `lights render`. All machines see the folder and the scene under the same
/// paths, and find the program as $LIGHTS or on their path.
#[derive(Args, Debug)]
#[command(allow_negative_numbers = true)]
pub(crate) struct FarmArgs {
    #[command(flatten)]
    input: SceneInput,
    /// The folder to write the job into, in place of an older job; its parts and the picture,
    /// picture.exr, come there too.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// The first and the last frame of an animation, A-B: a run of # in SCENE, as in
    /// shot.####.pbrt, stands for the number, and each frame is a picture of its own.
    #[arg(long, value_name = "A-B")]
    frames: Option<FrameNumbers>,
    /// How many parts of each picture, at most one a sample.
    #[arg(long, value_name = "N", value_parser = count)]
    parts: NonZeroU32,
    /// What runs the job: slurm, hyperqueue, or openjd.
    #[arg(long, value_name = "ENGINE")]
    engine: FarmEngine,
    /// Threads of a part; without it each has a machine for itself.
    #[arg(long, value_name = "N", value_parser = count)]
    threads: Option<NonZeroU32>,
    #[command(flatten)]
    settings: SettingsArgs,
    #[command(flatten)]
    view: ViewArgs,
}

impl FarmArgs {
    /// Reads each scene, so that what is wrong with it is found here and not on every machine, and
    /// writes the job. `typed` are the arguments as they were typed.
    ///
    /// # Errors
    /// A scene that cannot be read, a part without samples, or a folder that cannot be written to.
    pub(crate) fn run(&self, typed: &ArgMatches) -> Result<(), Failure> {
        self.settings.visibility()?;
        if let Some(note) = self.settings.visibility_note() {
            complain(format_args!("{note}"));
        }
        let frames = self.frames()?;
        let samples = match &frames {
            None => self.samples(&self.input)?,
            Some(frames) => self.samples_of_frames(frames)?,
        };
        let folder = absolute(&self.output)?;
        let here = absolute(Path::new("."))?;
        let name = self.input.scene.file_stem().unwrap_or_default();
        let plan = FarmPlan::new(
            name.to_string_lossy(),
            [folder.clone(), here],
            render_words(typed)?,
            (samples, self.parts),
            self.threads,
        )
        .map_err(|error| match error {
            FarmPlanError::TooManyParts { .. } => {
                Failure::Input(format!("--parts {}: {error}", self.parts))
            }
            error => Failure::Input(format!("farm: {error}")),
        })?;
        let (plan, pictures) = match frames {
            None => (plan, "picture.exr".into()),
            Some(frames) => {
                let pictures = format!("picture.*.exr of the frames {frames}");
                (plan.with_frames(frames), pictures)
            }
        };
        make_folder(&self.output)?;
        self.write(&self.engine.files(&plan))?;
        let file = format!("{folder}/{}", self.engine.file());
        say!(
            "{} parts; `{}` makes {folder}/{pictures}",
            plan.parts(),
            self.engine.submit(&file)
        )
    }
}

impl FarmArgs {
    /// Writes the files of the job in place of those of an older job. Files that are of no job stay.
    fn write(&self, files: &[(&'static str, String)]) -> Result<(), Failure> {
        let path = |name: &str| self.output.join(name);
        let is_of_job = |name: &str| fs::read(path(name)).map(|text| is_job_file(name, &text));
        for (name, _) in files {
            if path(name).exists() && !is_of_job(name).unwrap_or(false) {
                let message = "was not written by `lights farm`: expected another folder";
                return Err(refuse(&path(name), message));
            }
        }
        for (name, text) in files {
            write_atomically(&path(name), text.as_bytes()).map_err(Failure::input)?;
        }
        let is_new = |name: &&str| files.iter().any(|(new, _)| new == name);
        for name in job_file_names().filter(|name| !is_new(name)) {
            if is_of_job(name).unwrap_or(false) {
                let removed = fs::remove_file(path(name));
                removed.map_err(|e| refuse(&path(name), format!("cannot be removed: {e}")))?;
            }
        }
        Ok(())
    }

    /// The frames of an animation, if that is asked for.
    fn frames(&self) -> Result<Option<FarmFrames>, Failure> {
        let Some(numbers) = self.frames.clone() else {
            return Ok(None);
        };
        let scene = &self.input.scene;
        let frames = FarmFrames::new(numbers, text(scene)?);
        let wanted = "--frames: expected a run of # for the number, as in shot.####.pbrt";
        frames.map(Some).ok_or_else(|| refuse(scene, wanted))
    }

    /// Samples a pixel of a scene, which is read.
    fn samples(&self, input: &SceneInput) -> Result<u32, Failure> {
        let scene = input.read()?;
        self.view.view(&scene)?;
        let file = FileSettings::of(&scene);
        self.settings.samples_of_whole("farm", file)
    }

    /// Samples a pixel of all frames.
    fn samples_of_frames(&self, frames: &FarmFrames) -> Result<u32, Failure> {
        let mut all = None;
        for frame in frames.numbers() {
            let input = SceneInput {
                scene: frames.scene(frame).into(),
                changes: self.input.changes.clone(),
            };
            let samples = self.samples(&input)?;
            let first = *all.get_or_insert(samples);
            if samples != first {
                let message = format!(
                    "--frames: expected {first} samples a pixel as the first frame has, found \
                     {samples}; --spp sets them for all"
                );
                return Err(refuse(&input.scene, message));
            }
        }
        Ok(all.unwrap_or_default())
    }
}

/// What `lights render` has to be told to make the picture, of what `lights farm` was: all but the
/// samples and where to write.
fn render_words(typed: &ArgMatches) -> Result<Vec<String>, Failure> {
    let flags = SettingsArgs::augment_args(Command::new("render"));
    let flags = ViewArgs::augment_args(SceneInput::augment_args(flags));
    let mut words = Vec::new();
    for flag in flags.get_arguments() {
        let id = flag.get_id().as_str();
        if id == "spp" || typed.value_source(id) != Some(ValueSource::CommandLine) {
            continue;
        }
        let takes_values = flag.get_action().takes_values();
        for value in typed.get_raw(id).into_iter().flatten() {
            words.extend(flag.get_long().map(|name| format!("--{name}")));
            if takes_values {
                words.push(text(Path::new(value))?);
            }
        }
    }
    Ok(words)
}

/// The path of a folder from the root.
fn absolute(path: &Path) -> Result<String, Failure> {
    let path = std::path::absolute(path).map_err(|error| refuse(path, error.to_string()))?;
    text(&path)
}

/// A word for a script.
fn text(path: &Path) -> Result<String, Failure> {
    let text = path.to_str().map(str::to_owned);
    text.ok_or_else(|| refuse(path, "expected a name that is text (UTF-8)"))
}
