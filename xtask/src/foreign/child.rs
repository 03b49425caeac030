use core::time::Duration;
use std::fs;
use std::io::{self, Read};
use std::process::{Command, Stdio};
use std::thread::{self, sleep};
use std::time::Instant;

/// How a program ended, and what it took.
#[derive(Clone, Debug, Default)]
pub(super) struct Ended {
    /// Its exit status; `None` if a signal ended it.
    pub(super) status: Option<i32>,
    /// Whether it was stopped because it took too long.
    pub(super) is_late: bool,
    pub(super) output: String,
    pub(super) error: String,
    pub(super) time: Duration,
    /// The most memory it held, as often as it was looked at; `None` where the system does not
    /// tell.
    pub(super) bytes: Option<u64>,
}

/// Runs a program, and stops it after `limit`.
///
/// # Errors
/// When it cannot start.
pub(super) fn run_limited(mut command: Command, limit: Duration) -> io::Result<Ended> {
    /// Between two looks at its memory.
    const PERIOD: Duration = Duration::from_millis(2);
    let start = Instant::now();
    let pipes = command.stdin(Stdio::null()).stdout(Stdio::piped());
    let mut child = pipes.stderr(Stdio::piped()).spawn()?;
    let outputs = (child.stdout.take(), child.stderr.take());
    // Threads read both pipes, so that none fills up.
    let readers = (
        thread::spawn(|| text(outputs.0)),
        thread::spawn(|| text(outputs.1)),
    );
    let mut ended = Ended::default();
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        ended.bytes = peak_bytes(child.id()).max(ended.bytes);
        if start.elapsed() > limit {
            ended.is_late = true;
            child.kill()?;
        }
        sleep(PERIOD);
    };
    ended.time = start.elapsed();
    ended.status = status.code();
    ended.output = readers.0.join().unwrap_or_default();
    ended.error = readers.1.join().unwrap_or_default();
    Ok(ended)
}

fn text(pipe: Option<impl Read>) -> String {
    let mut bytes = Vec::new();
    if let Some(mut pipe) = pipe {
        // What was read before an error is what there is to show.
        drop(pipe.read_to_end(&mut bytes));
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// The most memory that a process has held so far.
fn peak_bytes(id: u32) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{id}/status")).ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kilobytes * 1024)
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn shell(script: &str, limit: Duration) -> Ended {
        let mut command = Command::new("sh");
        command.args(["-c", script]);
        run_limited(command, limit).expect("it starts")
    }

    #[test]
    fn programs_end_or_are_stopped() {
        let ended = shell("echo out; echo err >&2; exit 3", Duration::from_secs(60));
        assert_eq!((ended.status, ended.is_late), (Some(3), false), "{ended:?}");
        assert_eq!(
            (ended.output.trim(), ended.error.trim()),
            ("out", "err"),
            "both"
        );
        let ended = shell("exec sleep 60", Duration::from_millis(50));
        assert_eq!((ended.status, ended.is_late), (None, true), "{ended:?}");
        assert!(ended.time < Duration::from_secs(30), "{ended:?}");
    }
}
