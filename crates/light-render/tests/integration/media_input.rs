//! Media in scene files: how the program renders scenes with media, and refuses invalid ones.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

/// A scene in a folder of its own, removed at its end.
struct SceneFile(PathBuf);

impl SceneFile {
    fn new(name: &str, media: &str) -> Self {
        let folder =
            std::env::temp_dir().join(format!("lights-media-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        let film = "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4";
        let shape = "Shape \"sphere\" \"float radius\" .5";
        let text = format!("{film}\n{media}\n{shape}\n");
        fs::write(folder.join("a.pbrt"), text).expect("a file");
        Self(folder)
    }

    fn render(&self, more: &[&str]) -> Output {
        let path = |name| self.0.join(name).to_str().expect("a plain path").to_owned();
        let mut command = Command::new(env!("CARGO_BIN_EXE_lights"));
        command.args([
            "render",
            &path("a.pbrt"),
            "-o",
            &path("a.exr"),
            "--spp",
            "2",
        ]);
        command.args(more).output().expect("the program runs")
    }
}

impl Drop for SceneFile {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A refusal is one line that contains all of `words`, and no picture is written.
fn assert_refused(name: &str, media: &str, more: &[&str], words: &[&str]) {
    let scene = SceneFile::new(name, media);
    let output = scene.render(more);
    let error = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(2), "{name}: {error}");
    assert_eq!(error.trim_end().lines().count(), 1, "{name}: {error}");
    for word in words {
        assert!(error.contains(word), "{name}: `{word}` in {error}");
    }
    assert!(!scene.0.join("a.exr").exists(), "{name}: no picture");
}

#[test]
fn bad_media_give_one_line() {
    let medium = |rest: &str| {
        format!("WorldBegin\nMakeNamedMedium \"m\" \"string type\" {rest}\nLightSource \"point\"")
    };
    for (name, media, words) in [
        (
            "negative",
            medium("\"homogeneous\" \"rgb sigma_a\" [ -1 1 1 ]"),
            ["a.pbrt:3:", "sigma_a"],
        ),
        (
            "nan",
            medium("\"homogeneous\" \"rgb sigma_s\" [ nan 1 1 ]"),
            ["a.pbrt:3:", "sigma_s"],
        ),
        (
            "g",
            medium("\"homogeneous\" \"float g\" 1"),
            ["a.pbrt:3:", "between -1 and 1"],
        ),
        (
            "size",
            medium("\"uniformgrid\" \"integer nx\" 3 \"float density\" [ 1 2 ]"),
            ["a.pbrt:3:", "expected 3 values"],
        ),
        (
            "unknown",
            "WorldBegin\nLightSource \"point\"\nMediumInterface \"fog\" \"\"".into(),
            ["a.pbrt:4:", "\"fog\""],
        ),
    ] {
        assert_refused(name, &media, &[], &words);
    }
}

#[test]
fn steps_without_length_are_refused() {
    let media = "WorldBegin\nLightSource \"point\"";
    for step in ["0", "-1", "nan"] {
        let more = ["--integrator", "single-scattering-classic", "--step", step];
        assert_refused("step", media, &more, &["--step", "finite number above 0"]);
    }
}

#[test]
fn a_camera_in_fog_without_end_and_a_flame_without_lights_are_rendered() {
    let fog = "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" \
        [ .1 .1 .1 ]\n\
               MediumInterface \"\" \"fog\"\nCamera \"perspective\"\nWorldBegin\n";
    let lit =
        format!("{fog}LightSource \"point\" \"point3 from\" [ 0 1 -2 ]\nLightSource \"infinite\"");
    let flame = "WorldBegin\nMakeNamedMedium \"flame\" \"string type\" \"uniformgrid\" \
        \"float density\" 5 \
                 \"float temperature\" 2000 \"rgb sigma_s\" [ 0 0 0 ]\nMediumInterface \"flame\" \
                   \"\"\nMaterial \"interface\"";
    for (name, media) in [("fog", lit.as_str()), ("flame", flame)] {
        for integrator in [
            "volpath",
            "path",
            "single-scattering",
            "single-scattering-classic",
        ] {
            let scene = SceneFile::new(name, media);
            let output = scene.render(&["--integrator", integrator, "--quiet"]);
            let error = String::from_utf8(output.stderr).expect("text");
            assert!(
                output.status.success() && error.is_empty(),
                "{name}, {integrator}: {error}"
            );
        }
    }
}
