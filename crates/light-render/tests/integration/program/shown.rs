//! How bright pictures are shown, and what is said of those that show little.

use std::fs;

use crate::program::folder::{Folder, LIT, UNLIT, assert_refused, words};
use crate::program::light::{DOWN, mean, picture};

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
