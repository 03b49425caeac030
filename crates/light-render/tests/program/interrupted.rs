//! Parts of pictures: crops, and renderings that go on after an interruption.

use core::time::Duration;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Instant;

use light_render::PartialPicture;
use light_scene::read_image;

use crate::folder::{Folder, LIT, assert_refused, stdout};

fn bytes(path: &str) -> Vec<u8> {
    fs::read(path).expect("a picture")
}

#[test]
fn a_crop_is_a_part_of_the_picture() {
    let folder = Folder::new("crop");
    let scene = folder.scene(LIT);
    let [whole, part] = ["whole.exr", "part.exr"].map(|name| folder.path(name));
    let render = |out: &str, more: &[&str]| {
        let size = ["--width", "16", "--height", "8", "--spp", "3"];
        stdout(&[&["render", &scene, "-o", out], &size[..], more].concat());
    };
    render(&whole, &[]);
    render(&part, &["--crop", "0.25,0.75,0.5,1"]);
    let read = |path: &str| read_image(Path::new(path)).expect("a picture").image;
    let (whole, part) = (read(&whole), read(&part));
    assert_eq!((part.width(), part.height()), (8, 4), "half of each side");
    for (x, y) in (0..4).flat_map(|y| (0..8).map(move |x| (x, y))) {
        assert_eq!(part.texel(x, y), whole.texel(4 + x, 4 + y), "{x}, {y}");
    }
    let out = folder.path("x.exr");
    let wrong = ["render", &scene, "-o", &out, "--crop", "0.5,0.5,0,1"];
    assert_refused(&wrong, &["--crop"]);
    let nothing = ["--width", "4", "--crop", "0.3,0.4,0,1"];
    assert_refused(
        &[&["render", &scene, "-o", &out], &nothing[..]].concat(),
        &["crop"],
    );
}

#[test]
fn the_crop_of_a_file_counts() {
    let folder = Folder::new("film-crop");
    let scene = folder.file(
        "crop.pbrt",
        "Film \"rgb\" \"integer xresolution\" 20 \"integer yresolution\" 10 \"float cropwindow\" [0 .5 .2 1]\n\
         Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\nShape \"sphere\"\n",
    );
    let out = folder.path("out.exr");
    let size = |more: &[&str]| {
        stdout(
            &[
                &["render", &scene, "-o", &out, "--quiet", "--spp", "1"],
                more,
            ]
            .concat(),
        );
        let image = read_image(Path::new(&out)).expect("a picture").image;
        (image.width(), image.height())
    };
    assert_eq!(size(&[]), (10, 8), "as the file says");
    assert_eq!(
        size(&["--width", "40"]),
        (20, 16),
        "the same part of a larger picture"
    );
    assert_eq!(size(&["--crop", "0,1,0,1"]), (20, 10), "all of it");
}

#[test]
fn a_checkpoint_goes_on_to_the_same_bits() {
    let folder = Folder::new("checkpoint");
    let scene = folder.scene(LIT);
    let [whole, out, kept] = ["whole.exr", "out.exr", "kept.exr"].map(|name| folder.path(name));
    let render = |out: &str, more: &[&str]| {
        stdout(&[&["render", &scene, "-o", out, "--width", "12"], more].concat());
    };
    render(&whole, &["--spp", "9"]);
    render(&out, &["--spp", "4", "--checkpoint", &kept]);
    assert_ne!(bytes(&out), bytes(&whole), "four samples are not nine");
    render(
        &out,
        &[
            "--spp",
            "9",
            "--checkpoint",
            &kept,
            "--checkpoint-every",
            "1e-3",
        ],
    );
    assert_eq!(bytes(&out), bytes(&whole), "as if rendered at once");
    let refuse = |more: &[&str], words: &[&str]| {
        let args = [
            "render",
            &scene,
            "-o",
            &out,
            "--width",
            "12",
            "--checkpoint",
            &kept,
        ];
        assert_refused(&[&args[..], more].concat(), words);
    };
    refuse(&["--spp", "3"], &["kept.exr", "at most 3", "9"]);
    refuse(
        &["--spp", "9", "--seed", "1"],
        &["kept.exr", "same picture"],
    );
    fs::write(&kept, "no picture").expect("a file");
    refuse(&["--spp", "9"], &["kept.exr"]);
}

#[test]
fn a_killed_rendering_goes_on() {
    let folder = Folder::new("killed");
    let scene = folder.scene(LIT);
    let [whole, out, kept] = ["whole.exr", "out.exr", "kept.exr"].map(|name| folder.path(name));
    let args = [
        "render",
        &scene,
        "-o",
        &out,
        "--width",
        "12",
        "--checkpoint",
        &kept,
    ];
    let mut child = Command::new(env!("CARGO_BIN_EXE_lights"))
        .args(args)
        .args(["--spp", "4000000", "--checkpoint-every", "0.05"])
        .stdout(Stdio::null())
        .spawn()
        .expect("the program runs");
    let patience = Instant::now();
    while !Path::new(&kept).exists() && patience.elapsed() < Duration::from_secs(60) {
        sleep(Duration::from_millis(20));
    }
    child.kill().expect("still running");
    child.wait().expect("ended");
    assert!(!Path::new(&out).exists(), "no picture yet");
    let part = PartialPicture::read(Path::new(&kept)).expect("whole");
    let done = part.samples.end;
    let spp = (done + 5).to_string();
    stdout(&[&args[..], &["--spp", &spp]].concat());
    stdout(&[
        "render", &scene, "-o", &whole, "--width", "12", "--spp", &spp,
    ]);
    assert_eq!(bytes(&out), bytes(&whole), "{done} samples were kept");
}
