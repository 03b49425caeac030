//! Skies, scales and exposures of the command line, and what is said of pictures without light.

use std::fs;
use std::path::Path;

use light_scene::{Image, read_image};
use lights::glam::Vec3;

use crate::program::folder::{Folder, LIT, SMALL, UNLIT, assert_refused, lights, stdout};

/// What the program says of a picture on standard error.
fn words(args: &[&str]) -> String {
    let output = lights(&[args, &SMALL[..]].concat());
    let error = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(0), "{args:?}: {error}");
    error
}

fn picture(path: &str) -> Image {
    read_image(Path::new(path)).expect("a picture").image
}

fn mean(path: &str) -> Vec3 {
    picture(path).mean()
}

/// A floor that a camera looks down on.
const DOWN: &str = "0,3,0,0,0,0,0,0,1";

#[test]
fn scenes_without_light_get_a_sky_and_say_so() {
    let folder = Folder::new("dark");
    let scene = folder.scene(UNLIT);
    let out = folder.path("a.exr");
    let said = words(&["render", &scene, "-o", &out]);
    assert_eq!(said.lines().count(), 1, "{said}");
    for word in ["no light in the scene", "`overcast`", "--sky", "--env"] {
        assert!(said.contains(word), "{word} in {said}");
    }
    assert!(
        mean(&out).min_element() > 0.01,
        "a picture that is not black"
    );
    let named = folder.path("b.exr");
    let said = words(&["render", &scene, "-o", &named, "--sky", "overcast"]);
    assert_eq!(said, "", "it was asked for");
    assert_eq!(picture(&out), picture(&named), "the same sky");
    let quiet = words(&["render", &scene, "-o", &out, "--quiet"]);
    assert_eq!(quiet, "", "nothing is said");
    let lit = words(&["render", &folder.scene(LIT), "-o", &out]);
    assert_eq!(lit, "", "a scene with light of its own keeps it");
}

#[test]
fn clipped_radiance_is_said() {
    let folder = Folder::new("clipped");
    let scene = folder.scene(LIT);
    let out = folder.path("a.exr");
    let render = ["render", &scene, "-o", &out, "--light-scale", "1e20"];
    let said = words(&render);
    assert_eq!(said.lines().count(), 1, "{said}");
    let clipped = picture(&out)
        .texels()
        .iter()
        .filter(|&&c| c.max_element() > 1e13)
        .count();
    for word in [
        "above 7.0e13",
        "--light-scale",
        &format!("in {clipped} pixels"),
    ] {
        assert!(said.contains(word), "{word} in {said}");
    }
}

#[test]
fn scenes_of_black_lights_stay_black() {
    let folder = Folder::new("black_lights");
    let scene = folder.file(
        "a.pbrt",
        "Camera \"perspective\" WorldBegin LightSource \"point\" \"rgb I\" [ 0 0 0 ]
         Translate 0 0 3 Shape \"sphere\"",
    );
    let out = folder.path("a.exr");
    for sampler in ["bvh", "uniform", "power"] {
        let said = words(&["render", &scene, "-o", &out, "--light-sampler", sampler]);
        assert!(said.contains("gives no light"), "{said}");
        assert!(!said.contains("sky `"), "{said}");
        assert_eq!(mean(&out), Vec3::ZERO, "{sampler}");
    }
}

#[test]
fn skies_replace_those_of_the_scene() {
    let folder = Folder::new("skies");
    let scene = folder.file(
        "a.pbrt",
        "Camera \"perspective\" WorldBegin LightSource \"infinite\" \"rgb L\" [ 7 0 0 ]",
    );
    let out = folder.path("a.exr");
    for (sky, expected) in [
        ("uniform", Some(Vec3::ONE)),
        ("clear-noon", None),
        ("overcast", None),
    ] {
        words(&["render", &scene, "-o", &out, "--sky", sky]);
        let found = mean(&out);
        assert!(found.x < 2.0 && found.y > 0.05, "{sky} alone: {found}");
        if let Some(expected) = expected {
            assert!(found.distance(expected) < 1e-5, "{sky}: {found}");
        }
    }
    let report = stdout(&["info", &scene, "--sky", "clear-noon", "--json"]);
    assert!(
        report.contains("\"sun\"") && !report.contains("uniform sky"),
        "{report}"
    );
    assert_refused(
        &["render", &scene, "-o", &out, "--sky", "night"],
        &["--sky", "uniform", "clear-noon", "overcast"],
    );
}

/// Twice the light is twice the picture, to the last bit; each factor acts on its own lights.
#[test]
fn lights_and_skies_are_scaled() {
    let folder = Folder::new("scales");
    let scene = folder.scene(LIT);
    let render = |name: &str, more: &[&str]| {
        let out = folder.path(name);
        words(&[&["render", &scene, "-o", &out, "--look-at", DOWN], more].concat());
        picture(&out)
    };
    let twice = |image: &Image| image.texels().iter().map(|t| *t * 2.0).collect::<Vec<_>>();
    let plain = render("a.exr", &[]);
    let brighter = render("b.exr", &["--light-scale", "2"]);
    assert_eq!(brighter.texels(), twice(&plain), "lamps");
    assert_eq!(
        render("c.exr", &["--env-scale", "2"]),
        plain,
        "there is no sky"
    );
    let sky = render("d.exr", &["--sky", "uniform"]);
    let both = ["--sky", "uniform", "--env-scale", "2", "--light-scale", "2"];
    let both = render("e.exr", &both);
    assert_eq!(both.texels(), twice(&sky), "all");
}

/// Parts of pictures with other light do not add up.
#[test]
fn scales_belong_to_the_picture() {
    let folder = Folder::new("scaled_parts");
    let scene = folder.scene(LIT);
    let [a, b, c, merged] = ["a.exr", "b.exr", "c.exr", "d.exr"].map(|name| folder.path(name));
    let render = |out: &str, samples: &str, more: &[&str]| {
        let args = [
            "render",
            &scene,
            "-o",
            out,
            "--width",
            "12",
            "--samples",
            samples,
        ];
        stdout(&[&args, more].concat());
    };
    render(&a, "0..2", &[]);
    render(&b, "2..4", &["--light-scale", "2"]);
    render(&c, "2..4", &["--exposure", "3", "--tone-map", "clip"]);
    assert_refused(&["merge", &a, &b, "-o", &merged], &["b.exr", "materials"]);
    stdout(&["merge", &a, &c, "-o", &merged]);
    for more in [
        &["--sky", "uniform"][..],
        &["--sky", "uniform", "--env-scale", "2"],
    ] {
        render(&b, "2..4", more);
        assert_refused(&["merge", &a, &b, "-o", &merged], &["b.exr", "lights"]);
    }
}

/// How bright a screen shows the picture, from 0 to 1.
fn shown(folder: &Folder, scene: &str, more: &[&str]) -> f32 {
    let out = folder.path("shown.png");
    words(&[&["render", scene, "-o", &out, "--look-at", DOWN], more].concat());
    mean(&out).y
}

#[test]
fn exposures_change_what_is_shown() {
    let folder = Folder::new("exposures");
    let scene = folder.scene(UNLIT);
    let sky = ["--sky", "uniform"];
    let shown = |more: &[&str]| shown(&folder, &scene, &[&sky, more].concat());
    let auto = shown(&[]);
    assert!(
        (shown(&["--exposure", "auto"]) - auto).abs() < 1e-6,
        "the default"
    );
    assert!((0.05..0.6).contains(&auto), "middle grey, about: {auto}");
    let dark = shown(&["--exposure", "-3"]);
    let darker = shown(&["--exposure", "-4"]);
    assert!(
        (dark / darker - 2.0).abs() < 0.2,
        "a stop: {dark} and {darker}"
    );
    let clipped = shown(&["--exposure", "1", "--tone-map", "clip"]);
    let rolled = shown(&["--exposure", "1", "--tone-map", "reinhard"]);
    assert!(clipped > rolled, "{clipped} and {rolled}");
    let out = folder.path("a.exr");
    words(&["render", &scene, "-o", &out, "--sky", "uniform"]);
    let bytes = fs::read(&out).expect("a picture");
    words(&[
        "render",
        &scene,
        "-o",
        &out,
        "--sky",
        "uniform",
        "--exposure",
        "5",
    ]);
    assert_eq!(
        fs::read(&out).expect("a picture"),
        bytes,
        "a file of record stays linear"
    );
    for bad in ["much", "nan", "1000"] {
        let args = ["render", &scene, "-o", &out, "--exposure", bad];
        assert_refused(&args, &["--exposure", "auto"]);
    }
}

#[test]
fn pictures_that_show_nothing_say_what_to_try() {
    let folder = Folder::new("nothing_shown");
    let scene = folder.scene(LIT);
    let (exr, png) = (folder.path("a.exr"), folder.path("a.png"));
    let away = ["--look-at", "0,5,0,0,9,0,0,0,1"];
    let said = words(&[&["render", &scene, "-o", &exr], &away[..]].concat());
    assert_eq!(said.lines().count(), 1, "{said}");
    assert!(
        said.contains("black") && said.contains("--look-at"),
        "{said}"
    );
    let down = ["--look-at", "0,.5,0,0,0,0,0,0,1", "--fov", "20"];
    for (exposure, word) in [("-30", "all black"), ("30", "all white")] {
        let args = ["render", &scene, "-o", &png, "--exposure", exposure];
        let said = words(&[&args, &down[..]].concat());
        assert!(
            said.contains(word) && said.contains("--exposure auto"),
            "{said}"
        );
        let args = ["render", &scene, "-o", &exr, "--exposure", exposure];
        assert_eq!(
            words(&[&args, &down[..]].concat()),
            "",
            "of an .exr nothing is lost"
        );
    }
}

#[test]
fn lamps_that_a_sky_outshines_are_named() {
    let folder = Folder::new("outshone");
    let scene = folder.scene(LIT);
    let out = folder.path("a.exr");
    let render = ["render", &scene, "-o", &out, "--sky", "overcast"];
    assert_eq!(words(&render), "", "both are seen");
    let said = words(&[&render[..], &["--light-scale", "1e-6"]].concat());
    assert!(
        said.contains("the light of the sky") && said.contains("--env-scale"),
        "{said}"
    );
}

#[test]
fn much_white_is_named_with_its_share() {
    let folder = Folder::new("white");
    let scene = folder.scene(LIT);
    let png = folder.path("a.png");
    let bright = words(&["render", &scene, "-o", &png, "--exposure", "15"]);
    for word in [" % of the picture is white", "--exposure auto"] {
        assert!(bright.contains(word), "{word} in {bright}");
    }
    let auto = words(&["render", &scene, "-o", &png]);
    assert_eq!(auto, "", "fitted");
}

#[test]
fn files_say_how_many_samples_a_pixel_has() {
    let folder = Folder::new("pixelsamples");
    let scene = folder.file(
        "a.pbrt",
        "Sampler \"zsobol\" \"integer pixelsamples\" 3 Camera \"perspective\" WorldBegin \
         LightSource \"infinite\"",
    );
    let out = folder.path("a.exr");
    let render = ["render", &scene, "-o", &out, "--json"];
    let spp = |more: &[&str]| {
        let report = stdout(&[&render, &SMALL[..2], more].concat());
        let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
        report["spp"].as_u64()
    };
    assert_eq!(spp(&[]), Some(3), "of the file");
    assert_eq!(spp(&["--spp", "5"]), Some(5), "of the command line");
    let output = lights(&[&render[..4], &SMALL[..2]].concat());
    let said = String::from_utf8(output.stderr).expect("text");
    for word in ["3 samples a pixel", "a.pbrt", "--spp"] {
        assert!(said.contains(word), "{word} in {said}");
    }
}
