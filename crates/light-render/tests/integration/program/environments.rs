//! Environment maps: read, cut into lights, converted.

use std::fs;
use std::path::Path;

use light_scene::glam::Vec3;
use light_scene::{ChannelFile, Image, read_image, write_image};

use crate::program::folder::{Folder, SMALL, UNLIT, assert_refused, lights, stdout};

/// An environment of 4 by 2 texels, one of which is `texel`.
fn environment(folder: &Folder, texel: f32) -> String {
    let path = folder.path("env.exr");
    let mut numbers = vec![1.0; 8];
    numbers[6] = texel;
    let file = ChannelFile {
        width: 4,
        height: 2,
        channels: ["R", "G", "B"]
            .map(|name| (name.into(), numbers.clone()))
            .into(),
        ..ChannelFile::default()
    };
    file.write(Path::new(&path)).expect("an image");
    path
}

#[test]
fn environments_are_clamped_or_refused() {
    let folder = Folder::new("environment");
    let scene = folder.scene(UNLIT);
    let out = folder.path("out.exr");
    let env = environment(&folder, f32::NAN);
    assert_refused(
        &["render", &scene, "-o", &out, "--env", &env],
        &["env.exr", "2, 1"],
    );
    assert_refused(&["compare", &env, &env], &["env.exr"]);
    environment(&folder, -3.0);
    let args = ["render", &scene, "-o", &out, "--env", &env];
    let output = lights(&[&args[..], &SMALL].concat());
    let warning = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "clamped: {warning}");
    assert!(
        warning.contains("1 of 8") && warning.lines().count() == 1,
        "and counted: {warning}"
    );
    let quiet = lights(&[&args[..], &SMALL, &["-q"]].concat());
    assert!(quiet.stderr.is_empty(), "unless nobody wants to know");
}

/// Texel 6 looks to (-1, -1, 1) where up is y: a quarter turn to the left of that, seen from above,
/// is (1, -1, 1).
#[test]
fn environments_are_turned_about_what_is_up() {
    let folder = Folder::new("turned");
    let env = environment(&folder, 8.0);
    let out = folder.path("out.exr");
    let camera = "Camera \"perspective\" WorldBegin";
    let y_up = folder.file("y.pbrt", camera);
    let z_up = format!("LookAt 0 0 0 1 0 0 0 0 1 {camera}");
    let z_up = folder.file("z.pbrt", &z_up);
    for (scene, degrees, look_at, expected) in [
        (&y_up, "0", "0,0,0,-1,-1,1,0,1,0", 8.0),
        (&y_up, "90", "0,0,0,-1,-1,1,0,1,0", 1.0),
        (&y_up, "90", "0,0,0,1,-1,1,0,1,0", 8.0),
        (&y_up, "-90", "0,0,0,-1,-1,-1,0,1,0", 8.0),
        (&z_up, "0", "0,0,0,-1,-1,-1,0,0,1", 8.0),
        (&z_up, "90", "0,0,0,1,-1,-1,0,0,1", 8.0),
    ] {
        let args = ["render", scene, "-o", &out, "--env", &env, "--fov", "5"];
        let turned = ["--look-at", look_at, "--env-rotate", degrees];
        stdout(&[&args[..], &turned, &SMALL].concat());
        let found = read_image(Path::new(&out)).expect("a picture").image.mean();
        let off = found.distance(Vec3::splat(expected));
        assert!(off < 1e-3, "{scene} {degrees} {look_at}: {found}");
    }
    let alone = ["render", &y_up, "-o", &out, "--env-rotate", "90"];
    assert_refused(&alone, &["--env <IMAGE>"]);
}

/// A map is the same sky in either form, as `env convert` makes one of the other.
#[test]
fn a_square_environment_is_equal_area() {
    let folder = Folder::new("square-sky");
    let scene = folder.file("a.pbrt", "Camera \"perspective\" WorldBegin");
    let [map, square, out] = ["map.exr", "square.exr", "out.exr"].map(|name| folder.path(name));
    // Another colour for each octant, and twice as many texels as the picture needs.
    let texel = |x: u32, y: u32| Vec3::new(1.0 + (x / 64) as f32, 1.0 + (y / 64) as f32, 1.0);
    let texels = (0..128).flat_map(|y| (0..256).map(move |x| texel(x, y)));
    let image = Image::new(256, 128, texels.collect()).expect("a map");
    write_image(Path::new(&map), &image).expect("written");
    stdout(&["env", "convert", &map, &square]);
    for toward in ["1,1,1", "-1,1,1", "-1,-1,1", "1,-1,1", "1,1,-1", "-1,-1,-1"] {
        let look_at = format!("0,0,0,{toward},0,1,0");
        let color = |env: &str| {
            let args = ["render", &scene, "-o", &out, "--env", env, "--fov", "20"];
            let turned = ["--look-at", &look_at, "--env-rotate", "10"];
            let done = lights(&[&args[..], &turned, &SMALL].concat());
            assert!(done.status.success() && done.stderr.is_empty(), "{env}");
            read_image(Path::new(&out)).expect("a picture").image.mean()
        };
        let off = color(&square).distance(color(&map));
        assert!(off < 0.01, "{toward}: {off}");
    }
}

/// An environment of another shape is lat-long; a line says so.
#[test]
fn environments_of_another_shape_are_doubted() {
    let folder = Folder::new("doubted-shape");
    let scene = folder.file("a.pbrt", "Camera \"perspective\" WorldBegin");
    let [map, wide, out] = ["map.exr", "wide.exr", "out.exr"].map(|name| folder.path(name));
    write_map(&map, 64, 32);
    write_map(&wide, 48, 32);
    let doubt = |env: &str| {
        let args = ["render", &scene, "-o", &out, "--env", env];
        let done = lights(&[&args[..], &SMALL].concat());
        assert!(done.status.success(), "{env}");
        let said = String::from_utf8_lossy(&done.stderr).into_owned();
        said.contains("a square (equal-area), found 48 x 32; it is taken as lat-long")
    };
    assert!(!doubt(&map), "lat-long");
    assert!(doubt(&wide), "neither");
}

#[test]
fn suggestions_stand_apart() {
    let wrong = ["render", "night", "-o", "a.png", "--env-turn", "90"];
    assert_refused(&wrong, &["'--env-turn' found; tip: "]);
    let unlike = ["render", "night", "-o", "a.png", "--hdri", "sky.exr"];
    assert_refused(&unlike, &["'--hdri' found; `--help` lists the flags"]);
}

#[test]
fn environments_are_cut_and_converted() {
    let folder = Folder::new("env");
    let [map, square, back, picture] =
        ["a.exr", "b.hdr", "c.exr", "d.png"].map(|name| folder.path(name));
    write_map(&map, 64, 32);
    let cut = |more: &[&str]| {
        let args = ["env", "median-cut", &map, "-n", "7", "-o", &picture];
        stdout(&[&args[..], more].concat())
    };
    let line = cut(&[]);
    let report: serde_json::Value = serde_json::from_str(&line).expect("one line of JSON");
    assert_eq!(report["map"], "lat-long", "{line}");
    let lights = report["lights"].as_array().expect("lights");
    let sum: f64 = lights
        .iter()
        .filter_map(|l| l["irradiance"][1].as_f64())
        .sum();
    // Radiance 1 from everywhere, and 2 from the half above the horizon.
    assert!(
        (sum / core::f64::consts::PI / 6.0 - 1.0).abs() < 1e-4,
        "{sum}"
    );
    assert_eq!(lights.len(), 7, "{line}");
    let csv = cut(&["--csv", "--centroid", "squared", "--sums", "pyramid"]);
    assert_eq!(csv.lines().count(), 8, "a head and seven lights: {csv}");
    assert!(Path::new(&picture).exists(), "drawn");

    stdout(&["env", "convert", &map, &square]);
    stdout(&["env", "convert", &square, &back]);
    stdout(&[
        "compare",
        &back,
        &map,
        "--max-relmse",
        "0.01",
        "--max-bias",
        "0.02",
    ]);
    assert_eq!(
        folder.names(),
        ["a.exr", "b.hdr", "c.exr", "d.png"],
        "no more"
    );

    let odd = folder.path("odd.exr");
    write_map(&odd, 5, 3);
    assert_refused(
        &["env", "convert", &odd, &back],
        &["odd.exr", "2:1", "5 x 3"],
    );
    assert_refused(&["env", "median-cut", &map, "-n", "0"], &["-n", "0"]);
    let forced = ["env", "median-cut", &map, "-n", "2", "--map", "equal-area"];
    assert_refused(&forced, &["square", "64 x 32"]);
    let folder_missing = folder.path("missing/e.png");
    assert_refused(&["env", "convert", &map, &folder_missing], &["missing"]);
}

/// An output that cannot be written is refused before the map is read, which warns here.
#[test]
fn outputs_of_environments_are_checked_first() {
    let folder = Folder::new("env-outputs");
    let map = folder.path("a.hdr");
    write_map(&map, 4, 2);
    let mut bytes = fs::read(&map).expect("a map");
    let head = bytes
        .iter()
        .position(|&byte| byte == b'\n')
        .expect("a line");
    bytes.splice(head..head, *b"\nEXPOSURE=2");
    fs::write(&map, bytes).expect("a map");
    let read = lights(&["env", "convert", &map, &folder.path("b.exr")]);
    let said = String::from_utf8(read.stderr).expect("text");
    assert!(said.contains("warning"), "{said}");
    for output in ["missing/b.exr", "b.jpg", "b"].map(|name| folder.path(name)) {
        assert_refused(&["env", "convert", &map, &output], &[&output]);
        let cut = ["env", "median-cut", &map, "-n", "2", "-o", &output];
        assert_refused(&cut, &[&output]);
    }
}

/// A map of radiance 2 in its upper half and 1 below.
fn write_map(path: &str, width: u32, height: u32) {
    let row = |y: u32| if y < height / 2 { 2.0 } else { 1.0 };
    let texels = (0..height).flat_map(|y| (0..width).map(move |_| Vec3::splat(row(y))));
    let map = Image::new(width, height, texels.collect()).expect("an image");
    write_image(Path::new(path), &map).expect("written");
}
