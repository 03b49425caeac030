use std::io::{IsTerminal, stderr};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar on standard error, while that is a terminal; silence otherwise.
#[derive(Debug)]
pub(crate) struct ProgressLine {
    bar: ProgressBar,
}

impl ProgressLine {
    const STEPS: u16 = 1000;

    /// A line that begins with `label`; with [`Volume::Quiet`] never shown.
    pub(crate) fn new(label: impl Into<String>, volume: Volume) -> Self {
        let target = if volume == Volume::Normal && stderr().is_terminal() {
            ProgressDrawTarget::stderr()
        } else {
            ProgressDrawTarget::hidden()
        };
        let style =
            ProgressStyle::with_template("{prefix:>24} [{bar:40}] {percent:>3}% {elapsed} {msg}");
        let bar = ProgressBar::with_draw_target(Some(Self::STEPS.into()), target);
        if let Ok(style) = style {
            bar.set_style(style.progress_chars("=> "));
        }
        bar.set_prefix(label.into());
        Self { bar }
    }

    /// Shows that the share `done` in `[0, 1]` is done, with a word on how.
    pub(crate) fn show(&self, done: f64, message: String) {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "0..=1000"
        )]
        self.bar
            .set_position((done * f64::from(Self::STEPS)) as u64);
        self.bar.set_message(message);
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// Whether a command talks about its work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Volume {
    /// It does.
    Normal,
    /// Results alone.
    Quiet,
}
