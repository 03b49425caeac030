//! Flags that change nothing: the picture is made, and one line says so.

use crate::program::folder::{Folder, LIT, SMALL, lights, stdout};

#[test]
fn a_flag_without_effect_is_named() {
    let folder = Folder::new("no-effect");
    let scene = folder.scene(LIT);
    let sky = "Camera \"perspective\" WorldBegin LightSource \"infinite\"";
    let sky = folder.file("sky.pbrt", sky);
    let [exr, png] = ["a.exr", "a.png"].map(|name| folder.path(name));
    let said = |scene: &str, out: &str, more: &[&str]| {
        let output = lights(&[&["render", scene, "-o", out], &SMALL[..], more].concat());
        let said = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(0), "{more:?}: {said}");
        said
    };
    for (scene, out, more) in [
        (&scene, &exr, &["--step", "0.5"][..]),
        (&scene, &png, &["--half"]),
        (&sky, &exr, &["--light-samples", "4", "--estimator", "bsdf"]),
        (&scene, &exr, &["--env-scale", "2"]),
        (&sky, &exr, &["--light-scale", "2"]),
        (
            &scene,
            &exr,
            &["--estimator", "bsdf", "--integrator", "single-scattering"],
        ),
    ] {
        let words = said(scene, out, more);
        assert_eq!(words.lines().count(), 1, "{more:?}: {words}");
        for word in ["warning", more[0], "no effect"] {
            assert!(words.contains(word), "{word} in {words}");
        }
        assert_eq!(said(scene, out, &[more, &["-q"]].concat()), "", "{more:?}");
    }
    for (scene, more) in [
        (&scene, &["--half"][..]),
        (&scene, &["--light-scale", "2"]),
        (&scene, &["--light-samples", "4"]),
        (&sky, &["--env-scale", "2"]),
        (
            &scene,
            &["--integrator", "single-scattering-classic", "--step", "0.5"],
        ),
    ] {
        assert_eq!(said(scene, &exr, more), "", "{more:?} has an effect");
    }
}

/// Single scattering is that of the medium around the camera.
#[test]
fn media_that_an_integrator_does_not_reach_are_named() {
    let folder = Folder::new("missed-media");
    let fog = "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb Le\" [1 1 1]";
    let head = "LookAt 0 0 -3 0 0 0 0 1 0";
    let camera = "Camera \"perspective\"";
    let ball = "Material \"interface\" Shape \"sphere\"";
    let within = format!("{head} {camera} WorldBegin {fog} MediumInterface \"fog\" \"\" {ball}");
    let around = format!("{fog} {head} MediumInterface \"\" \"fog\" {camera} WorldBegin {ball}");
    let out = folder.path("a.exr");
    for (name, scene, integrator, is_named) in [
        ("within.pbrt", &within, "single-scattering", true),
        ("within.pbrt", &within, "single-scattering-classic", true),
        ("within.pbrt", &within, "volpath", false),
        ("around.pbrt", &around, "single-scattering", false),
    ] {
        let scene = folder.file(name, scene);
        let flags = ["render", &scene, "-o", &out, "--integrator", integrator];
        let output = lights(&[&flags[..], &SMALL].concat());
        let said = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(0), "{name}: {said}");
        let words = "warning: single scattering is that of the medium around the camera";
        assert_eq!(
            said.contains(words),
            is_named,
            "{name}, {integrator}: {said}"
        );
    }
}

/// A scene of lights alone has no box.
#[test]
fn a_scene_without_surfaces_has_no_bounds() {
    let folder = Folder::new("no-bounds");
    let scene = folder.file("a.pbrt", "WorldBegin LightSource \"point\"");
    let words = stdout(&["info", &scene]);
    assert!(words.contains("bounds     none"), "{words}");
    let line = stdout(&["info", &scene, "--json"]);
    let report: serde_json::Value = serde_json::from_str(&line).expect("one line of JSON");
    assert_eq!(report["bounds"], serde_json::Value::Null, "{line}");
}
