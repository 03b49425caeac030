use std::fs;
use std::time::Instant;

/// Counts the seconds that all threads of this program run together, where the system reports them
/// (Linux), so that other work on the machine counts little; wall-clock time elsewhere.
#[derive(Clone, Copy, Debug)]
pub struct CpuTimer {
    start: Instant,
    before: Option<f64>,
}

impl CpuTimer {
    /// Begins to count.
    #[must_use]
    pub fn start() -> Self {
        let before = thread_seconds();
        Self {
            start: Instant::now(),
            before,
        }
    }

    /// Seconds since the start. Those of threads that have ended since are missing.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        match (self.before, thread_seconds()) {
            (Some(before), Some(now)) => now - before,
            _ => self.start.elapsed().as_secs_f64(),
        }
    }
}

/// The seconds that all threads of this program have run, where the system reports them.
fn thread_seconds() -> Option<f64> {
    let mut nanoseconds = 0.0;
    for task in fs::read_dir("/proc/self/task").ok()? {
        let line = fs::read_to_string(task.ok()?.path().join("schedstat")).ok()?;
        nanoseconds += line.split_whitespace().next()?.parse::<f64>().ok()?;
    }
    Some(nanoseconds * 1e-9)
}
