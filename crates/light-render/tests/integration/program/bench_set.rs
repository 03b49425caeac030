//! `lights bench` on sets of lights in files.

use serde_json::Value;

use crate::program::folder::{Folder, assert_refused, stdout};

/// A spot that shines up from the floor.
const UP: &str = "spot 0 0 0 0 1 0 1 30 10\n";

/// A point in its beam, and one behind it; both face it.
const LIT: &str = "0 1 0 0 -1 0\n";
const DARK: &str = "0 -1 0 0 1 0\n";

const UNIFORM: [&str; 2] = ["--samplers", "uniform"];

#[test]
fn points_that_no_light_reaches_have_no_v() {
    let folder = Folder::new("bench-dark-points");
    let lights = folder.file("two.lights", &UP.repeat(2));
    let bench = |points: &str, more: &[&str]| {
        let points = folder.file("some.points", points);
        let set = ["bench", "--lights", &lights, "--points", &points];
        stdout(&[&set[..], more].concat())
    };
    let row = |points: &str, more: &[&str]| -> Value {
        let line = bench(points, &[&["--json"], more].concat());
        serde_json::from_str(line.trim_end()).expect("one line of JSON")
    };
    for more in [&UNIFORM[..], &[&UNIFORM[..], &["--k", "2"]].concat()] {
        let row = row(DARK, more);
        assert_eq!(row["lit_points"], 0, "{row}");
        for name in [
            "v_mean",
            "v_median",
            "v_p99",
            "v_flux",
            "v_se",
            "v_within",
            "v_best",
            "lost_energy",
        ] {
            assert_eq!(row[name], Value::Null, "{name}: {row}");
        }
        let table = bench(DARK, more);
        assert!(table.contains("No light reaches any"), "{table}");
        let dashes = table.split_whitespace().filter(|word| *word == "-").count();
        assert_eq!(dashes, 6, "V and lost light: {table}");
    }
    let moved = bench(DARK, &["--refits", "1", "--samplers", "bvh"]);
    assert!(moved.contains("No light reaches any"), "{moved}");
    // A dark point changes nothing for one that is lit.
    let [alone, both] =
        [LIT.to_owned(), LIT.to_owned() + DARK].map(|points| row(&points, &UNIFORM));
    assert_eq!(both["lit_points"], 1, "{both}");
    assert_eq!(both["v_mean"], alone["v_mean"], "{both}, {alone}");
    assert!(!bench(LIT, &UNIFORM).contains("No light"), "it is lit");
}

/// A sampler that picks no light is asked for no probability.
#[test]
fn a_time_that_is_not_measured_is_left_out() {
    let folder = Folder::new("bench-no-pmf");
    let lights = folder.file("one.lights", UP);
    let points = folder.file("one.points", DARK);
    let set = ["bench", "--lights", &lights, "--points", &points];
    let set = [&set[..], &["--samplers", "bvh"]].concat();
    let line = stdout(&[&set[..], &["--json"]].concat());
    let row: Value = serde_json::from_str(line.trim_end()).expect("one line of JSON");
    assert_eq!(row["no_light"], 1.0, "{row}");
    assert_eq!(row["ns_pmf"], Value::Null, "{row}");
    let table = stdout(&set);
    assert!(!table.contains("-0") && !table.contains("NaN"), "{table}");
}

#[test]
fn a_set_of_files_has_the_lights_that_it_has() {
    let folder = Folder::new("bench-n");
    let lights = folder.file("one.lights", UP);
    let points = folder.file("one.points", LIT);
    let set = ["bench", "--lights", &lights, "--points", &points];
    for flag in ["--n", "--seed"] {
        assert_refused(&[&set[..], &[flag, "10"]].concat(), &["--lights", flag]);
    }
}

#[test]
fn a_set_that_cannot_be_read_says_so() {
    let folder = Folder::new("bench-unread");
    let points = folder.file("one.points", LIT);
    let none = folder.path("none.lights");
    let set = ["bench", "--lights", &none, "--points", &points];
    assert_refused(&set, &["none.lights: cannot be read"]);
}

/// Else the files would be called `.lights` and `.points`, and hidden.
#[test]
fn a_set_is_kept_under_a_name() {
    let folder = Folder::new("bench-write");
    let set = ["bench", "--generate", "spots", "--n", "4"];
    for prefix in ["", "sub/"] {
        let prefix = folder.path(prefix);
        assert_refused(&[&set[..], &["--write", &prefix]].concat(), &["--write"]);
    }
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

#[test]
fn no_points_are_refused() {
    let bench = ["bench", "--generate", "uniform", "--var-points", "0"];
    assert_refused(&bench, &["--var-points", "0"]);
}
