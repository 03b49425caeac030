//! `lights bench SCENE`.

use serde_json::Value;

use crate::program::folder::{Folder, LIT, UNLIT, assert_refused, lights, stdout};

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

/// What the rows of `args` say, and what comes on standard error.
fn rows_and_words(args: &[&str]) -> (Vec<Value>, String) {
    let output = lights(args);
    let [rows, words] = [output.stdout, output.stderr].map(|text| {
        let text = String::from_utf8(text);
        text.expect("text")
    });
    assert_eq!(output.status.code(), Some(0), "{args:?}: {words}");
    let rows = rows.lines().map(serde_json::from_str);
    (rows.collect::<Result<_, _>>().expect("JSON"), words)
}

#[test]
fn a_scene_without_light_is_measured_under_the_sky_that_a_picture_shows() {
    let folder = Folder::new("bench-dark");
    let dark = folder.scene(UNLIT);
    let few = ["--samplers", "uniform", "--var-points", "8", "--json"];
    let measure = |more: &[&str]| rows_and_words(&[&["bench", &dark], &few[..], more].concat());
    let (rows, words) = measure(&[]);
    assert_eq!(rows[0]["n_lights"], 1, "a sky: {rows:?}");
    assert!(
        words.contains("no light in the scene") && words.contains("`overcast`"),
        "{words}"
    );
    // A clear sky has a sun beside it.
    let (rows, words) = measure(&["--sky", "clear-noon"]);
    assert_eq!((&rows[0]["n_lights"], &words[..]), (&2.into(), ""));
}

#[test]
fn scales_change_what_each_light_of_a_scene_gives() {
    let folder = Folder::new("bench-scales");
    let scene = folder.scene(LIT);
    let few = ["--samplers", "uniform", "--var-points", "8", "--json"];
    let v = |more: &[&str]| {
        let sky = ["bench", &scene, "--sky", "uniform"];
        let (rows, _) = rows_and_words(&[&sky, &few[..], more].concat());
        rows[0]["v_mean"].as_f64().expect("a number")
    };
    let plain = v(&[]);
    for more in [["--env-scale", "1e-6"], ["--light-scale", "1e-6"]] {
        let scaled = v(&more);
        assert!(
            (scaled - plain).abs() > 1e-2 * plain,
            "{more:?}: {scaled}, {plain}"
        );
    }
    // As much of both is the same again.
    let both = v(&["--env-scale", "8", "--light-scale", "8"]);
    assert!((both - plain).abs() < 1e-4 * plain, "{both}, {plain}");
}

#[test]
fn what_does_not_fit_a_scene_is_refused() {
    let folder = Folder::new("bench-refused");
    let fog = "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" WorldBegin";
    let black = folder.file("black.pbrt", fog);
    assert_refused(&["bench", &black], &["black.pbrt", "no light", "--sky"]);
    for flag in ["--env-scale", "--light-scale"] {
        assert_refused(
            &["bench", "--generate", "uniform", flag, "2"],
            &[flag, "cannot be used with"],
        );
        assert_refused(&["bench", flag, "2"], &["SCENE"]);
    }
    assert_refused(
        &["bench", "--generate", "uniform", "--sky", "overcast"],
        &["--sky", "cannot be used with"],
    );
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
