//! Vector files: one `KIND.jsonl` a kind, or `KIND.jsonl.gz`.

use flate2::read::GzDecoder;
use std::fs;
use std::io::Read;
use std::path::Path;

/// The lines of one kind.
#[derive(Debug)]
pub(super) struct VectorFile {
    pub(super) kind: String,
    pub(super) text: String,
}

/// The vector files of `folder`, in alphabetical order, at least one.
pub(super) fn read_folder(folder: &Path) -> Result<Vec<VectorFile>, String> {
    let explain = |path: &Path, e: std::io::Error| format!("{}: {e}", path.display());
    let entries = fs::read_dir(folder).map_err(|e| explain(folder, e))?;
    let mut files = Vec::new();
    for path in entries.filter_map(|entry| entry.ok().map(|e| e.path())) {
        if let Some(kind) = kind_of(&path) {
            let text = read(&path).map_err(|e| explain(&path, e))?;
            files.push(VectorFile { kind, text });
        }
    }
    files.sort_by(|a, b| a.kind.cmp(&b.kind));
    if files.is_empty() {
        return Err(format!(
            "{}: no .jsonl or .jsonl.gz file in it",
            folder.display()
        ));
    }
    Ok(files)
}

/// The kind of vectors that a file holds: its name without the endings; none for other files.
fn kind_of(path: &Path) -> Option<String> {
    let name = path.file_name()?.to_str()?;
    let kind = name.strip_suffix(".gz").unwrap_or(name);
    Some(kind.strip_suffix(".jsonl")?.to_owned())
}

fn read(path: &Path) -> std::io::Result<String> {
    let bytes = fs::read(path)?;
    let mut text = String::new();
    if path.extension().is_some_and(|e| e == "gz") {
        GzDecoder::new(&bytes[..]).read_to_string(&mut text)?;
    } else {
        (&bytes[..]).read_to_string(&mut text)?;
    }
    Ok(text)
}
