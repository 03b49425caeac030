//! Cells of visibility on the command line.

use std::fs;

use crate::folder::{Folder, assert_refused, stdout};

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
    let off = [
        "--width",
        "72",
        "--height",
        "48",
        "--max-depth",
        "3",
        "--samples",
        "1..4",
    ];
    stdout(&[&["render", "rooms", "-o", &plain][..], &off].concat());
    assert_refused(
        &["merge", a, &plain, "-o", &merged],
        &["plain.exr", "visibility"],
    );
}

#[test]
fn cells_belong_to_the_default_hierarchy() {
    let folder = Folder::new("no-cells");
    let out = folder.path("out.exr");
    let render = ["render", "rooms", "-o", &out, "--visibility", "cells"];
    for sampler in ["uniform", "power", "exhaustive", "bvh-reference"] {
        let words = ["--visibility cells", "--light-sampler bvh", sampler];
        assert_refused(
            &[&render[..], &["--light-sampler", sampler]].concat(),
            &words,
        );
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
fn info_says_what_cells_hold() {
    let of = |scene: &str| -> serde_json::Value {
        let line = stdout(&["info", scene, "--visibility", "cells", "--json"]);
        serde_json::from_str(&line).expect("one line of JSON")
    };
    let rooms = &of("rooms")["visibility"];
    let count = |name: &str| rooms[name].as_u64().expect(name);
    let (coarse, fine) = (count("coarse_cells"), count("fine_cells"));
    assert!(coarse > 10 && fine > 10 * coarse, "{rooms}");
    assert!(count("bytes") > 32 * (coarse + fine), "{rooms}");
    let (known, all) = (count("known_pixels"), count("pixels"));
    assert!(known > all / 10 && known <= all, "{rooms}");
    let text = stdout(&["info", "cornell-box", "--visibility", "cells"]);
    assert!(text.contains("visibility "), "{text}");
    let text = stdout(&["info", "cornell-box"]);
    assert!(!text.contains("visibility"), "nothing is filled: {text}");
}
