//! The program from outside: what it prints, how it ends, what it leaves behind.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use light_scene::glam::Vec3;
use light_scene::{Image, write_image};

use light_scene::ChannelFile;

/// A folder of its own for a test, removed at its end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("lights-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).expect("a folder to write to");
        Self(path)
    }

    fn file(&self, name: &str, content: &str) -> String {
        let path = self.path(name);
        fs::write(&path, content).expect("a file");
        path
    }

    fn path(&self, name: &str) -> String {
        self.0.join(name).to_str().expect("a plain path").into()
    }

    /// Two triangles, one of which shines unless `mtl` says otherwise.
    fn scene(&self, mtl: &str) -> String {
        self.file("scene.mtl", mtl);
        let quad = "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\n";
        let lamp = "v -.2 1 -.2\nv .2 1 -.2\nv .2 1 .2\nv -.2 1 .2\n";
        let faces = "usemtl floor\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n";
        self.file(
            "scene.obj",
            &format!("mtllib scene.mtl\n{quad}{lamp}{faces}"),
        )
    }

    fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(&self.0)
            .expect("the folder")
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

const LIT: &str = "newmtl floor\nKd .5 .5 .5\nnewmtl lamp\nKe 5 4 3\n";
const UNLIT: &str = "newmtl floor\nKd .5 .5 .5\nnewmtl lamp\nKd .5 .5 .5\n";

fn lights(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lights"))
        .args(args)
        .output()
        .expect("the program runs")
}

/// The program refuses `args` with one line that holds all of `words`, and prints nothing else.
fn assert_refused(args: &[&str], words: &[&str]) {
    let output = lights(args);
    let error = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(2), "{args:?}: {error}");
    assert_eq!(error.trim_end().lines().count(), 1, "one line: {error}");
    assert!(
        output.stdout.is_empty(),
        "nothing on standard output: {args:?}"
    );
    for word in words {
        assert!(error.contains(word), "{word:?} in {error:?}");
    }
}

fn stdout(args: &[&str]) -> String {
    let output = lights(args);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{args:?}: {error}");
    String::from_utf8(output.stdout).expect("text")
}

const SMALL: [&str; 4] = ["--width", "12", "--spp", "4"];

#[test]
fn renders_reports_and_compares() {
    let folder = Folder::new("renders");
    let scene = folder.scene(LIT);
    let (a, b, png) = (
        folder.path("a.exr"),
        folder.path("b.exr"),
        folder.path("c.png"),
    );
    let line = stdout(&[&["render", &scene, "-o", &a, "--json"], &SMALL[..]].concat());
    let report: serde_json::Value = serde_json::from_str(&line).expect("one line of JSON");
    assert_eq!(
        (&report["spp"], &report["lights"]),
        (&4.into(), &2.into()),
        "{line}"
    );
    assert!(report["rays"].as_u64() > Some(12 * 12 * 4), "{line}");
    let quiet = stdout(&[&["render", &scene, "-o", &b, "--threads", "1"], &SMALL[..]].concat());
    assert_eq!(quiet, "", "nothing to say");
    let bytes = |path: &str| fs::read(path).expect("a picture");
    assert_eq!(
        bytes(&a),
        bytes(&b),
        "the same picture for any number of threads"
    );
    stdout(&[&["render", &scene, "-o", &png, "--seed", "1"], &SMALL[..]].concat());
    let same = stdout(&["compare", &a, &b, "--json", "--max-relmse", "0"]);
    let figures: serde_json::Value = serde_json::from_str(&same).expect("one line of JSON");
    assert_eq!(
        (&figures["relmse"], &figures["mse"]),
        (&0.0.into(), &0.0.into()),
        "{same}"
    );
    let diff = folder.path("d.png");
    let other = lights(&["compare", &png, &a, "--max-relmse", "1e-9", "--diff", &diff]);
    assert_eq!(other.status.code(), Some(1), "a check that fails");
    assert!(Path::new(&diff).exists(), "but the difference is drawn");
}

#[test]
fn parts_merge_into_the_same_bytes() {
    let folder = Folder::new("merge");
    let scene = folder.scene(LIT);
    let [whole, a, b, merged] =
        ["whole.exr", "a.exr", "b.exr", "merged.exr"].map(|name| folder.path(name));
    let render = |out: &str, flag: &str, value: &str| {
        stdout(&["render", &scene, "-o", out, "--width", "12", flag, value]);
    };
    render(&whole, "--spp", "7");
    render(&a, "--samples", "0..3");
    render(&b, "--samples", "3..7");
    stdout(&["merge", &b, &a, "-o", &merged]);
    let bytes = |path: &str| fs::read(path).expect("a picture");
    assert_eq!(bytes(&merged), bytes(&whole), "as if rendered at once");
    stdout(&["compare", &a, &whole]);
    assert_refused(&["merge", &a, &a, "-o", &merged], &["0..3"]);
    assert_refused(
        &["merge", &a, &whole, "-o", &merged],
        &["whole.exr", "--samples"],
    );
    let png = folder.path("a.png");
    assert_refused(
        &["render", &scene, "-o", &png, "--samples", "0..3"],
        &["a.png", ".exr"],
    );
}

#[test]
fn info_counts_the_lights() {
    let folder = Folder::new("info");
    let line = stdout(&["info", &folder.scene(LIT), "--json"]);
    let report: serde_json::Value = serde_json::from_str(&line).expect("one line of JSON");
    assert_eq!(report["kinds"][0]["count"], 2, "{line}");
    assert_eq!(report["triangles"], 4, "{line}");
    let turned_on = stdout(&["info", &folder.scene(UNLIT), "--emit", "floor=1,1,1"]);
    assert!(turned_on.contains("lights     2"), "{turned_on}");
    for wrong in ["roof=1,1,1", "floor=-1,1,1"] {
        let words = ["scene.obj", &wrong[..4]];
        assert_refused(&["info", &folder.scene(UNLIT), "--emit", wrong], &words);
    }
    assert!(
        stdout(&["info", &folder.scene(UNLIT)]).contains("lights     0"),
        "none"
    );
}

#[test]
fn bad_input_is_refused_in_one_line_and_leaves_nothing() {
    let folder = Folder::new("refuses");
    let scene = folder.scene(LIT);
    let out = folder.path("out.exr");
    let render = |scene: &str| assert_refused(&["render", scene, "-o", &out], &[scene]);
    render(&folder.path("missing.obj"));
    render(&folder.file("a.txt", "no scene"));
    render("no-such-scene");
    let broken = folder.file("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 one 0\nf 1 2 3\n");
    assert_refused(&["render", &broken, "-o", &out], &["broken.obj:3"]);
    let stray = folder.file(
        "stray.obj",
        "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl glass\nf 1 2 3\n",
    );
    assert_refused(&["render", &stray, "-o", &out], &["stray.obj:5", "glass"]);
    let dark = folder.scene(UNLIT);
    assert_refused(&["render", &dark, "-o", &out], &["scene.obj", "no light"]);
    folder.scene(LIT);
    let env = folder.file("env.exr", "not an image");
    assert_refused(&["render", &scene, "-o", &out, "--env", &env], &["env.exr"]);
    let nowhere = folder.path("no/such/out.exr");
    assert_refused(&["render", &scene, "-o", &nowhere], &["out.exr"]);
    assert_refused(
        &["render", &scene, "-o", &folder.path("out.gif")],
        &["out.gif", ".exr"],
    );
    assert!(
        !folder.names().iter().any(|name| name.starts_with("out")),
        "nothing is written"
    );
    assert!(
        !folder.names().iter().any(|name| name.contains("part")),
        "nothing half written"
    );
}

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
        notes: vec![],
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
    let quiet = lights(&[&args[..], &SMALL, &["--quiet"]].concat());
    assert!(quiet.stderr.is_empty(), "unless nobody wants to know");
}

#[test]
fn nonsense_on_the_command_line_is_refused() {
    let folder = Folder::new("nonsense");
    let scene = folder.scene(LIT);
    let out = folder.path("out.exr");
    let with = |flag: &str, value: &str| {
        assert_refused(&["render", &scene, "-o", &out, flag, value], &[flag]);
    };
    for (flag, value) in [
        ("--spp", "0"),
        ("--spp", "many"),
        ("--max-depth", "-1"),
        ("--light-samples", "0"),
        ("--width", "0"),
        ("--time", "0"),
        ("--fov", "nan"),
        ("--light-sampler", "best"),
        ("--estimator", "luck"),
        ("--look-at", "1,2,3"),
        ("--look-at", "0,0,0,0,0,0,0,1,0"),
    ] {
        with(flag, value);
    }
    assert_refused(
        &["render", &scene, "-o", &out, "--fov", "180"],
        &["angle of view"],
    );
    assert_refused(&["render", &scene], &["--output"]);
    assert_refused(&["redner"], &["redner"]);
    assert_refused(&["render", &scene, "-o", &out, "--sp", "4"], &["--sp"]);
    assert_refused(&["compare", &out, &out], &["out.exr"]);
    assert_eq!(
        lights(&["--help"]).status.code(),
        Some(0),
        "help was asked for"
    );
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

/// A map of radiance 2 in its upper half and 1 below.
fn write_map(path: &str, width: u32, height: u32) {
    let row = |y: u32| if y < height / 2 { 2.0 } else { 1.0 };
    let texels = (0..height).flat_map(|y| (0..width).map(move |_| Vec3::splat(row(y))));
    let map = Image::new(width, height, texels.collect()).expect("an image");
    write_image(Path::new(path), &map).expect("written");
}
