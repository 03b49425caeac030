use core::sync::atomic::{AtomicU32, Ordering};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::Diagnostic;

/// Writes a file so that it appears whole or not at all: to a temporary file in the same folder,
/// which is then renamed.
///
/// A link is followed: the file that it leads to is replaced. What is no file, a device or a pipe,
/// is written to directly.
///
/// # Errors
/// When the file cannot be written; nothing is left behind then, and a file that was there stays as
/// it was.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), Diagnostic> {
    StagedFile::new(path, bytes)
        .and_then(StagedFile::publish)
        .map_err(|error| Diagnostic::file(path, format!("cannot be written: {error}")))
}

/// Ends the process with `status`, and removes unfinished files: for a program that is asked to
/// stop. Every file is whole then, or not there. Before, `say` gets the files that this process has
/// written and that are there, each once, as their writers called them.
pub fn exit_without_outputs(status: i32, say: impl FnOnce(&[PathBuf])) -> ! {
    // Nobody begins or ends a file from here on.
    let mut all = output_files();
    for temporary in &all.staged {
        drop(fs::remove_file(temporary));
    }
    all.published.retain(|path| path.exists());
    say(&all.published);
    std::process::exit(status)
}

/// The files that this process writes.
struct OutputFiles {
    /// The temporary files that are not yet renamed.
    staged: Vec<PathBuf>,
    /// Those that were written, each once.
    published: Vec<PathBuf>,
}

fn output_files() -> MutexGuard<'static, OutputFiles> {
    static ALL: Mutex<OutputFiles> = Mutex::new(OutputFiles {
        staged: Vec::new(),
        published: Vec::new(),
    });
    ALL.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A complete temporary file, not yet renamed. Unless it is published, it is
/// removed.
#[derive(Debug)]
pub(crate) struct StagedFile {
    /// Where it is and where it belongs; `None` when nothing is left to do.
    paths: Option<(PathBuf, PathBuf)>,
    /// What its writer calls it.
    name: PathBuf,
}

impl StagedFile {
    /// Writes `bytes` to a temporary file next to `path`.
    pub(crate) fn new(path: &Path, bytes: &[u8]) -> io::Result<Self> {
        Self::with(path, |file| file.write_all(bytes))
    }

    /// Lets `write` fill a temporary file next to `path`.
    fn with(path: &Path, write: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<Self> {
        let kind = fs::metadata(path).map(|there| there.file_type());
        if kind.as_ref().is_ok_and(fs::FileType::is_dir) {
            return Err(io::Error::other("it is a folder"));
        }
        if kind.as_ref().is_ok_and(|kind| !kind.is_file()) {
            write(&mut File::options().write(true).open(path)?)?;
            return Ok(Self {
                paths: None,
                name: path.to_path_buf(),
            });
        }
        let target = match kind {
            Ok(_) => fs::canonicalize(path)?,
            Err(_) => link_target(path)?,
        };
        let temporary =
            temporary_path(&target).ok_or_else(|| io::Error::other("expected a file's name"))?;
        let mut all = output_files();
        let mut file = File::options()
            .write(true)
            .create_new(true)
            .open(&temporary)?;
        all.staged.push(temporary.clone());
        drop(all);
        let staged = Self {
            paths: Some((temporary, target)),
            name: path.to_path_buf(),
        };
        write(&mut file)?;
        // A full disk may show here for the first time.
        file.sync_all()?;
        Ok(staged)
    }

    /// Renames the file to its target.
    pub(crate) fn publish(mut self) -> io::Result<()> {
        if let Some((temporary, target)) = &self.paths {
            let mut all = output_files();
            fs::rename(temporary, target)?;
            all.staged.retain(|other| other != temporary);
            if !all.published.contains(&self.name) {
                all.published.push(self.name.clone());
            }
        }
        self.paths = None;
        Ok(())
    }
}

impl Drop for StagedFile {
    fn drop(&mut self) {
        if let Some((temporary, _)) = &self.paths {
            let mut all = output_files();
            // What stops the removal stopped the writing, and that is what is reported.
            drop(fs::remove_file(temporary));
            all.staged.retain(|other| other != temporary);
        }
    }
}

/// Where the links at `path` lead to, though no file is there; `path` itself if it is no link.
/// [`write_atomically`] writes there.
///
/// # Errors
/// When links lead to each other without an end.
pub fn link_target(path: &Path) -> io::Result<PathBuf> {
    /// As many as Linux follows.
    const MOST: usize = 40;
    let mut path = path.to_path_buf();
    for _ in 0..MOST {
        let Ok(target) = fs::read_link(&path) else {
            return Ok(path);
        };
        // A relative target starts in the folder of the link.
        path = path.with_file_name("").join(target);
    }
    Err(io::Error::other("too many links"))
}

/// A name in the same folder that nothing else uses.
fn temporary_path(path: &Path) -> Option<PathBuf> {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    path.file_name()?;
    let (process, count) = (std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
    Some(path.with_file_name(format!(".lights-{process}-{count}.part")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_folder::TestFolder;

    #[test]
    fn replaces_the_file_and_leaves_nothing_else() {
        let folder = TestFolder::new("write_atomically");
        let path = folder.path("a.txt");
        for text in ["one", "two"] {
            write_atomically(&path, text.as_bytes()).expect("written");
            assert_eq!(fs::read_to_string(&path).expect("a file"), text, "content");
        }
        assert_eq!(folder.names(), ["a.txt"], "nothing else");
    }

    #[test]
    fn leaves_nothing_when_it_fails() {
        let folder = TestFolder::new("write_whole_fails");
        let missing = folder.path("missing/a.txt");
        let error = write_atomically(&missing, b"x").expect_err("no folder");
        assert!(error.message.starts_with("cannot be written: "), "{error}");
        fs::create_dir(folder.path("folder")).expect("a folder");
        write_atomically(&folder.path("folder"), b"x").expect_err("a folder is in the way");
        assert_eq!(folder.names(), ["folder"], "nothing else");
        write_atomically(&folder.path(".."), b"x").expect_err("no name");
    }

    #[test]
    fn a_full_disk_leaves_what_was_there() {
        let folder = TestFolder::new("write_whole_full");
        let path = folder.path("a.txt");
        write_atomically(&path, b"old").expect("written");
        let full = StagedFile::with(&path, |file| {
            file.write_all(b"half of the new te")?;
            Err(io::ErrorKind::StorageFull.into())
        });
        let error = full.expect_err("a full disk");
        assert_eq!(error.kind(), io::ErrorKind::StorageFull, "its reason");
        assert_eq!(folder.names(), ["a.txt"], "nothing else");
        assert_eq!(fs::read(&path).expect("a file"), b"old", "as it was");
        drop(StagedFile::new(&path, b"new").expect("staged"));
        assert_eq!(folder.names(), ["a.txt"], "not published, not there");
    }

    #[test]
    fn long_names_have_room_beside_them() {
        let folder = TestFolder::new("write_whole_long");
        let name = "n".repeat(250);
        write_atomically(&folder.path(&name), b"x").expect("written");
        assert_eq!(folder.names(), [name], "nothing else");
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_devices_stay() {
        use std::os::unix::fs::{FileTypeExt, symlink};
        let folder = TestFolder::new("write_whole_links");
        let [file, link, device] = ["file", "link", "device"].map(|name| folder.path(name));
        fs::write(&file, "old").expect("a file");
        symlink(&file, &link).expect("a link");
        write_atomically(&link, b"new").expect("written");
        assert_eq!(fs::read(&file).expect("a file"), b"new", "through the link");
        symlink("/dev/full", &device).expect("a link");
        let error = write_atomically(&device, b"new").expect_err("a device without room");
        assert!(error.message.starts_with("cannot be written: "), "{error}");
        let full = fs::metadata("/dev/full").expect("a device");
        assert!(full.file_type().is_char_device(), "still a device");
        assert_eq!(folder.names(), ["device", "file", "link"], "nothing else");
    }

    #[cfg(unix)]
    #[test]
    fn links_lead_to_files_that_are_not_there_yet() {
        use std::os::unix::fs::symlink;
        let folder = TestFolder::new("write_whole_dangling");
        fs::create_dir(folder.path("real")).expect("a folder");
        let [first, second, missing, round] =
            ["first", "second", "missing", "round"].map(|name| folder.path(name));
        symlink("second", &first).expect("a link");
        symlink("real/file", &second).expect("a link");
        write_atomically(&first, b"new").expect("written");
        let file = folder.path("real/file");
        assert_eq!(fs::read(&file).expect("a file"), b"new", "behind both");
        for link in [&first, &second] {
            let kind = fs::symlink_metadata(link).expect("a link");
            assert!(kind.is_symlink(), "{} is still a link", link.display());
        }
        symlink("no-such-folder/file", &missing).expect("a link");
        write_atomically(&missing, b"new").expect_err("no folder");
        symlink("round", &round).expect("a link");
        write_atomically(&round, b"new").expect_err("a link to itself");
        let names = ["first", "missing", "real", "round", "second"];
        assert_eq!(folder.names(), names, "nothing else");
    }
}
