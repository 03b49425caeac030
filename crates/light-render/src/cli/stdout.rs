use core::fmt;
use std::io::{self, ErrorKind, Write};

use light_scene::Diagnostic;

use super::failure::Failure;

/// Prints a line of results to standard output; formatted as by `println!`, which panics where this
/// fails.
macro_rules! say {
    ($($words:tt)*) => {
        $crate::cli::stdout::line(format_args!($($words)*))
    };
}

pub(crate) use say;

/// Prints a line to standard output. If nobody reads any more, it goes nowhere: the work goes on,
/// files and status are what they would be.
///
/// # Errors
/// When standard output takes nothing for another reason, such as a full disk.
pub(crate) fn line(words: fmt::Arguments<'_>) -> Result<(), Failure> {
    checked(writeln!(io::stdout(), "{words}"))
}

/// Prints bytes to standard output.
///
/// # Errors
/// As for [`line`].
pub(crate) fn write_all(bytes: &[u8]) -> Result<(), Failure> {
    checked(io::stdout().write_all(bytes))
}

/// Hands what is still held back to standard output.
///
/// # Errors
/// As for [`line`].
pub(crate) fn flush() -> Result<(), Failure> {
    checked(io::stdout().flush())
}

/// Prints a line to standard error, if that takes it: there is no other place to complain to.
pub(crate) fn complain(words: fmt::Arguments<'_>) {
    drop(writeln!(io::stderr(), "lights: {words}"));
}

/// Prints to standard error what the readers repaired or left out.
pub(crate) fn report_warnings(warnings: &[Diagnostic]) {
    for warning in warnings {
        complain(format_args!("warning: {warning}"));
    }
}

fn checked(written: io::Result<()>) -> Result<(), Failure> {
    match written {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Input(format!(
            "standard output: cannot be written: {error}"
        ))),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_closed_pipe_is_no_failure_but_a_full_disk_is() {
        assert_eq!(checked(Ok(())), Ok(()), "printed");
        let closed = Err(ErrorKind::BrokenPipe.into());
        assert_eq!(checked(closed), Ok(()), "nobody reads");
        let full = checked(Err(ErrorKind::StorageFull.into()));
        assert!(matches!(full, Err(Failure::Input(_))), "{full:?}");
    }
}
