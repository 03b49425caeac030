//! The commands of the program, one a file, and what they share.

mod arguments;
mod bench;
mod bench_args;
mod checkpoint;
mod compare;
mod completions;
mod demo;
mod display_args;
mod doubts;
mod env;
mod env_convert;
mod env_median_cut;
mod env_regions;
mod environment;
mod exit;
mod failure;
mod farm;
mod ies;
mod info;
mod interrupt;
mod layer_args;
mod light_args;
mod light_choice;
mod live_args;
mod memory_check;
mod merge;
mod output_file;
mod output_image;
mod prepared_picture;
mod progress;
mod references;
mod refused_lights;
mod render;
mod render_args;
mod render_outputs;
mod render_report;
mod render_settings;
mod rendered_picture;
mod report;
mod sampler_list;
mod scene_input;
mod stdout;
mod unfinished;
mod view_args;
mod visibility;
mod visible;
mod whole;
mod window;

use alloc::collections::BTreeSet;
use std::ffi::OsString;
use std::process::ExitCode;

use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};

/// What the help of the program ends with.
const AFTER_HELP: &str = "\
Examples:
  lights                                       the demo: pictures into out/, and a table
  lights render room.obj -o room.png           a picture of a file
  lights render car.glb --sky clear-noon --spp 256 -o car.exr -o car.png
  lights info scene.pbrt                       its lights, and what was not read of the file
  lights compare a.exr reference.exr --max-relmse 0.01
  lights completions bash                      completions of a shell
  lights man                                   the man page

Exit status:
  0    done
  1    a check that was asked for failed (--max-relmse, --max-bias)
  2    bad usage or bad input: one line on standard error
  130  interrupted: one line says what was written; files are whole or not there

Environment lights, exposures and more: lights render --help";

/// Lights and light sampling for physically based rendering.
///
/// Without a command: renders three of the shipped scenes into out/ and compares light samplers on
/// the night scene.
#[derive(Debug, Parser)]
#[command(name = "lights", version, max_term_width = 100, after_help = AFTER_HELP)]
struct Program {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    Bench(Box<bench_args::BenchArgs>),
    Compare(compare::CompareArgs),
    Completions(completions::CompletionsArgs),
    Env(env::EnvArgs),
    Farm(Box<farm::FarmArgs>),
    Ies(ies::IesArgs),
    Info(info::InfoArgs),
    /// Print the man page of the program and all of its commands.
    Man,
    Merge(merge::MergeArgs),
    Render(Box<render_args::RenderArgs>),
    Report(Box<report::ReportArgs>),
}

/// Runs the program with the arguments of the process.
#[must_use]
pub fn main() -> ExitCode {
    let (program, typed) = match read() {
        Ok(read) => read,
        Err(error) => return exit::report_usage(&error),
    };
    interrupt::listen();
    let result = match program.command {
        Some(Command::Bench(args)) => args.run(),
        Some(Command::Compare(args)) => args.run(),
        Some(Command::Completions(args)) => args.run(Program::command()),
        Some(Command::Env(args)) => args.run(),
        Some(Command::Farm(args)) => args.run(&typed),
        Some(Command::Ies(args)) => args.run(),
        Some(Command::Info(args)) => args.run(),
        Some(Command::Man) => completions::man(Program::command()),
        Some(Command::Merge(args)) => args.run(),
        Some(Command::Render(args)) => args.run(),
        Some(Command::Report(args)) => args.run(),
        None => demo::run(),
    };
    match result.and_then(|()| stdout::flush()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

/// The arguments of the process, and those of the command as they were typed.
fn read() -> Result<(Program, ArgMatches), clap::Error> {
    let mut typed = Program::command().try_get_matches()?;
    let program = Program::from_arg_matches(&typed)?;
    let of_command = typed.remove_subcommand().map(|(_, typed)| typed);
    Ok((program, of_command.unwrap_or_default()))
}

/// Reads a command line, the program's name first, as [`main`] does, and runs nothing.
///
/// # Errors
/// What is wrong with it, or the requested help.
pub fn parse<A>(arguments: impl IntoIterator<Item = A>) -> Result<(), String>
where
    A: Into<OsString> + Clone,
{
    let parsed = Program::try_parse_from(arguments);
    parsed.map(drop).map_err(|error| error.render().to_string())
}

/// Each word that the program knows once: the names of its commands and flags, as they are typed,
/// and the values that have a name.
#[must_use]
pub fn words() -> Vec<String> {
    let mut program = Program::command();
    program.build();
    let mut words = BTreeSet::new();
    let mut commands = vec![&program];
    while let Some(command) = commands.pop() {
        words.insert(command.get_name().to_owned());
        for argument in command.get_arguments() {
            words.extend(argument.get_short().map(|flag| format!("-{flag}")));
            words.extend(argument.get_long().map(|flag| format!("--{flag}")));
            let values = argument.get_possible_values();
            words.extend(values.iter().map(|value| value.get_name().to_owned()));
        }
        commands.extend(command.get_subcommands());
    }
    words.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_commands_flags_and_named_values() {
        let words = words();
        for word in ["render", "median-cut", "--spp", "-o", "mis", "--group"] {
            assert!(words.iter().any(|known| known == word), "{word}: {words:?}");
        }
    }

    #[test]
    fn command_lines_are_read_without_running_them() {
        let scene = ["lights", "render", "no-such-file.obj", "-o", "a.exr"];
        assert_eq!(parse(scene), Ok(()), "files are not looked at");
        let error = parse(["lights", "render", "--spp", "0"]).expect_err("no sample");
        assert!(error.contains("--spp"), "{error}");
        let help = parse(["lights", "--help"]).expect_err("help");
        assert!(help.contains("Usage"), "{help}");
    }
}
