//! Pages of the project that show what was measured.

use std::fs;
use std::path::{Path, PathBuf};

/// Where every table ends.
const END: &str = "<!-- end of the table -->";

/// The project's root folder.
#[must_use]
pub fn root() -> PathBuf {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR"));
    manifest.parent().unwrap_or(manifest).to_path_buf()
}

/// Writes `table` into a page, given by its path from the root, in place of the table there that
/// the same command of xtask made.
///
/// # Errors
/// A page that cannot be read or written, or that has no place for the table.
pub fn write_table(page: &str, command: &str, table: &str) -> Result<(), String> {
    let path = root().join(page);
    let text = fs::read_to_string(&path).map_err(|e| format!("{page}: {e}"))?;
    let text = replaced(&text, command, table)
        .ok_or_else(|| format!("{page}: no place for the table of cargo xtask {command}"))?;
    fs::write(&path, text).map_err(|e| format!("{page}: {e}"))
}

/// The table that a command of xtask made, of a page given by its path from the root.
///
/// # Errors
/// A page that cannot be read, or that has no place for the table.
pub fn read_table(page: &str, command: &str) -> Result<String, String> {
    let text = fs::read_to_string(root().join(page)).map_err(|e| format!("{page}: {e}"))?;
    let table = table_in(&text, command)
        .ok_or_else(|| format!("{page}: no place for the table of cargo xtask {command}"))?;
    Ok(table.to_owned())
}

/// The table between the marks of a command; none without marks.
fn table_in<'a>(page: &'a str, command: &str) -> Option<&'a str> {
    let (_, rest) = page.split_once(&format!("<!-- cargo xtask {command} -->"))?;
    let (table, _) = rest.split_once(END)?;
    Some(table.trim())
}

/// The page with another table between the marks of a command; none without marks.
fn replaced(page: &str, command: &str, table: &str) -> Option<String> {
    let begin = format!("<!-- cargo xtask {command} -->");
    let (before, rest) = page.split_once(&begin)?;
    let (_, after) = rest.split_once(END)?;
    Some(format!("{before}{begin}\n\n{table}\n{END}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_table_is_replaced() {
        let begin = "<!-- cargo xtask bench --table refits -->";
        let page = format!("a\n{begin}\nold\n{END}\nb\n{END}\n");
        let page = replaced(&page, "bench --table refits", "new\n").expect("marks");
        let expected = format!("a\n{begin}\n\nnew\n\n{END}\nb\n{END}\n");
        assert_eq!(page, expected, "the rest stays");
        assert_eq!(table_in(&page, "bench --table refits"), Some("new"), "it");
        assert_eq!(replaced("a", "bench --table refits", "new\n"), None, "none");
    }
}
