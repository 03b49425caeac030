use std::fs;
use std::path::{Path, PathBuf};

use crate::Diagnostic;

/// Writes a file so that it appears whole or not at all: beside its place first, then renamed.
///
/// # Errors
/// When the file cannot be written; nothing is left behind then, and a file that was there stays as it was.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Diagnostic> {
    let refuse = |error| Diagnostic::file(path, format!("cannot be written: {error}"));
    let beside = beside(path)
        .ok_or_else(|| Diagnostic::file(path, "cannot be written: expected a file's name"))?;
    let written = fs::write(&beside, bytes).and_then(|()| fs::rename(&beside, path));
    written.map_err(|error| {
        // What stops the removal stopped the writing, and that is what is reported.
        drop(fs::remove_file(&beside));
        refuse(error)
    })
}

/// A name in the same folder that no other process uses.
fn beside(path: &Path) -> Option<PathBuf> {
    let name = path.file_name()?.to_string_lossy();
    let process = std::process::id();
    Some(path.with_file_name(format!(".{name}.{process}.part")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_folder::TestFolder;

    #[test]
    fn replaces_the_file_and_leaves_nothing_beside() {
        let folder = TestFolder::new("write_whole");
        let path = folder.path("a.txt");
        for text in ["one", "two"] {
            write_whole(&path, text.as_bytes()).expect("written");
            assert_eq!(fs::read_to_string(&path).expect("a file"), text, "content");
        }
        assert_eq!(folder.names(), ["a.txt"], "nothing beside");
    }

    #[test]
    fn leaves_nothing_when_it_fails() {
        let folder = TestFolder::new("write_whole_fails");
        let missing = folder.path("missing/a.txt");
        let error = write_whole(&missing, b"x").expect_err("no folder");
        assert!(error.message.starts_with("cannot be written: "), "{error}");
        fs::create_dir(folder.path("folder")).expect("a folder");
        write_whole(&folder.path("folder"), b"x").expect_err("a folder is in the way");
        assert_eq!(folder.names(), ["folder"], "nothing beside");
        write_whole(&folder.path(".."), b"x").expect_err("no name");
    }
}
