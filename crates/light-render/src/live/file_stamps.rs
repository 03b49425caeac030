use core::time::Duration;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Instant, SystemTime};

/// When files were changed last, to see that they change again.
#[derive(Clone, Debug)]
pub(crate) struct FileStamps {
    files: Vec<(PathBuf, Option<Stamp>)>,
    /// When they were looked at last.
    looked: Instant,
}

/// The time of the last change, and the length; `None` of a file that is not there.
type Stamp = (SystemTime, u64);

/// Between two looks.
const PERIOD: Duration = Duration::from_millis(200);

impl FileStamps {
    /// The files as they are now.
    pub(crate) fn of(files: Vec<PathBuf>) -> Self {
        let with_stamp = |path: PathBuf| {
            let stamp = stamp(&path);
            (path, stamp)
        };
        Self {
            files: files.into_iter().map(with_stamp).collect(),
            looked: Instant::now(),
        }
    }

    /// The first file that is not as it was; looks only now and then.
    pub(crate) fn changed(&mut self) -> Option<&Path> {
        if self.looked.elapsed() < PERIOD {
            return None;
        }
        self.looked = Instant::now();
        self.changed_now()
    }

    /// Waits for a change, unless `stops`.
    pub(crate) fn wait(&self, stops: impl Fn() -> bool) -> Option<&Path> {
        while !stops() {
            if let Some(path) = self.changed_now() {
                // Whoever writes it may not have finished.
                std::thread::sleep(PERIOD);
                return Some(path);
            }
            std::thread::sleep(PERIOD);
        }
        None
    }

    fn changed_now(&self) -> Option<&Path> {
        let mut files = self.files.iter();
        let changed = files.find(|(path, before)| stamp(path) != *before);
        changed.map(|(path, _)| path.as_path())
    }
}

fn stamp(path: &Path) -> Option<Stamp> {
    let file = fs::metadata(path).ok()?;
    Some((file.modified().ok()?, file.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_seen() {
        let name = format!("lights-stamps-{}", std::process::id());
        let path = std::env::temp_dir().join(name);
        let stamps = || FileStamps::of(vec![path.clone()]);
        drop(fs::remove_file(&path));
        let missing = stamps();
        assert_eq!(missing.changed_now(), None, "not there, as before");
        fs::write(&path, "a").expect("a file");
        assert_eq!(missing.changed_now(), Some(path.as_path()), "it appeared");
        let there = stamps();
        assert_eq!(there.changed_now(), None, "as it was");
        assert_eq!(there.wait(|| true), None, "stopped");
        fs::write(&path, "ab").expect("a file");
        assert_eq!(there.wait(|| false), Some(path.as_path()), "longer");
        fs::remove_file(&path).expect("removed");
        assert_eq!(there.changed_now(), Some(path.as_path()), "gone");
    }
}
