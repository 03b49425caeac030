use clap::{Args, Subcommand};

use super::env_convert::ConvertArgs;
use super::env_median_cut::MedianCutArgs;
use super::failure::Failure;

/// Work on environment maps.
// Without a command, one line that lists them is the answer, as everywhere, not the help.
#[derive(Args, Debug)]
#[command(arg_required_else_help = false)]
pub(crate) struct EnvArgs {
    #[command(subcommand)]
    command: EnvCommand,
}

#[derive(Debug, Subcommand)]
enum EnvCommand {
    Convert(ConvertArgs),
    MedianCut(MedianCutArgs),
}

impl EnvArgs {
    /// Runs the command that the arguments name.
    ///
    /// # Errors
    /// Bad input.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        match &self.command {
            EnvCommand::Convert(args) => args.run(),
            EnvCommand::MedianCut(args) => args.run(),
        }
    }
}
