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

use folder::{Folder, LIT, SMALL, UNLIT, assert_refused, lights, stdout};

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

#[test]
fn info_counts_placed_lights() {
    let folder = Folder::new("placed");
    let scene = folder.path("lamps.pbrt");
    let object = r#"WorldBegin ObjectBegin "lamp" AreaLightSource "diffuse" "rgb L" [ 1 2 3 ]
        Shape "trianglemesh" "point3 P" [ 0 0 0  1 0 0  0 1 0  0 0 1 ]
        "integer indices" [ 0 2 1  0 1 3  1 2 3  0 3 2 ] ObjectEnd"#;
    let places = "Translate 3 0 0 ObjectInstance \"lamp\"\n".repeat(5);
    fs::write(&scene, format!("{object}\n{places}")).expect("a file");
    let line = stdout(&["info", &scene, "--json"]);
    let report: serde_json::Value = serde_json::from_str(&line).expect("one line of JSON");
    let expected = serde_json::json!({
        "meshes": 1,
        "stored": 4,
        "placements": 5,
        "lights": 20,
    });
    assert_eq!(report["placed_lights"], expected, "{line}");
    assert_eq!(report["stored_triangles"], 4, "{line}");
    let words = stdout(&["info", &scene]);
    let placed = "of them 20 placed: 4 of 1 meshes stored once, in 5 places";
    assert!(words.contains(placed), "{words}");
}

#[test]
fn info_counts_the_lights() {
    let folder = Folder::new("info");
    let line = stdout(&["info", &folder.scene(LIT), "--json"]);
    let report: serde_json::Value = serde_json::from_str(&line).expect("one line of JSON");
    assert_eq!(report["kinds"][0]["count"], 2, "{line}");
    assert_eq!(report["triangles"], 4, "{line}");
    assert_eq!(report["stored_triangles"], 4, "{line}");
    assert_eq!(report["placements"], 0, "{line}");
    assert_eq!(report["bytes"]["vertices"], 4 * 12 + 2 * 12, "{line}");
    let tree = report["tree"]["bytes"].as_f64().expect("a number");
    let lights = report["bytes"]["lights"].as_f64().expect("a number");
    assert_eq!(
        report["bytes"]["per_light"],
        (tree + lights) / 2.0,
        "{line}"
    );
    let turned_on = stdout(&["info", &folder.scene(UNLIT), "--emit", "floor=1,1,1"]);
    assert!(turned_on.contains("lights     2"), "{turned_on}");
    for (wrong, words) in [
        ("roof=1,1,1", ["scene.obj: --emit: ", "found roof"]),
        ("floor=-1,1,1", ["--emit", "radiance of at least 0"]),
    ] {
        assert_refused(&["info", &folder.scene(UNLIT), "--emit", wrong], &words);
    }
    assert!(
        stdout(&["info", &folder.scene(UNLIT)]).contains("lights     0"),
        "none"
    );
}
