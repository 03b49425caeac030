//! What choices of lights know of their visibility, on the command line.

use std::fs;

use crate::program::folder::{Folder, assert_refused, lights, stdout};

/// A small picture of direct light.
const SMALL: [&str; 6] = ["--width", "72", "--height", "48", "--max-depth", "2"];

/// Rooms of which most lamps are hidden, as small as cells still pay.
const ROOMS: [&str; 8] = [
    "--width",
    "72",
    "--height",
    "48",
    "--max-depth",
    "3",
    "--visibility",
    "cells",
];

#[test]
fn cells_make_the_same_picture_for_any_threads_and_parts() {
    let folder = Folder::new("cells");
    let render = |name: &str, how: &[&str]| {
        let out = folder.path(name);
        let line = stdout(&[&["render", "rooms", "-o", &out], &ROOMS[..], how].concat());
        (out, line)
    };
    let bytes = |path: &str| fs::read(path).expect("a picture");
    let (whole, line) = render("whole.exr", &["--spp", "6", "--json"]);
    let report: serde_json::Value = serde_json::from_str(&line).expect("one line of JSON");
    assert!(report["visibility_seconds"].as_f64() > Some(0.0), "{line}");
    assert!(report["visibility_bytes"].as_u64() > Some(1000), "{line}");
    for threads in ["1", "2", "7"] {
        let (out, _) = render("threads.exr", &["--spp", "6", "--threads", threads]);
        assert_eq!(bytes(&out), bytes(&whole), "{threads} threads");
    }
    let parts = ["0..1", "1..4", "4..6"].map(|part| {
        let name = format!("{}.exr", &part[..1]);
        render(&name, &["--samples", part]).0
    });
    let merged = folder.path("merged.exr");
    let [a, b, c] = &parts;
    stdout(&["merge", b, a, c, "-o", &merged]);
    assert_eq!(bytes(&merged), bytes(&whole), "three parts");

    let plain = folder.path("plain.exr");
    let off = [&SMALL[..], &["--samples", "1..4"]].concat();
    stdout(&[&["render", "rooms", "-o", &plain][..], &off].concat());
    assert_refused(
        &["merge", a, &plain, "-o", &merged],
        &["plain.exr", "visibility"],
    );
}

/// By default a picture of rooms has cells and one choice where one without visibility has two, and
/// an open field has two and no cells.
#[test]
fn light_that_arrives_decides_the_number_of_choices() {
    let folder = Folder::new("share");
    let render = |scene: &str, name: &str, how: &[&str]| {
        let out = folder.path(name);
        let json = ["--json"];
        let line = stdout(&[&["render", scene, "-o", &out], &SMALL[..], how, &json].concat());
        let report: serde_json::Value = serde_json::from_str(&line).expect("one line of JSON");
        let has_cells = report["visibility_bytes"].as_u64() > Some(0);
        let is_plain = ["off", "--light-samples"]
            .iter()
            .any(|word| how.contains(word));
        let wants_cells = scene == "rooms" && !is_plain;
        assert_eq!(has_cells, wants_cells, "{scene} {how:?}: {line}");
        out
    };
    let bytes = |path: &str| fs::read(path).expect("a picture");
    let picture = |scene, how: &[&str]| {
        let how = [&["--spp", "6"], how].concat();
        bytes(&render(scene, "picture.exr", &how))
    };
    let whole = picture("rooms", &[]);
    assert_eq!(whole, picture("rooms", &["--visibility", "share"]), "named");
    for threads in ["1", "2", "7"] {
        let of = picture("rooms", &["--threads", threads]);
        assert_eq!(of, whole, "{threads} threads");
    }
    let off = picture("rooms", &["--visibility", "off"]);
    assert_ne!(off, whole, "two choices among hidden lights");
    let two = picture("rooms", &["--light-samples", "2"]);
    assert_eq!(off, two, "so many were asked for");
    let [open, off] = ["share", "off"].map(|how| picture("open", &["--visibility", how]));
    assert_eq!(open, off, "nothing is hidden");

    let parts = ["0..1", "1..4", "4..6"].map(|part| {
        let name = format!("{}.exr", &part[..1]);
        render("rooms", &name, &["--samples", part])
    });
    let merged = folder.path("merged.exr");
    let [a, b, c] = &parts;
    stdout(&["merge", b, a, c, "-o", &merged]);
    assert_eq!(bytes(&merged), whole, "three parts");
    let off = ["--samples", "1..4", "--visibility", "off"];
    let off = render("rooms", "off.exr", &off);
    assert_refused(
        &["merge", a, &off, "-o", &merged],
        &["off.exr", "visibility"],
    );
}

#[test]
fn visibility_belongs_to_the_default_hierarchy() {
    let folder = Folder::new("no-cells");
    let out = folder.path("out.exr");
    for sampler in ["uniform", "power", "exhaustive", "bvh-reference"] {
        for visibility in ["share", "cells"] {
            let render = ["render", "rooms", "-o", &out, "--visibility", visibility];
            let named = format!("--visibility {visibility}");
            assert_refused(
                &[&render[..], &["--light-sampler", sampler]].concat(),
                &[&named, "--light-sampler bvh", sampler],
            );
        }
    }
    assert!(folder.names().is_empty(), "nothing is written");
    let line = stdout(&[
        "render",
        "cornell-box",
        "-o",
        &out,
        "--width",
        "8",
        "--height",
        "8",
        "--spp",
        "1",
        "--json",
    ]);
    let report: serde_json::Value = serde_json::from_str(&line).expect("one line of JSON");
    assert_eq!(report["visibility_bytes"], 0, "{line}");
}

#[test]
fn info_says_what_is_known_of_visibility() {
    let of = |scene: &str| -> serde_json::Value {
        let line = stdout(&["info", scene, "--visibility", "cells", "--json"]);
        serde_json::from_str(&line).expect("one line of JSON")
    };
    // Of a small picture: cells of `rooms` take twelve times as long.
    let found = &of("cornell-box")["visibility"];
    let count = |name: &str| found[name].as_u64().expect(name);
    let (coarse, fine) = (count("coarse_cells"), count("fine_cells"));
    assert!(coarse > 10 && fine > 10 * coarse, "{found}");
    assert!(count("bytes") > 32 * (coarse + fine), "{found}");
    let (known, all) = (count("known_pixels"), count("pixels"));
    assert!(known > all / 10 && known <= all, "{found}");
    let shares = ["rooms", "open"].map(|scene| {
        let line = stdout(&["info", scene, "--visibility", "share", "--json"]);
        let report: serde_json::Value = serde_json::from_str(&line).expect("one line of JSON");
        let found = &report["visibility"];
        // No cell pays for the whole paths of these pictures.
        assert_eq!(found["cells"]["coarse_cells"], 0, "{scene}: {found}");
        found["visible_share"].as_f64().expect(scene)
    });
    assert!(shares[0] < 0.3 && shares[1] > 0.95, "{shares:?}");
    let text = stdout(&["info", "cornell-box", "--visibility", "cells"]);
    assert!(text.contains("  cells "), "{text}");
    let text = stdout(&["info", "cornell-box"]);
    assert!(!text.contains("visibility"), "nothing is filled: {text}");
}

#[test]
fn time_that_fills_cells_is_a_part_of_the_budget() {
    let folder = Folder::new("budget");
    let out = folder.path("out.exr");
    let render = |how: &[&str]| -> serde_json::Value {
        let args = ["render", "rooms", "-o", &out, "--json"];
        let line = stdout(&[&args, &ROOMS[..], how].concat());
        serde_json::from_str(&line).expect("one line of JSON")
    };
    let seconds = |report: &serde_json::Value, name: &str| report[name].as_f64().expect("a time");
    let report = render(&["--spp", "1"]);
    let filling = seconds(&report, "visibility_seconds");
    assert!(seconds(&report, "seconds") > filling, "the whole: {report}");
    // Without the cells a third of their time is enough for more samples.
    let budget = (filling / 3.0).to_string();
    let report = render(&["--time", &budget]);
    assert_eq!(report["spp"], 1, "nothing is left: {report}");
    let budget = (filling * 6.0).to_string();
    let report = render(&["--time", &budget]);
    assert!(report["spp"].as_u64() > Some(1), "the rest: {report}");
}

/// Choices never learnt from a picture before the picture; the name stays, and says so.
#[test]
fn a_pilot_is_the_default_and_one_line_says_so() {
    let folder = Folder::new("pilot");
    let render = |name: &str, how: &[&str]| {
        let out = folder.path(name);
        let args = ["render", "rooms", "-o", &out, "--spp", "2"];
        let output = lights(&[&args, &SMALL[..], how].concat());
        let said = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(0), "{how:?}: {said}");
        (fs::read(&out).expect("a picture"), said)
    };
    let pilot = ["--visibility", "pilot"];
    let (plain, _) = render("plain.exr", &[]);
    let (named, said) = render("named.exr", &pilot);
    assert!(named == plain, "the same picture");
    assert_eq!(said.lines().count(), 1, "{said}");
    for word in ["--visibility pilot", "share", "cells", "docs/occlusion.md"] {
        assert!(said.contains(word), "{word} in {said}");
    }
    let (_, quiet) = render("quiet.exr", &[&pilot[..], &["--quiet"]].concat());
    assert_eq!(quiet, "", "nothing is said");
    let power = [&pilot[..], &["--light-sampler", "power"]].concat();
    let (power, _) = render("power.exr", &power);
    let (off, _) = render("off.exr", &["--light-sampler", "power"]);
    assert!(power == off, "the default of other samplers");
}
