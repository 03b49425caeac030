//! `cargo xtask median-cut-table [IMAGE...]`: measures median-cut lights and puts the table into
//! `docs/light-sources.md`.

use std::fs;

use crate::steps::{Outcome, StepResult, cargo, output, root};

/// Where the table goes, from the root.
const PAGE: &str = "docs/light-sources.md";

const BEGIN: &str = "<!-- begin median-cut-table -->\n";
const END: &str = "<!-- end median-cut-table -->";

/// Measures on the sky that ships and on the given lat-long images.
///
/// # Errors
/// The command that failed, or a page that cannot be read or written, or has no place for the
/// table.
pub fn median_cut_table(images: &[String]) -> StepResult {
    let images = images.iter().map(|path| {
        let path = std::path::absolute(path).map_err(|error| format!("{path}: {error}"))?;
        Ok(path.into_os_string())
    });
    let images = images.collect::<Result<Vec<_>, String>>()?;
    let mut command = cargo(["run", "--quiet", "--release", "--package", "light-scene"]);
    command.args(["--example", "median_cut_table", "--"]);
    let table = output(command.args(images))?;

    let path = root().join(PAGE);
    let page = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let page = replaced(&page, &table).ok_or_else(|| format!("{PAGE}: no place for the table"))?;
    fs::write(&path, page).map_err(|error| format!("{}: {error}", path.display()))?;
    print!("{table}");
    Ok(Outcome::Passed)
}

/// The page with another table between the marks.
fn replaced(page: &str, table: &str) -> Option<String> {
    let (before, rest) = page.split_once(BEGIN)?;
    let (_, after) = rest.split_once(END)?;
    Some(format!("{before}{BEGIN}{table}{END}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_between_the_marks_changes() {
        let page = format!("a\n{BEGIN}old\n{END}\nb\n");
        let expected = format!("a\n{BEGIN}new\n{END}\nb\n");
        assert_eq!(replaced(&page, "new\n"), Some(expected), "replaced");
        assert_eq!(replaced("a", "new"), None, "no marks");
    }
}
