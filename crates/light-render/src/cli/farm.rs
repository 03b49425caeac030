use core::num::NonZeroU32;
use std::fs;
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{ArgMatches, Args, Command};
use light_scene::write_atomically;

use crate::farm::{FarmEngine, FarmPlan};

use super::failure::Failure;
use super::output_file::refuse;
use super::render_settings::{FileSettings, SettingsArgs};
use super::scene_input::SceneInput;
use super::stdout::say;
use super::view_args::ViewArgs;

/// Write a job for a render farm: parts of a picture, and a merge that waits for them.
///
/// Takes the flags of `lights render`. All machines see the folder and the scene under the same
/// paths, and find the program as $LIGHTS or on their path.
#[derive(Args, Debug)]
#[command(allow_negative_numbers = true)]
pub(crate) struct FarmArgs {
    #[command(flatten)]
    input: SceneInput,
    /// The folder to write the job into; its parts and the picture, picture.exr, come there too.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// How many parts, at most one a sample.
    #[arg(long, value_name = "N")]
    parts: NonZeroU32,
    /// What runs the job: slurm, hyperqueue, or openjd.
    #[arg(long, value_name = "ENGINE")]
    engine: FarmEngine,
    /// Threads of a part; without it each has a machine for itself.
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroU32>,
    #[command(flatten)]
    settings: SettingsArgs,
    #[command(flatten)]
    view: ViewArgs,
}

impl FarmArgs {
    /// Reads the scene, so that what is wrong with it is found here and not on every machine, and
    /// writes the job. `typed` are the arguments as they were typed.
    ///
    /// # Errors
    /// A scene that cannot be read, a part without samples, or a folder that cannot be written to.
    pub(crate) fn run(&self, typed: &ArgMatches) -> Result<(), Failure> {
        self.settings.visibility()?;
        let scene = self.input.read()?;
        let file = FileSettings::of(&scene);
        let samples = self.settings.samples_of_whole("farm", file)?;
        self.view.view(&scene)?;
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
        .map_err(|error| Failure::Input(format!("farm: {error}")))?;
        fs::create_dir_all(&self.output)
            .map_err(|error| refuse(&self.output, format!("cannot be made: {error}")))?;
        for (name, text) in self.engine.files(&plan) {
            let path = self.output.join(name);
            write_atomically(&path, text.as_bytes()).map_err(Failure::input)?;
        }
        let file = format!("{folder}/{}", self.engine.file());
        say!(
            "{} parts; `{}` makes {folder}/picture.exr",
            plan.parts(),
            self.engine.submit(&file)
        )
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
