use core::sync::atomic::{AtomicU8, Ordering};
use std::io::{IsTerminal, Write, stderr};
use std::path::PathBuf;

use light_scene::exit_without_outputs;

use super::stdout::complain;

/// The conventional exit status of an interrupted program.
pub(super) const INTERRUPTED: u8 = 130;

/// What the program does when it is asked to end.
static STATE: AtomicU8 = AtomicU8::new(AT_ONCE);

/// It ends, and leaves nothing half written.
const AT_ONCE: u8 = 0;
/// A rendering will stop and write what there is.
const GENTLY: u8 = 1;
/// It was asked to.
const ASKED: u8 = 2;

/// Ends the program when somebody presses Ctrl-C, or asks by a signal.
pub(super) fn listen() {
    // Without a handler the process would end as well, but leave what it is writing.
    drop(ctrlc::set_handler(|| {
        let swap = STATE.compare_exchange(GENTLY, ASKED, Ordering::Relaxed, Ordering::Relaxed);
        if swap.is_err() {
            exit_without_outputs(INTERRUPTED.into(), |written| {
                leave_progress_line();
                complain(format_args!("{}", last_words(written)));
            });
        }
        leave_progress_line();
        complain(format_args!(
            "stopping after this pass over the picture; once more to stop at once"
        ));
    }));
}

/// Begins a line of its own where a terminal shows progress, or the keys that were pressed.
fn leave_progress_line() {
    if stderr().is_terminal() {
        drop(writeln!(stderr()));
    }
}

/// What an interrupted program leaves, in words.
fn last_words(written: &[PathBuf]) -> String {
    /// More names make no line that is read.
    const MOST: usize = 3;
    let names = written.iter().take(MOST);
    let names: Vec<String> = names.map(|path| path.display().to_string()).collect();
    let names = names.join(", ");
    match written.len() {
        0 => "interrupted: nothing was written".to_owned(),
        count if count > MOST => {
            format!(
                "interrupted; written before: {names} and {} more",
                count - MOST
            )
        }
        _ => format!("interrupted; written before: {names}"),
    }
}

/// While this lives, the first request to end is for the rendering to answer.
#[derive(Debug)]
pub(super) struct GentleStop(());

impl GentleStop {
    pub(super) fn begin() -> Self {
        STATE.store(GENTLY, Ordering::Relaxed);
        Self(())
    }

    /// Whether somebody has asked.
    pub(super) fn is_asked(&self) -> bool {
        STATE.load(Ordering::Relaxed) == ASKED
    }
}

impl Drop for GentleStop {
    fn drop(&mut self) {
        STATE.store(AT_ONCE, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_words_name_what_was_written() {
        let files = ["a.exr", "b.exr", "c.exr", "d.exr", "e.exr"].map(PathBuf::from);
        let words = |count| last_words(&files[..count]);
        assert_eq!(words(0), "interrupted: nothing was written", "no file");
        let all = "interrupted; written before: a.exr, b.exr, c.exr";
        assert_eq!(words(3), all, "all of them");
        assert_eq!(words(5), format!("{all} and 2 more"), "not too many");
    }
}
