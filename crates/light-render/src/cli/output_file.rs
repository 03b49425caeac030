use std::fs;
use std::path::{Path, PathBuf};

use light_scene::{Diagnostic, link_target};

use super::failure::Failure;

/// Makes sure that a file can be written to `path`, before the work whose result it will hold;
/// nothing appears there yet.
///
/// # Errors
/// When there is a folder of that name, or the file's folder is missing or cannot be written to.
pub(crate) fn expect_writable(path: &Path) -> Result<(), Failure> {
    if path.is_dir() {
        return Err(refuse(path, "cannot be written: it is a folder"));
    }
    if path.file_name().is_none() {
        return Err(refuse(path, "cannot be written: expected a file's name"));
    }
    let target = resolved(path);
    let probe = target.with_file_name(format!(".lights-{}.probe", std::process::id()));
    fs::write(&probe, [])
        .and_then(|()| fs::remove_file(&probe))
        .map_err(|error| refuse(path, format!("cannot be written: {error}")))
}

/// Makes a folder for outputs, and those that it lies in, where they are missing.
///
/// # Errors
/// When that cannot be, as where there is a file of that name.
pub(crate) fn make_folder(path: &Path) -> Result<(), Failure> {
    fs::create_dir_all(path).map_err(|error| {
        let reason = if path.is_file() {
            "expected a folder, found a file".to_owned()
        } else {
            format!("cannot be made: {error}")
        };
        refuse(path, reason)
    })
}

/// Makes sure that an image can be written to `path`, as [`expect_writable`] does.
///
/// # Errors
/// When it cannot, or the name does not end as that of an image.
pub(crate) fn expect_image(path: &Path) -> Result<(), Failure> {
    if !["exr", "hdr", "png"]
        .iter()
        .any(|ending| has_ending(path, ending))
    {
        let message = "expected an image to write: .exr, .hdr or .png";
        return Err(refuse(path, message));
    }
    expect_writable(path)
}

/// Makes sure that `path` names none of the files in `others`, however it is spelled; `role` says
/// what those are.
///
/// # Errors
/// When it does.
pub(crate) fn expect_another(path: &Path, others: &[PathBuf], role: &str) -> Result<(), Failure> {
    let own = resolved(path);
    if others.iter().any(|other| resolved(other) == own) {
        let message = format!("expected another file than {role}");
        return Err(refuse(path, message));
    }
    Ok(())
}

/// Whether the name of a file ends in `.` and `ending`, in capitals or not.
pub(crate) fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension()
        .is_some_and(|own| own.eq_ignore_ascii_case(ending))
}

/// Makes sure that the name of an output ends in one of `endings`, or in none, as devices do.
///
/// # Errors
/// When it ends otherwise.
pub(crate) fn expect_ending(path: &Path, endings: &[&str]) -> Result<(), Failure> {
    if path.extension().is_none() {
        return Ok(());
    }
    if endings.iter().any(|ending| has_ending(path, ending)) {
        return Ok(());
    }
    let endings: Vec<String> = endings.iter().map(|ending| format!(".{ending}")).collect();
    let message = format!("expected a file name that ends in {}", endings.join(" or "));
    Err(refuse(path, message))
}

/// The one name of a file, through all links; of one that is not there yet in the one name of its
/// folder.
fn resolved(path: &Path) -> PathBuf {
    if let Ok(path) = fs::canonicalize(path) {
        return path;
    }
    let path = &link_target(path).unwrap_or_else(|_| path.to_path_buf());
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    match (fs::canonicalize(folder), path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path.to_path_buf(),
    }
}

/// The failure of a file, in words.
pub(crate) fn refuse(path: &Path, message: impl Into<String>) -> Failure {
    Failure::input(Diagnostic::file(path, message))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spellings_of_one_file_are_one() {
        let same = |a: &str, b: &str| expect_another(Path::new(a), &[b.into()], "it").is_err();
        assert!(same("a.exr", "a.exr"), "as it is");
        assert!(same("a.exr", "./a.exr"), "in this folder");
        assert!(same("src/../a.exr", "a.exr"), "there and back");
        assert!(
            same("Cargo.toml", "src/../Cargo.toml"),
            "a file that is there"
        );
        assert!(!same("a.exr", "b.exr"), "another");
        assert!(!same("src/a.exr", "a.exr"), "elsewhere");
    }

    #[test]
    fn endings_are_those_that_are_written() {
        let is_fine = |path: &str| expect_ending(Path::new(path), &["html", "htm"]).is_ok();
        assert!(is_fine("a.html") && is_fine("a.HTM"), "of either case");
        assert!(is_fine("/dev/null") && is_fine("page"), "none");
        assert!(!is_fine("a.txt") && !is_fine("a.html.txt"), "another");
    }
}
