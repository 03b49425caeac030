//! Lights that are too strong for the numbers of the program: the file, the flag and the rule.

use light_scene::glam::Vec3;
use light_scene::{Image, write_image};

use crate::program::folder::{Folder, LIT, assert_refused};

#[test]
fn the_flag_that_makes_a_light_too_strong_is_named() {
    let folder = Folder::new("too-strong");
    let scene = folder.scene(LIT);
    let sky = folder.path("sky.exr");
    let texels = vec![Vec3::splat(10.0); 8];
    let image = Image::new(4, 2, texels).expect("an image");
    write_image(sky.as_ref(), &image).expect("written");
    let out = folder.path("a.exr");
    let render = ["render", &scene, "-o", &out, "--width", "4", "--spp", "1"];
    for command in [&["info", &scene][..], &render] {
        let refused =
            |more: &[&str], words: &[&str]| assert_refused(&[command, more].concat(), words);
        let in_file = |path: &str, flag: &str| format!("lights: {path}: {flag}: ");
        for factor in ["1e38", "3e38"] {
            let flag = format!("--light-scale {factor}");
            refused(
                &["--light-scale", factor],
                &[&in_file(&scene, &flag), "lamp: mesh light, "],
            );
        }
        let flag = "--env-scale 1e38";
        let words = [
            &in_file(&sky, flag),
            "image infinite light, amount: must be ",
        ];
        refused(
            &["--env", &sky, "--env-scale", "1e38"],
            &words.map(|w| w as &str),
        );
        let words = [&in_file(&scene, flag), "light 0: image infinite light, "];
        refused(
            &["--sky", "overcast", "--env-scale", "1e38"],
            &words.map(|w| w as &str),
        );
    }
}

#[test]
fn flags_that_make_no_camera_or_light_are_named() {
    let folder = Folder::new("named-flags");
    let scene = folder.scene(LIT);
    let out = folder.path("a.exr");
    let render = ["render", &scene, "-o", &out];
    for (flag, value, expected) in [
        ("--fov", "180", "between 0 and 180"),
        ("--width", "99999999", "--width, --height: the picture must"),
        (
            "--spp",
            "1e3",
            "expected a whole number from 1 to 4294967295",
        ),
        ("--emit", "lamp=1,-1,1", "expected a radiance of at least 0"),
    ] {
        assert_refused(&[&render[..], &[flag, value]].concat(), &[flag, expected]);
    }
}

#[test]
fn more_parts_of_a_job_than_samples_are_refused_by_their_flag() {
    let folder = Folder::new("many-parts");
    let scene = folder.scene(LIT);
    let job = folder.path("job");
    let farm = ["farm", &scene, "--engine", "slurm", "-o", &job];
    let many = ["--parts", "9", "--spp", "8"];
    let words = ["--parts 9: expected at most 8 parts, one a sample"];
    assert_refused(&[&farm[..], &many].concat(), &words);
}

/// Single lights are finite, their sum over a large scene is not.
#[test]
fn lights_that_cannot_be_chosen_from_name_the_scene() {
    let folder = Folder::new("no-choice");
    let corners = "v -1e15 0 0\nv 1e15 0 0\nv 0 1e15 0\n";
    let scene = folder.file("far.obj", &format!("{corners}f 1 2 3\n"));
    let sky = [
        "--sky",
        "overcast",
        "--env-scale",
        "1e20",
        "--light-sampler",
        "power",
    ];
    let out = folder.path("a.exr");
    let render = ["render", &scene, "-o", &out, "--width", "4", "--spp", "1"];
    let start = format!("lights: {scene}: light 0: ");
    assert_refused(&[&render[..], &sky].concat(), &[&start]);
}
