//! A scene file with a billion lights: what the program does with them takes no memory for each.

use core::fmt::Write;

use super::folder::{Folder, assert_refused, stdout};

/// Houses of 10,000 windows, a triangle each, in rows of a hundred.
fn city(houses: u16) -> String {
    let mut text = String::from(
        "LookAt -5 60 -5  300 0 300  0 1 0 Camera \"perspective\" WorldBegin
        Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [0 0 0  0 0 1e6  1e6 0 0]
        ObjectBegin \"house\" AreaLightSource \"diffuse\" \"rgb L\" [4 3 2]
        Shape \"trianglemesh\" \"integer indices\" [",
    );
    (0..30_000).for_each(|i| write!(text, "{i} ").expect("memory"));
    text += "] \"point3 P\" [";
    for (row, column) in (0..100).flat_map(|row| (0..100).map(move |column| (row, column))) {
        let (x, y) = (column * 8, 20 + row * 20);
        writeln!(
            text,
            "{x}e-2 {y}e-2 0 {x}e-2 {}e-2 0 {}e-2 {y}e-2 0",
            y + 9,
            x + 5
        )
        .expect("memory");
    }
    text += "] ObjectEnd\n";
    for house in 0..houses {
        let (x, z) = (house % 100 * 16, house / 100 * 16);
        writeln!(
            text,
            "Translate {x} 0 {z} ObjectInstance \"house\" Translate -{x} 0 -{z}"
        )
        .expect("memory");
    }
    text
}

#[test]
fn a_billion_lights_are_shown_and_rendered() {
    let folder = Folder::new("billion");
    let mut text = city(50_000);
    // As many again, beside the others.
    let houses = text.find("ObjectEnd\n").expect("its end") + "ObjectEnd\n".len();
    let second = text[houses..].to_owned();
    text += "Translate -1600 0 0\n";
    text += &second;
    let scene = folder.file("city.pbrt", &text);
    let line = stdout(&["info", &scene, "--json"]);
    let info: serde_json::Value = serde_json::from_str(&line).expect("JSON");
    assert_eq!(info["lights"], 1_000_000_000, "all of them");
    assert_eq!(info["placed_lights"]["stored"], 10_000, "of one house");
    assert_eq!(info["kinds"][0]["count"], 1_000_000_000, "the inventory");
    let area = info["kinds"][0]["area"].as_f64().expect("an area");
    assert!(
        (area / (1e9 * 0.5 * 0.05 * 0.09) - 1.0).abs() < 1e-3,
        "{area}"
    );
    assert!(info["tree"]["quality"].as_f64() < Some(10.0), "{line}");
    assert!(info["tree"]["bytes"].as_u64() < Some(100_000_000), "{line}");

    let picture = folder.path("city.exr");
    let flags = ["--width", "8", "--height", "6", "--spp", "4"];
    stdout(&[&["render", &scene, "-o", &picture][..], &flags].concat());
    let black = folder.path("black.exr");
    let dark = ["--light-scale", "1e-9", "-o", &black];
    stdout(&[&["render", &scene][..], &dark, &flags].concat());
    let compared = stdout(&["compare", &picture, &black, "--json"]);
    let compared: serde_json::Value = serde_json::from_str(&compared).expect("JSON");
    assert!(
        compared["mse"].as_f64() > Some(1e-6),
        "it is lit: {compared}"
    );

    assert_refused(&["bench", &scene], &["33554432", "1000000000"]);
}
