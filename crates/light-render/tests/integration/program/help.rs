//! What the program says of itself.

use std::path::Path;

use light_scene::BuiltinScene;

use crate::program::folder::{Folder, assert_refused, stdout};

#[test]
fn help_has_examples_values_and_exit_codes() {
    let help = stdout(&["--help"]);
    for word in ["Examples:", "Exit status:", "bad usage or bad input", "130"] {
        assert!(help.contains(word), "{word} in {help}");
    }
    let render = stdout(&["render", "--help"]);
    for word in ["Examples:", "lights render", "Exit status:", "130"] {
        assert!(render.contains(word), "{word} in {render}");
    }
    for scene in BuiltinScene::ALL {
        let name = scene.name().trim_end_matches("-large");
        assert!(render.contains(name), "{name} in {render}");
    }
    // Of every choice the values.
    for value in [
        "bvh-reference",
        "exhaustive",
        "single-scattering-classic",
        "mis",
        "cells",
        "pilot",
        "groups",
        "clear-noon",
        "reinhard",
    ] {
        assert!(render.contains(value), "{value} in {render}");
    }
    let bench = stdout(&["bench", "--help"]);
    for value in [
        "clusters",
        "stadium",
        "one-point",
        "bvh-morton",
        "Columns:",
        "ns/pmf",
        "V within",
    ] {
        assert!(bench.contains(value), "{value} in {bench}");
    }
    let median = stdout(&["env", "median-cut", "--help"]);
    assert!(
        median.contains("squared") && median.contains("Examples:"),
        "{median}"
    );
}

#[test]
fn completions_and_a_man_page_are_printed() {
    for (shell, word) in [
        ("bash", "complete -F"),
        ("zsh", "#compdef lights"),
        ("fish", "complete -c lights"),
        ("powershell", "Register-ArgumentCompleter"),
        ("elvish", "edit:completion"),
    ] {
        let script = stdout(&["completions", shell]);
        for word in [word, "light-sampler", "median-cut"] {
            assert!(script.contains(word), "{word} of {shell}");
        }
        // Values are completed where the shell's scripts know them.
        let knows_values = matches!(shell, "bash" | "zsh" | "fish");
        let value = "clear-noon";
        assert!(
            script.contains(value) || !knows_values,
            "{value} of {shell}"
        );
    }
    let page = stdout(&["completions", "man"]);
    for word in [
        ".TH",
        ".SH \"LIGHTS RENDER\"",
        ".SH \"LIGHTS ENV MEDIAN-CUT\"",
        "light\\-sampler",
        "Exit status",
    ] {
        assert!(page.contains(word), "{word} in {page}");
    }
    assert!(!page.contains("LIGHTS HELP"), "no help of the help");
    assert_eq!(stdout(&["man"]), page, "by a command of its own");
    assert_refused(&["completions", "tcsh"], &["tcsh", "zsh", "man"]);
}

/// A mirror that a lamp is seen in, by paths of two segments, and of one that the file asks for.
#[test]
fn the_depth_of_a_file_is_the_default() {
    let folder = Folder::new("depths");
    let scene = |integrator: &str| {
        let mirror = "Material \"conductor\" Translate 0 0 4 Scale 9 9 1";
        let quad = "Shape \"bilinearmesh\" \"point3 P\" [-1 -1 0 1 -1 0 -1 1 0 1 1 0]";
        let lamp = "LightSource \"infinite\"";
        folder.file(
            "a.pbrt",
            &format!("{integrator} Camera \"perspective\" WorldBegin {lamp} {mirror} {quad}"),
        )
    };
    let out = folder.path("a.exr");
    let mean = |integrator: &str, more: &[&str]| {
        let args = [
            "render",
            &scene(integrator),
            "-o",
            &out,
            "--spp",
            "1",
            "--quiet",
        ];
        stdout(&[&args, more, &["--width", "4", "--height", "4"]].concat());
        let image = light_scene::read_image(Path::new(&out));
        image.expect("a picture").image.mean().x
    };
    let short = "Integrator \"path\" \"integer maxdepth\" 0";
    assert!(mean("", &[]) > 0.5, "the sky in the mirror");
    assert_eq!(mean(short, &[]), 0.0, "emitters alone, as the file says");
    assert!(
        mean(short, &["--max-depth", "2"]) > 0.5,
        "the command line counts first"
    );
}
