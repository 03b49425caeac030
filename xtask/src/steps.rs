use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Output, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use crate::processor_time::children_seconds;

/// How a step ended that did not fail.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// What it checks holds.
    Passed,
    /// It could not run here, for the reason given.
    Skipped(String),
}

/// What a step returns: an error says in one line what failed.
pub type StepResult = Result<Outcome, String>;

/// A list of steps that run one after the other, all of them, whatever fails.
#[derive(Debug)]
pub struct Steps {
    start: Instant,
    passed: usize,
    failed: Vec<Reason>,
    skipped: Vec<Reason>,
}

/// A step that did not pass, and why.
#[derive(Debug, PartialEq, Eq)]
struct Reason {
    step: String,
    why: String,
}

impl Default for Steps {
    fn default() -> Self {
        Self {
            start: Instant::now(),
            passed: 0,
            failed: Vec::new(),
            skipped: Vec::new(),
        }
    }
}

impl Steps {
    /// Runs one step and says how it went.
    pub fn run(&mut self, name: &str, step: impl FnOnce() -> StepResult) {
        println!("==> {name}");
        let start = Instant::now();
        let before = children_seconds();
        let result = step();
        let seconds = start.elapsed().as_secs();
        let reason = |why: String| Reason {
            step: name.to_owned(),
            why,
        };
        match result {
            Ok(Outcome::Passed) => {
                let work = children_seconds().zip(before);
                let work = work.map_or(String::new(), |(after, before)| {
                    format!(", {:.0} s of processor time", after - before)
                });
                println!("    passed in {seconds} s{work}");
                self.passed += 1;
            }
            Ok(Outcome::Skipped(why)) => {
                println!("    skipped: {why}");
                self.skipped.push(reason(why));
            }
            Err(why) => {
                println!("    FAILED after {seconds} s: {why}");
                self.failed.push(reason(why));
            }
        }
    }

    /// Prints what was skipped, what failed, the counts and the verdict; success if nothing failed.
    #[must_use]
    pub fn finish(self) -> ExitCode {
        println!();
        for Reason { step, why } in &self.skipped {
            println!("skipped {step}: {why}");
        }
        for Reason { step, why } in &self.failed {
            println!("FAILED  {step}: {why}");
        }
        println!(
            "{} passed, {} failed, {} skipped",
            self.passed,
            self.failed.len(),
            self.skipped.len()
        );
        let seconds = self.start.elapsed().as_secs();
        let time = format!("{} min {} s", seconds / 60, seconds % 60);
        println!("{} ({time})", self.verdict());
        ExitCode::from(u8::from(!self.failed.is_empty()))
    }

    /// The last line of a run: it claims that all steps passed only where all of them ran.
    fn verdict(&self) -> String {
        let names = |reasons: &[Reason]| {
            let names: Vec<&str> = reasons.iter().map(|r| r.step.as_str()).collect();
            names.join("; ")
        };
        match (self.failed.is_empty(), self.skipped.is_empty()) {
            (true, true) => "all steps passed".to_owned(),
            (true, false) => format!("not checked on this machine: {}", names(&self.skipped)),
            (false, _) => format!("failed: {}", names(&self.failed)),
        }
    }
}

/// The project's root folder.
#[must_use]
pub fn root() -> PathBuf {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR"));
    manifest.parent().unwrap_or(manifest).to_path_buf()
}

/// Cargo of the toolchain that runs this program, in the project's root.
pub fn cargo<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Command {
    let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(program);
    command.current_dir(root()).args(arguments);
    command
}

/// Runs a command that writes where we write.
///
/// # Errors
/// The command line, if it cannot start or answers that it failed.
pub fn run(command: &mut Command) -> Result<(), String> {
    let status = command.status().map_err(|e| cannot_start(command, &e))?;
    if status.success() {
        Ok(())
    } else {
        Err(command_line(command))
    }
}

/// Runs a command and returns what it wrote to both of its outputs.
///
/// # Errors
/// The command line and the last lines, if it cannot start or answers that it failed.
pub fn output(command: &mut Command) -> Result<String, String> {
    let out = command
        .stdin(Stdio::null())
        .output()
        .map_err(|e| cannot_start(command, &e))?;
    text_of(command, &out)
}

/// As [`output`], and stops a command that takes longer than `limit`.
///
/// # Errors
/// As [`output`], or that it was stopped.
pub fn output_within(limit: Duration, command: &mut Command) -> Result<String, String> {
    let pipes = command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let child = pipes.spawn().map_err(|e| cannot_start(command, &e))?;
    let id = child.id();
    // The thread reads both pipes, so that none fills up.
    let (sender, receiver) = mpsc::channel();
    let reader = thread::spawn(move || sender.send(child.wait_with_output()));
    let Ok(out) = receiver.recv_timeout(limit) else {
        let id = id.to_string();
        // It may have ended just now.
        let _ = run(Command::new("kill").arg(&id));
        let _ = reader.join();
        let seconds = limit.as_secs();
        return Err(format!(
            "{}: stopped after {seconds} s",
            command_line(command)
        ));
    };
    text_of(command, &out.map_err(|e| cannot_start(command, &e))?)
}

/// What a command that succeeded wrote to both of its outputs.
fn text_of(command: &Command, out: &Output) -> Result<String, String> {
    let text = String::from_utf8_lossy(&out.stdout) + String::from_utf8_lossy(&out.stderr);
    if out.status.success() {
        return Ok(text.into_owned());
    }
    let lines: Vec<&str> = text.lines().collect();
    let tail = lines[lines.len().saturating_sub(20)..].join("\n");
    Err(format!("{}\n{tail}", command_line(command)))
}

/// The results of `work` on each item, in their order, each on a thread of its own.
pub fn side_by_side<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    thread::scope(|scope| {
        let threads: Vec<_> = (items.iter())
            .map(|item| scope.spawn(|| work(item)))
            .collect();
        let results = threads.into_iter().map(thread::ScopedJoinHandle::join);
        results
            .map(|result| result.unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .collect()
    })
}

/// Whether a program answers to `--version`.
#[must_use]
pub fn is_there(program: &str) -> bool {
    output(Command::new(program).arg("--version")).is_ok()
}

fn command_line(command: &Command) -> String {
    let program = Path::new(command.get_program())
        .file_name()
        .unwrap_or_default();
    let mut line = program.to_string_lossy().into_owned();
    for argument in command.get_args() {
        line += " ";
        line += &argument.to_string_lossy();
    }
    line
}

fn cannot_start(command: &Command, error: &std::io::Error) -> String {
    format!("{}: {error}", command_line(command))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_step_fails_the_list_and_a_skipped_one_does_not() {
        let mut steps = Steps::default();
        steps.run("passes", || Ok(Outcome::Passed));
        assert_eq!(steps.verdict(), "all steps passed", "nothing was skipped");
        steps.run("needs a tool", || {
            Ok(Outcome::Skipped("no such tool".into()))
        });
        assert!(steps.failed.is_empty(), "nothing failed");
        assert_eq!(
            steps.verdict(),
            "not checked on this machine: needs a tool",
            "the last line names what was skipped"
        );
        steps.run("fails", || Err("reason".into()));
        assert_eq!(steps.verdict(), "failed: fails", "one failed");
        let counts = (steps.passed, steps.failed.len(), steps.skipped.len());
        assert_eq!(counts, (1, 1, 1), "one of each kind");
    }

    #[test]
    fn what_takes_too_long_is_stopped() {
        let limit = Duration::from_millis(300);
        let start = Instant::now();
        let stopped = output_within(limit, Command::new("sleep").arg("60"));
        assert!(
            stopped.is_err_and(|e| e.starts_with("sleep 60: stopped")),
            "its line"
        );
        assert!(start.elapsed() < 30 * limit, "{:?}", start.elapsed());
        let text = output_within(Duration::from_secs(60), Command::new("echo").arg("done"));
        assert_eq!(text.as_deref(), Ok("done\n"), "in time");
    }

    #[test]
    fn commands_say_their_line_when_they_fail() {
        let missing = run(&mut Command::new("no-such-program-anywhere"));
        assert!(
            missing.is_err_and(|e| e.starts_with("no-such-program-anywhere")),
            "its name"
        );
        assert!(
            output(cargo(["--version"]).arg("--no-such-flag")).is_err(),
            "bad flag"
        );
    }
}
