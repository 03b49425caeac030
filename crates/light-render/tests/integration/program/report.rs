//! `lights report SCENE`.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::folder::{Folder, LIT, UNLIT, assert_refused, lights, stdout};

const QUICK: [&str; 6] = ["--width", "16", "--time", "0.05", "--max-depth", "3"];

/// Every tag is closed, in the order of a stack; those that hold nothing close themselves.
fn assert_well_formed(page: &str) {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = page
        .strip_prefix("<!DOCTYPE html>")
        .expect("a document type");
    while let Some((before, tag)) = rest.split_once('<') {
        assert!(!before.contains('>'), "a lone bracket in {before:?}");
        let (tag, after) = tag.split_once('>').expect("a tag ends");
        rest = after;
        assert_eq!(tag.matches('"').count() % 2, 0, "quotes of {tag:?}");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "closes what is open");
        } else if !tag.ends_with('/') {
            open.push(tag.split_whitespace().next().expect("a name"));
        }
    }
    assert!(open.is_empty(), "left open: {open:?}");
    assert!(rest.trim().is_empty(), "text behind the page: {rest:?}");
}

/// The numbers of a table, row by row.
fn numbers(page: &str, table: &str) -> Vec<Vec<f64>> {
    let start = format!("<table id=\"{table}\">");
    let (_, table) = page.split_once(&start).expect("the table");
    let (table, _) = table.split_once("</table>").expect("its end");
    let (_, body) = table.split_once("<tbody>").expect("its body");
    let cell = |cell: &str| cell.split_once('"').and_then(|(n, _)| n.parse().ok());
    let row = |row: &str| {
        row.split("<data value=\"")
            .skip(1)
            .filter_map(cell)
            .collect()
    };
    body.split("</tr>")
        .filter(|row| row.contains("<td>"))
        .map(row)
        .collect()
}

/// The same numbers, up to the last bit, which the reader of JSON may lose.
fn assert_same(shown: &[f64], told: &[f64], words: &Value) {
    assert_eq!(shown.len(), told.len(), "{shown:?}, {told:?}: {words}");
    for (a, b) in shown.iter().zip(told) {
        assert!(
            (a - b).abs() <= 1e-15 * b.abs(),
            "{shown:?}, {told:?}: {words}"
        );
    }
}

#[test]
fn a_page_shows_what_its_json_says() {
    let folder = Folder::new("report");
    let scene = folder.scene(LIT);
    let out = folder.path("page.html");
    let args = [
        "report",
        &scene,
        "-o",
        &out,
        "--samplers",
        "uniform,bvh",
        "--json",
    ];
    let line = stdout(&[&args[..], &QUICK].concat());
    let report: Value = serde_json::from_str(&line).expect("one line of JSON");
    let page = fs::read_to_string(&out).expect("a page");
    assert_well_formed(&page);
    for id in [
        "pictures",
        "convergence",
        "variance",
        "cost",
        "lights",
        "notes",
    ] {
        assert!(page.contains(&format!("<section id=\"{id}\">")), "{id}");
    }
    // The reference, and for each sampler a picture, its error and FLIP.
    assert_eq!(
        page.matches("src=\"data:image/png;base64,").count(),
        7,
        "pictures"
    );
    assert!(
        page.contains("prefers-color-scheme: dark"),
        "light and dark"
    );
    // Any letters may follow each other in a picture.
    let mut parts = page.split("data:image/png;base64,");
    let first = parts.next().unwrap_or_default();
    let behind = parts.filter_map(|part| Some(part.split_once('"')?.1));
    let text: String = core::iter::once(first).chain(behind).collect();
    for foreign in ["http", "<script", "url(", "@import", "<link"] {
        assert!(!text.contains(foreign), "{foreign}: all is in the page");
    }

    let f = |value: &Value| value.as_f64().expect("a number");
    let samplers = report["samplers"].as_array().expect("a list");
    assert_eq!(samplers.len(), 2, "{line}");
    let errors = numbers(&page, "errors");
    let costs = numbers(&page, "costs");
    for (i, row) in samplers.iter().enumerate() {
        let bias = row["bias"].as_array().expect("channels");
        let bias = bias.iter().map(f).sum::<f64>() / 3.0;
        let mut expected: Vec<f64> = ["spp", "seconds", "relmse", "slope", "flip_hdr", "flip_ldr"]
            .iter()
            .filter_map(|name| row[name].as_f64())
            .collect();
        expected.push(bias);
        assert_same(&errors[i], &expected, row);
        let expected = ["build_ms", "bytes", "ns_sample", "ns_pmf"].map(|name| f(&row[name]));
        assert_same(&costs[i][..4], &expected, row);
        let names = ["v_mean", "v_median", "v_p99", "lost_energy", "no_light"];
        assert_same(&costs[i][5..], &names.map(|name| f(&row[name])), row);
        let stages = row["convergence"].as_array().expect("a list");
        assert_eq!(
            stages.last().expect("a stage")["relmse"],
            row["relmse"],
            "{row}"
        );
        assert!(f(&row["relmse"]) > 0.0, "noise: {row}");
    }
    let pixels = report["pixels"].as_array().expect("a list");
    assert!(!pixels.is_empty(), "{line}");
    for (pixel, row) in pixels.iter().zip(numbers(&page, "variances")) {
        let expected = [
            &pixel["x"],
            &pixel["y"],
            &pixel["lights"],
            &pixel["arriving"],
            &pixel["v"]["uniform"],
            &pixel["v"]["bvh"],
            &pixel["v_best"],
        ];
        assert_same(&row, &expected.map(f), pixel);
    }
    let kinds = numbers(&page, "kinds");
    assert_eq!(kinds.len(), 1, "triangles: {line}");
    assert_eq!(kinds[0][0], 2.0, "two of them");
    assert_same(&kinds[0][4..], &[f(&report["kinds"][0]["area"])], &report);
}

#[test]
fn one_sampler_and_a_given_reference_are_enough() {
    let folder = Folder::new("report-given");
    let scene = folder.scene(LIT);
    let [reference, small, out] =
        ["reference.exr", "small.exr", "page.html"].map(|name| folder.path(name));
    let size = ["--width", "12", "--spp", "64"];
    stdout(&[&["render", &scene, "-o", &reference], &size[..]].concat());
    let size = ["--width", "8", "--spp", "1"];
    stdout(&[&["render", &scene, "-o", &small], &size[..]].concat());
    let report = |reference: &str| -> Vec<String> {
        let args = [
            "report",
            &scene,
            "-o",
            &out,
            "--samplers",
            "power",
            "--width",
            "12",
        ];
        let more = [
            "--time",
            "0.02",
            "--pixel",
            "6,10",
            "--reference",
            reference,
        ];
        args.into_iter().chain(more).map(String::from).collect()
    };
    let args = report(&small);
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    assert_refused(&args, &["small.exr", "8 x 8", "12 x 12", "--width"]);
    assert!(!Path::new(&out).exists(), "no page");
    let args = report(&reference);
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let table = stdout(&args);
    assert!(
        table.contains("power") && table.contains("page.html"),
        "{table}"
    );
    let page = fs::read_to_string(&out).expect("a page");
    assert_well_formed(&page);
    assert!(
        page.contains("Reference: ") && page.contains("reference.exr"),
        "named"
    );
    assert_eq!(numbers(&page, "errors").len(), 1, "one sampler");
    let pixels = numbers(&page, "variances");
    assert_eq!(pixels[0][..2], [6.0, 10.0], "the pixel that was asked for");
}

#[test]
fn bad_input_is_refused_before_any_work() {
    let folder = Folder::new("report-refused");
    let scene = folder.scene(LIT);
    let out = folder.path("page.html");
    let args = ["report", &scene, "-o", &out];
    let refuse = |more: &[&str], words: &[&str]| {
        assert_refused(&[&args[..], more].concat(), words);
    };
    refuse(&["--samplers", "best"], &["--samplers", "bvh"]);
    refuse(&["--pixel", "1"], &["--pixel", "X,Y"]);
    for pixel in ["320,0", "0,320", "4000000000,1"] {
        refuse(&["--pixel", pixel], &["--pixel", pixel, "X from 0 to 319"]);
    }
    refuse(&["--time", "0"], &["--time", "above 0"]);
    refuse(&["--reference", "missing.exr"], &["missing.exr"]);
    assert_refused(
        &["report", &scene, "-o", &scene],
        &["scene.obj", "another file"],
    );
    let nowhere = folder.path("no/page.html");
    assert_refused(
        &["report", &scene, "-o", &nowhere],
        &["page.html", "cannot be written"],
    );
    let fog = "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" WorldBegin";
    let black = folder.file("black.pbrt", fog);
    assert_refused(
        &["report", &black, "-o", &out],
        &["black.pbrt", "no light", "--sky"],
    );
    assert!(!Path::new(&out).exists(), "no page");
}

#[test]
fn a_scene_without_light_is_compared_under_the_sky_that_a_picture_shows() {
    let folder = Folder::new("report-dark");
    let dark = folder.scene(UNLIT);
    let out = folder.path("page.html");
    let report = |more: &[&str]| {
        let few = ["report", &dark, "-o", &out, "--samplers", "uniform"];
        let output = lights(&[&few, &QUICK[..], more].concat());
        let words = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(0), "{words}");
        words
    };
    let words = report(&[]);
    assert!(
        words.contains("no light in the scene") && words.contains("`overcast`"),
        "{words}"
    );
    assert!(Path::new(&out).exists(), "a page");
    let words = report(&["--sky", "uniform", "--quiet"]);
    assert_eq!(words, "", "it was asked for");
}

#[test]
fn a_pixel_without_a_variance_is_told_why() {
    let folder = Folder::new("mirror-pixel");
    let scene = folder.file(
        "mirror.pbrt",
        "LookAt 0 0 -3 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 45\nWorldBegin\n\
         LightSource \"point\" \"point3 from\" [0 2 -2]\n\
         Material \"conductor\" \"float roughness\" 0\nShape \"sphere\"\n",
    );
    let page = folder.path("mirror.html");
    let report = ["report", &scene, "-o", &page, "--pixel", "8,4"];
    let args = [&report, &QUICK[..]].concat();
    let shown = lights(&args);
    let error = String::from_utf8_lossy(&shown.stderr);
    let line = "--pixel 8,4: no variance there";
    assert!(shown.status.success() && error.contains(line), "{error}");
    let text = fs::read_to_string(&page).expect("a page");
    assert!(text.contains(line), "in the page too");
    let quiet = lights(&[&args[..], &["--quiet"]].concat());
    let error = String::from_utf8_lossy(&quiet.stderr);
    assert!(!error.contains(line), "{error}");
}
