//! The program as a process: its output, its exit status and the files that it leaves.

mod bench_scene;
mod bench_set;
mod billion;
mod environments;
mod extremes;
#[cfg(unix)]
mod farm;
mod farm_folder;
#[cfg(unix)]
mod farm_frames;
mod folder;
mod help;
mod info;
mod interrupted;
mod layers;
mod light;
mod live;
mod no_effect;
mod outputs;
mod overwriting;
mod photometry;
mod refusals;
mod refused_lights;
mod report;
mod samplers;
mod shown;
#[cfg(unix)]
mod stopped;
mod tev_stand_in;
mod visibility;
#[cfg(unix)]
mod watch_flag;
mod watched;

use std::fs;
use std::path::Path;

use light_scene::glam::Vec3;
use light_scene::{Image, write_image};

use folder::{Folder, LIT, SMALL, assert_refused, lights, stdout};

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
    assert_eq!(
        (&figures["flip_ldr"], &figures["flip_hdr"]),
        (&0.0.into(), &0.0.into()),
        "{same}"
    );
    let [black, negative] = ["black.exr", "negative.exr"].map(|name| folder.path(name));
    for (path, value) in [(&black, 0.0), (&negative, -2.0)] {
        let image = Image::new(2, 2, vec![Vec3::splat(value); 4]).expect("texels");
        write_image(Path::new(path), &image).expect("a file");
    }
    let signed = stdout(&["compare", &negative, &black, "--json"]);
    let figures: serde_json::Value = serde_json::from_str(&signed).expect("one line of JSON");
    assert_eq!(
        (&figures["mse"], &figures["bias"][1]),
        (&4.0.into(), &(-2.0).into()),
        "{signed}"
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
    let later = folder.path("later.exr");
    render(&later, "--samples", "9..10");
    let with_gap = lights(&["merge", &later, &a, "-o", &merged]);
    let said = String::from_utf8(with_gap.stderr).expect("text");
    assert_eq!(with_gap.status.code(), Some(0), "allowed: {said}");
    assert!(said.contains("warning") && said.contains("3..9"), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
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
