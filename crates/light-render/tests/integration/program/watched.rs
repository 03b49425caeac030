//! Runs the program with a time limit: it must end without a panic or a signal.

use core::time::Duration;
use std::fs::File;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Instant;

/// How the program ended.
#[derive(Debug)]
pub(crate) struct Ending {
    pub(crate) status: i32,
    pub(crate) error: String,
}

/// Longer than any test here takes on a busy machine.
pub(crate) const PATIENCE: Duration = Duration::from_secs(120);

/// Runs the program in `folder`, and waits for its end.
pub(crate) fn watch(folder: &Path, arguments: &[&str]) -> Ending {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lights"));
    command.args(arguments);
    watch_command(folder, command, &format!("{arguments:?}"))
}

/// As [`watch`], run by a shell that first does what `before` says, to limit what the program has.
#[cfg(unix)]
pub(crate) fn watch_after(folder: &Path, before: &str, arguments: &[&str]) -> Ending {
    let mut command = Command::new("sh");
    let script = format!("{before} && exec \"$0\" \"$@\"");
    command.args(["-c", &script, env!("CARGO_BIN_EXE_lights")]);
    command.args(arguments);
    watch_command(folder, command, &format!("{before}, {arguments:?}"))
}

fn watch_command(folder: &Path, mut command: Command, words: &str) -> Ending {
    // A file, because a pipe that nobody reads meanwhile may fill up.
    let name = format!(".stderr-{:?}", std::thread::current().id());
    let path = std::env::temp_dir().join(format!("lights{name}-{}", std::process::id()));
    let error = File::create(&path).expect("a file");
    let child = command.current_dir(folder).stdin(Stdio::null());
    if !words.contains("/dev/full") {
        child.stdout(Stdio::null());
    }
    let mut child = child.stderr(error).spawn().expect("it runs");
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().expect("a status") {
            break status;
        }
        if start.elapsed() > PATIENCE {
            child.kill().expect("killed");
            panic!("hangs: {words}");
        }
        sleep(Duration::from_millis(2));
    };
    let error = std::fs::read(&path).expect("what it said");
    drop(std::fs::remove_file(&path));
    let error = String::from_utf8_lossy(&error).into_owned();
    let status = status.code();
    let status = status.unwrap_or_else(|| panic!("ended by a signal: {words}: {error}"));
    Ending { status, error }
}

impl Ending {
    /// The program did what was asked for, or refused it with one line.
    pub(crate) fn assert_clean(&self, words: &str) {
        let Self { status, error } = self;
        assert!(matches!(status, 0 | 2), "{words}: status {status}: {error}");
        if *status == 2 {
            assert_eq!(error.trim_end().lines().count(), 1, "{words}: {error}");
            assert!(error.starts_with("lights: "), "{words}: {error}");
        }
    }

    /// The program did what was asked for.
    pub(crate) fn assert_works(&self, words: &str) {
        let Self { status, error } = self;
        assert_eq!(*status, 0, "{words}: {error}");
    }

    /// The program refused what was asked for, with one line that holds all of `words`.
    pub(crate) fn assert_refused(&self, words: &[&str]) {
        self.assert_clean(&format!("{words:?}"));
        assert_eq!(self.status, 2, "refused: {}", self.error);
        for word in words {
            assert!(self.error.contains(word), "{word:?} in {:?}", self.error);
        }
    }
}
