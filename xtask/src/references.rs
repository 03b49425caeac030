//! Citations: every key that a doc comment cites is listed in `docs/REFERENCES.md`, once, in
//! alphabetical order.

use std::fs;
use std::path::{Path, PathBuf};

use crate::steps::{Outcome, StepResult, root};

/// Compares the citations in all sources with the list.
///
/// # Errors
/// The first entry that is out of order or twice there, or a citation without an entry.
pub fn check() -> StepResult {
    let list = fs::read_to_string(root().join("docs/REFERENCES.md")).map_err(|e| e.to_string())?;
    let keys: Vec<&str> = list.lines().filter_map(listed_key).collect();
    if let Some(pair) = keys.windows(2).find(|pair| pair[0] >= pair[1]) {
        return Err(format!(
            "docs/REFERENCES.md: [{}] must not follow [{}]",
            pair[1], pair[0]
        ));
    }
    let mut sources = Vec::new();
    for folder in ["crates", "xtask", "benches", "fuzz"] {
        rust_files(&root().join(folder), &mut sources);
    }
    for path in sources {
        let text = fs::read_to_string(&path).map_err(|e| e.to_string())?;
        if let Some(key) = citations(&text).find(|key| !keys.contains(key)) {
            let file = path.strip_prefix(root()).unwrap_or(&path).display();
            return Err(format!("{file}: [{key}] is not in docs/REFERENCES.md"));
        }
    }
    Ok(Outcome::Passed)
}

/// The key of a line of the list.
fn listed_key(line: &str) -> Option<&str> {
    line.strip_prefix("- `[")?.split(']').next()
}

/// The keys that comments cite, between a backtick with a bracket and their mirror image.
fn citations(text: &str) -> impl Iterator<Item = &str> {
    let comments = text
        .lines()
        .filter(|line| line.trim_start().starts_with("//"));
    comments.flat_map(|line| {
        let quoted = line
            .split("`[")
            .skip(1)
            .filter_map(|rest| rest.split_once("]`"));
        quoted.map(|(key, _)| key).filter(|key| is_key(key))
    })
}

/// Letters and digits, a capital first and a year or number in it: not an interval, nor a link to
/// an item.
fn is_key(text: &str) -> bool {
    let word = text.chars().all(|c| c.is_ascii_alphanumeric());
    let capital = text.starts_with(|c: char| c.is_ascii_uppercase());
    word && capital && text.len() > 3 && text.contains(|c: char| c.is_ascii_digit())
}

fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for path in entries.filter_map(|entry| entry.ok().map(|e| e.path())) {
        if path.is_dir() && !path.ends_with("target") {
            rust_files(&path, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_and_citations() {
        assert_eq!(
            listed_key("- `[PBRT4]` M. Pharr"),
            Some("PBRT4"),
            "an entry"
        );
        let text =
            "/// As `[Duff2017]` and `[0, 1]` say, see [`Vec3`]\nlet x = \"`[Nobody2000]`\";";
        assert_eq!(
            citations(text).collect::<Vec<_>>(),
            ["Duff2017"],
            "comments only"
        );
    }
}
