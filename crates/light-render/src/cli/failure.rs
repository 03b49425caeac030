use core::fmt;

/// Why a command does not end with status 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Failure {
    /// Bad usage or bad input: status 2. The message names the file, the line or the flag, and what
    /// was expected.
    Input(String),
    /// A requested check failed: status 1.
    Check(String),
    /// Somebody stopped it; the message says what there is and how to go on: status 130.
    Interrupted(String),
}

impl Failure {
    /// Bad usage or bad input, in the words of `error`.
    pub(crate) fn input(error: impl fmt::Display) -> Self {
        Self::Input(error.to_string())
    }
}
