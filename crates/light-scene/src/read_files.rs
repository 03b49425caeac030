use alloc::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Begins to keep the names of all files that readers of this crate open, or try to, on any thread:
/// for a program that reads a scene again when one of them changes. Names kept before are gone.
pub fn record_read_files() {
    *names() = Some(BTreeSet::new());
}

/// The files that were opened since [`record_read_files`], each once; none without it.
#[must_use]
pub fn recorded_read_files() -> Vec<PathBuf> {
    let names = names();
    names.iter().flatten().cloned().collect()
}

/// Keeps the name of a file, if names are kept.
pub(crate) fn record(path: &Path) {
    if let Some(names) = names().as_mut() {
        names.insert(path.to_path_buf());
    }
}

fn names() -> MutexGuard<'static, Option<BTreeSet<PathBuf>>> {
    static NAMES: Mutex<Option<BTreeSet<PathBuf>>> = Mutex::new(None);
    NAMES.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read_scene;
    use crate::test_folder::TestFolder;

    #[test]
    fn all_files_of_a_scene_are_kept() {
        let folder = TestFolder::new("read_files");
        let [obj, mtl] = ["a.obj", "a.mtl"].map(|name| folder.path(name));
        std::fs::write(&obj, "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a file");
        std::fs::write(&mtl, "newmtl a\nmap_Kd missing.png\n").expect("a file");
        record_read_files();
        drop(read_scene(&obj));
        // Other tests may read at the same time.
        let names = recorded_read_files();
        for path in [&obj, &mtl, &folder.path("missing.png")] {
            assert!(names.contains(path), "{} in {names:?}", path.display());
        }
    }
}
