//! Parts of pictures: crops, and renderings that go on after an interruption.

use core::time::Duration;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Instant;

use light_render::PartialPicture;
use light_scene::read_image;

use crate::program::folder::{Folder, LIT, assert_refused, stdout};

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
        "Film \"rgb\" \"integer xresolution\" 20 \"integer yresolution\" 10 \"float cropwindow\" \
         [0 .5 .2 1]\n\
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

/// Parts of pictures of other scenes, views and settings, one change each.
#[test]
fn parts_of_other_pictures_do_not_merge() {
    let folder = Folder::new("other-parts");
    let scene = folder.scene(LIT);
    let obj = fs::read_to_string(&scene).expect("a scene");
    let [a, b, out, env] = ["a.exr", "b.exr", "out.exr", "env.exr"].map(|name| folder.path(name));
    let render = |out: &str, samples: &str, more: &[&str]| {
        let args = ["render", &scene, "-o", out, "--samples", samples];
        // A flag may be there only once.
        let size = ["--width", "8"]
            .into_iter()
            .filter(|_| !more.contains(&"--width"));
        stdout(&[&args[..], &size.collect::<Vec<_>>(), more].concat());
    };
    render(&a, "0..2", &[]);
    let refuse = |aspect: &str, more: &[&str]| {
        render(&b, "2..4", more);
        assert_refused(
            &["merge", &a, &b, "-o", &out],
            &["b.exr: ", "same picture", aspect],
        );
    };
    for (aspect, mtl) in [
        ("materials", LIT.replace("Ke 5 4 3", "Ke 5 4 2")),
        ("materials", LIT.replace(".5 .5 .5", ".5 .5 .4")),
    ] {
        folder.file("scene.mtl", &mtl);
        refuse(aspect, &[]);
    }
    folder.scene(LIT);
    folder.file("scene.obj", &obj.replace("v -.2 1 -.2", "v -.2 1 -.21"));
    refuse("geometry", &[]);
    folder.file("scene.obj", &obj);
    for texel in [1.0, 2.0] {
        let texels = [1.0, texel].map(light_scene::glam::Vec3::splat).into();
        let image = light_scene::Image::new(2, 1, texels).expect("an image");
        light_scene::write_image(Path::new(&env), &image).expect("written");
        refuse("lights", &["--env", &env]);
        render(&a, "0..2", &["--env", &env]);
    }
    render(&a, "0..2", &[]);
    for (aspect, more) in [
        ("materials", ["--emit", "floor=1,1,1"]),
        ("camera", ["--fov", "30"]),
        ("camera", ["--look-at", "0,2,4,0,0,0,0,1,0"]),
        ("size", ["--width", "9"]),
        ("crop", ["--crop", "0,0.5,0,1"]),
        ("seed", ["--seed", "1"]),
        ("depth", ["--max-depth", "3"]),
        ("estimator", ["--estimator", "light"]),
        ("light samples", ["--light-samples", "3"]),
        ("light sampler", ["--light-sampler", "power"]),
        ("integrator", ["--integrator", "volpath"]),
    ] {
        refuse(aspect, &more);
    }
    render(&b, "2..4", &["--threads", "1", "--time", "100"]);
    stdout(&["merge", &a, &b, "-o", &out]);
}

#[test]
fn parts_and_checkpoints_with_flipped_bits_are_refused() {
    let folder = Folder::new("flipped");
    let scene = folder.scene(LIT);
    let [part, out] = ["part.exr", "out.exr"].map(|name| folder.path(name));
    let render = ["render", &scene, "-o", &out, "--width", "12", "--spp", "2"];
    stdout(&[&render[..], &["--checkpoint", &part]].concat());
    let whole = bytes(&part);
    let path = Path::new(&part);
    assert!(
        PartialPicture::parse(path, &whole).is_ok(),
        "as it was written"
    );
    let bits = 8 * whole.len();
    // Bits all over the file, at places without a pattern.
    for bit in (0..2000).map(|i| i * 7919 % bits) {
        let mut broken = whole.clone();
        broken[bit / 8] ^= 1 << (bit % 8);
        let error = PartialPicture::parse(path, &broken);
        assert!(error.is_err(), "bit {bit} of {bits}");
    }
    let mut broken = whole;
    let middle = broken.len() / 2;
    broken[middle] ^= 1;
    fs::write(&part, broken).expect("a file");
    let words = ["part.exr", "damaged"];
    assert_refused(&["merge", &part, "-o", &out], &words);
    let on = ["render", &scene, "-o", &out, "--width", "12", "--spp", "4"];
    assert_refused(&[&on[..], &["--checkpoint", &part]].concat(), &words);
}
