//! What `lights info` prints.

use std::fs;

use crate::program::folder::{Folder, LIT, UNLIT, assert_refused, stdout};

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
fn info_counts_area_lights_by_shape() {
    let folder = Folder::new("shapes");
    let lamps = ["disk", "sphere", "sphere", "cylinder", "sphere"];
    let lamps = lamps.map(|shape| format!("Translate 3 0 0 Shape \"{shape}\"\n"));
    let emission = "WorldBegin AreaLightSource \"diffuse\"\n";
    let scene = folder.file("lamps.pbrt", &format!("{emission}{}", lamps.concat()));
    let line = stdout(&["info", &scene, "--json"]);
    let report: serde_json::Value = serde_json::from_str(&line).expect("one line of JSON");
    let kind = &report["kinds"][0];
    assert_eq!(kind["kind"], "area", "{line}");
    assert_eq!(kind["count"], 5, "{line}");
    let shapes = serde_json::json!({ "sphere": 3, "disk": 1, "cylinder": 1 });
    assert_eq!(kind["shapes"], shapes, "{line}");
    let words = stdout(&["info", &scene]);
    let lines: Vec<Vec<_>> = words
        .lines()
        .map(|line| line.split_whitespace().collect())
        .collect();
    for counted in [["sphere", "3"], ["disk", "1"], ["cylinder", "1"]] {
        assert!(
            lines.iter().any(|line| *line == counted),
            "{counted:?}: {words}"
        );
    }
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
