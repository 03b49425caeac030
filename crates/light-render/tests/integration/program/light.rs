//! Skies and scales of the command line, and scenes without light.

use std::path::Path;

use light_scene::{Image, read_image};
use lights::glam::Vec3;

use crate::program::folder::{Folder, LIT, SMALL, UNLIT, assert_refused, lights, stdout, words};

pub(crate) fn picture(path: &str) -> Image {
    read_image(Path::new(path)).expect("a picture").image
}

pub(crate) fn mean(path: &str) -> Vec3 {
    picture(path).mean()
}

/// A floor that a camera looks down on.
pub(crate) const DOWN: &str = "0,3,0,0,0,0,0,0,1";

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
