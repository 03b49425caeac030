//! `lights bench SCENE`.

use serde_json::Value;

use crate::folder::{Folder, LIT, UNLIT, assert_refused, stdout};

#[test]
fn the_lights_of_a_scene_are_measured_like_those_of_a_set() {
    let folder = Folder::new("bench-scene");
    let scene = folder.scene(LIT);
    let args = [
        "bench",
        &scene,
        "--samplers",
        "uniform,bvh",
        "--var-points",
        "32",
    ];
    let lines = stdout(&[&args[..], &["--json"]].concat());
    let rows: Vec<Value> = lines
        .lines()
        .map(|line| serde_json::from_str(line).expect("a line of JSON"))
        .collect();
    assert_eq!(rows.len(), 2, "a line a sampler: {lines}");
    for (row, sampler) in rows.iter().zip(["uniform", "bvh"]) {
        assert_eq!(row["sampler"], sampler, "{row}");
        assert_eq!(
            (&row["set"], &row["n_lights"]),
            (&"scene".into(), &2.into()),
            "{row}"
        );
        assert_eq!(row["v_points"], 32, "{row}");
        for law in ["pmf_mismatch", "pmf_nan"] {
            assert_eq!(row[law], 0.0, "{law}: {row}");
        }
        // Two triangles of one lamp over a floor: neither gives all.
        let v = row["v_mean"].as_f64().expect("a number");
        assert!((0.0..1.0).contains(&v), "{row}");
        assert!(row["ns_sample"].as_f64().expect("a number") > 0.0, "{row}");
    }
    let table = stdout(&[&args[..], &["--shadows", "--k", "2"]].concat());
    for words in [
        "V mean",
        "32 points",
        "estimated",
        "all 2 lights",
        "what surfaces hide",
    ] {
        assert!(table.contains(words), "{words:?} in {table}");
    }
}

#[test]
fn what_does_not_fit_a_scene_is_refused() {
    let folder = Folder::new("bench-refused");
    let dark = folder.scene(UNLIT);
    assert_refused(&["bench", &dark], &["scene.obj", "no light"]);
    let lamp = folder.file("lamp.mtl", "newmtl lamp\nKe 1 1 1\n");
    assert!(lamp.ends_with("lamp.mtl"), "{lamp}");
    let text = "mtllib lamp.mtl\nusemtl lamp\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let lamp = folder.file("lamp.obj", text);
    assert_refused(&["bench", &lamp], &["lamp.obj", "surface that scatters"]);
    let scene = folder.scene(LIT);
    for more in [
        &["--generate", "uniform"][..],
        &["--n", "10"],
        &["--truth", "area"],
        &["--receiver", "medium"],
        &["--occluders", "3"],
        &["--refits", "2"],
    ] {
        assert_refused(
            &[&["bench", &scene], more].concat(),
            &["cannot be used with"],
        );
    }
    assert_refused(
        &["bench", "--shadows", "--generate", "uniform"],
        &["--shadows"],
    );
    assert_refused(&["bench"], &["SCENE", "--generate"]);
}
