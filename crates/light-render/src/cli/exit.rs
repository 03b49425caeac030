use std::process::ExitCode;

use clap::error::ErrorKind;

use super::failure::Failure;
use super::interrupt::INTERRUPTED;
use super::stdout::{complain, flush, line};

impl Failure {
    /// Prints the one line to standard error and says how the process ends.
    pub(crate) fn report(&self) -> ExitCode {
        let (message, status) = match self {
            Self::Input(message) => (message, 2),
            Self::Check(message) => (message, 1),
            Self::Interrupted(message) => (message, INTERRUPTED),
        };
        complain(format_args!("{}", one_line(message)));
        ExitCode::from(status)
    }
}

/// Ends the process as wrong arguments ask for: help on standard output and status 0, or one line
/// and status 2.
pub(crate) fn report_usage(error: &clap::Error) -> ExitCode {
    let text = error.render().to_string();
    if !error.use_stderr() {
        return match line(format_args!("{}", text.trim_end())).and_then(|()| flush()) {
            Ok(()) => ExitCode::SUCCESS,
            Err(failure) => failure.report(),
        };
    }
    // The error comes before the usage, which only --help prints.
    let wrong = text.split("\nUsage:").next().unwrap_or_default();
    let wrong = wrong
        .split("\nFor more information")
        .next()
        .unwrap_or_default();
    // What clap suggests stands in paragraphs of its own.
    let paragraphs = wrong.trim_start_matches("error: ").trim_end().split("\n\n");
    // How an unknown flag would be a value is no help; what flags there are is.
    let paragraphs = paragraphs.map(|words| {
        let is_of_values = words.trim_start().starts_with("tip: to pass ");
        if is_of_values {
            "`--help` lists the flags"
        } else {
            words
        }
    });
    let mut paragraphs: Vec<_> = paragraphs.collect();
    let has_tip = paragraphs.len() > 1;
    paragraphs.extend(help_for(error.kind()).filter(|_| !has_tip));
    Failure::input(paragraphs.join("; ")).report()
}

/// Where to look for what would be right, where that is a name.
const fn help_for(kind: ErrorKind) -> Option<&'static str> {
    match kind {
        ErrorKind::InvalidSubcommand => Some("`--help` lists the commands"),
        ErrorKind::UnknownArgument => Some("`--help` lists the flags"),
        _ => None,
    }
}

/// The words of `message` on a single line.
fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_one_line() {
        assert_eq!(one_line("a\n  b\tc\n"), "a b c", "words");
    }
}
