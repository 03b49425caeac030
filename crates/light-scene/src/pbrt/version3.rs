//! Signs of files of pbrt-v3, which this reader does not read.

use super::file_loc::FileLoc;
use super::state::Reader;
use super::upgrade::UPGRADE;
use crate::Diagnostic;

/// Types of directives that pbrt-v3 has and pbrt-v4 does not.
const TYPES: [(&str, &[&str]); 4] = [
    ("Film", &["image"]),
    (
        "Material",
        &[
            "disney",
            "fourier",
            "glass",
            "kdsubsurface",
            "matte",
            "metal",
            "mirror",
            "plastic",
            "substrate",
            "translucent",
            "uber",
        ],
    ),
    ("Integrator", &["ao", "directlighting", "whitted"]),
    (
        "Sampler",
        &["02sequence", "lowdiscrepancy", "maxmindist", "random"],
    ),
];

/// Whether a directive of this type is one of pbrt-v3.
fn is_version_3(directive: &str, kind: &str) -> bool {
    let known = TYPES.iter().find(|(name, _)| *name == directive);
    known.is_some_and(|(_, kinds)| kinds.contains(&kind))
}

impl Reader {
    /// Remembers, and says once, that the file is one of pbrt-v3 if a directive shows it.
    pub(super) fn look_for_version_3(&mut self, at: FileLoc<'_>, directive: &str, kind: &str) {
        if !is_version_3(directive, kind) {
            return;
        }
        if !self.is_version_3 {
            let what = format!("`{directive} \"{kind}\"`:");
            self.warn_kind(at, "pbrt-v3", &what, UPGRADE);
        }
        self.is_version_3 = true;
    }

    /// The error of a file, with what to do where it is one of pbrt-v3.
    pub(super) fn explained(&self, error: Diagnostic) -> Diagnostic {
        if !self.is_version_3 || error.message.contains(UPGRADE) {
            return error;
        }
        Diagnostic {
            message: format!("{}; {UPGRADE}", error.message),
            ..error
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::parse_pbrt;
    use super::*;
    use crate::Files;

    fn warnings(text: &str) -> Vec<String> {
        let scene = parse_pbrt(Path::new("a"), text, Files::NONE).expect("a scene");
        scene.warnings.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn files_of_the_third_version_are_told_what_to_run() {
        let text = "Film \"image\" \"integer xresolution\" 9 WorldBegin Material \"diffuse\"";
        assert_eq!(
            warnings(text),
            [format!("a:1: `Film \"image\"`: {UPGRADE}")],
            "once"
        );
        let named = "WorldBegin MakeNamedMaterial \"m\" \"string type\" \"matte\"";
        let found = warnings(named);
        assert_eq!(
            found[0],
            format!("a:1: `Material \"matte\"`: {UPGRADE}"),
            "{found:?}"
        );
        assert_eq!(warnings("Film \"rgb\" WorldBegin"), [""; 0], "the fourth");
    }

    #[test]
    fn their_errors_say_so_too() {
        let error = |text: &str| {
            let scene = parse_pbrt(Path::new("a"), text, Files::NONE);
            scene.expect_err("an error").to_string()
        };
        let color = "WorldBegin Material \"matte\" \"color Kd\" [1 1 1]";
        let expected = "a:1: expected a type for `Kd`, found `color`";
        assert_eq!(
            error(color),
            format!("{expected}; {UPGRADE}"),
            "a type of pbrt-v3"
        );
        let broken = "Film \"image\" WorldBegin Shape \"plymesh\"";
        let expected = "a:1: expected \"string filename\"";
        assert_eq!(
            error(broken),
            format!("{expected}; {UPGRADE}"),
            "and any other"
        );
        assert_eq!(
            error("WorldBegin Shape \"plymesh\""),
            expected,
            "of a new file"
        );
    }
}
