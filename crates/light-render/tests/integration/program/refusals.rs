//! Bad input and bad usage.

use std::fs;

use crate::program::folder::{Folder, LIT, assert_refused, lights, stdout};
use crate::program::watched::watch;

#[test]
fn bad_input_is_refused_in_one_line_and_leaves_nothing() {
    let folder = Folder::new("refuses");
    let scene = folder.scene(LIT);
    let out = folder.path("out.exr");
    let render = |scene: &str| assert_refused(&["render", scene, "-o", &out], &[scene]);
    render(&folder.path("missing.obj"));
    render(&folder.file("a.txt", "no scene"));
    render("no-such-scene");
    let broken = folder.file("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 one 0\nf 1 2 3\n");
    assert_refused(&["render", &broken, "-o", &out], &["broken.obj:3"]);
    let stray = folder.file(
        "stray.obj",
        "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl glass\nf 1 2 4\n",
    );
    assert_refused(
        &["render", &stray, "-o", &out],
        &["stray.obj:6", "vertex 4"],
    );
    folder.scene(LIT);
    let env = folder.file("env.exr", "not an image");
    assert_refused(&["render", &scene, "-o", &out, "--env", &env], &["env.exr"]);
    let nowhere = folder.path("no/such/out.exr");
    assert_refused(&["render", &scene, "-o", &nowhere], &["out.exr"]);
    assert_refused(
        &["render", &scene, "-o", &folder.path("out.gif")],
        &["out.gif", ".exr"],
    );
    assert!(
        !folder.names().iter().any(|name| name.starts_with("out")),
        "nothing is written"
    );
    assert!(
        !folder.names().iter().any(|name| name.contains("part")),
        "nothing half written"
    );
}

/// With the file that it may mean.
#[test]
fn a_light_without_area_is_hinted_at() {
    let folder = Folder::new("no-area");
    let scene = folder.file(
        "a.pbrt",
        "Camera \"perspective\" WorldBegin AreaLightSource \"diffuse\"\n\
         Shape \"trianglemesh\" \"point3 P\" [0 0 1 1 0 1 2 0 1] \"integer indices\" [0 1 2]\n",
    );
    let out = folder.path("a.exr");
    assert_refused(
        &["render", &scene, "-o", &out],
        &["a.pbrt: ", "without area"],
    );
}

#[test]
fn a_folder_is_no_scene() {
    let folder = Folder::new("is a Größe");
    let out = folder.path("out.exr");
    let path = folder.0.to_str().expect("a plain path");
    let render = ["render", path, "-o", &out];
    assert_refused(&render, &["expected a scene file"]);
    let scene = folder.scene(LIT);
    assert_refused(&render, &["is a folder; expected a file in it, as", &scene]);
    // Blanks and letters beyond ASCII are part of a path as all others.
    let done = lights(&["render", &scene, "-o", &out, "--width", "8", "--spp", "1"]);
    assert!(done.status.success(), "{done:?}");
}

/// The file, the line and the light.
#[test]
fn a_bad_light_of_a_set_is_named() {
    let folder = Folder::new("bad-light");
    let points = folder.file("a.points", "0 0 0 0 0 1\n");
    let good = "point 0 0 1 1\n";
    for bad in [
        "point 0 0 1 -1\n",
        "spot 0 0 1 0 0 0 1 30 31\n",
        "spot 0 0 1 0 0 nan 1 30 5\n",
    ] {
        let set = folder.file("a.lights", &format!("{good}{bad}{good}"));
        assert_refused(
            &["bench", "--lights", &set, "--points", &points],
            &["a.lights:2"],
        );
    }
}

#[test]
fn scenes_of_unknown_endings_are_told_what_there_is() {
    for name in ["x.pbt", "cornell.box", "nigth"] {
        let words = [name, ".pbrt", ".gltf", "cornell-box", "night"];
        assert_refused(&["render", name, "-o", "a.exr"], &words);
    }
}

#[test]
fn files_in_the_place_of_folders_are_named() {
    let folder = Folder::new("no-folders");
    let (scene, job) = (folder.scene(LIT), folder.file("job", ""));
    let words = "expected a folder, found a file";
    let farm = ["farm", &scene, "--engine", "slurm", "-o", &job];
    let farm = [&farm[..], &["--parts", "2", "--spp", "8"]].concat();
    assert_refused(&farm, &["job", words]);
    folder.file("out", "");
    watch(&folder.0, &[]).assert_refused(&["out", words]);
}

#[test]
fn parts_that_are_cut_off_are_not_taken_for_other_pictures() {
    let folder = Folder::new("cut-parts");
    let scene = folder.scene(LIT);
    let [part, cut, out] = ["part.exr", "cut.exr", "out.exr"].map(|name| folder.path(name));
    let render = ["render", &scene, "-o", &part, "--width", "8"];
    stdout(&[&render[..], &["--samples", "0..1"]].concat());
    let whole = fs::read(&part).expect("a part");
    let merge = ["merge", &cut, "-o", &out];
    for (count, words) in [
        (40, "end of the file is missing"),
        (whole.len() - 9, "damaged"),
    ] {
        fs::write(&cut, &whole[..count]).expect("written");
        assert_refused(&merge, &["cut.exr", words]);
    }
    fs::write(&cut, "no picture").expect("written");
    assert_refused(&merge, &["cut.exr", "rendered with --samples"]);
}

/// The parts are of a size that a scene may have, the whole is not.
#[test]
fn what_makes_a_scene_too_large_is_named() {
    let folder = Folder::new("too-large");
    let far = "Translate 2e19 0 0 Shape \"sphere\"\n";
    let object = "ObjectBegin \"box\"\nShape \"disk\"\nObjectEnd\nScale 1e20 1 1\n";
    for (name, shapes, farthest) in [
        (
            "apart",
            format!("{far}Translate -4e19 0 0 Shape \"disk\"\n"),
            "sphere",
        ),
        ("object", format!("{object}ObjectInstance \"box\"\n"), "box"),
    ] {
        let scene = format!("WorldBegin LightSource \"infinite\"\n{shapes}");
        let scene = folder.file(&format!("{name}.pbrt"), &scene);
        let reaches = format!("`{farthest}` reaches farthest");
        let words = [name, "of a size of about 1e-19 to 1e19", &reaches];
        assert_refused(&["info", &scene], &words);
        assert_refused(&["bench", &scene], &words);
    }
}

#[test]
fn nonsense_on_the_command_line_is_refused() {
    let folder = Folder::new("nonsense");
    let scene = folder.scene(LIT);
    let out = folder.path("out.exr");
    let with = |flag: &str, value: &str| {
        assert_refused(&["render", &scene, "-o", &out, flag, value], &[flag]);
    };
    for (flag, value) in [
        ("--spp", "0"),
        ("--spp", "many"),
        ("--max-depth", "-1"),
        ("--light-samples", "0"),
        ("--width", "0"),
        ("--time", "0"),
        ("--fov", "nan"),
        ("--light-sampler", "best"),
        ("--estimator", "luck"),
        ("--look-at", "1,2,3"),
        ("--look-at", "0,0,0,0,0,0,0,1,0"),
    ] {
        with(flag, value);
    }
    assert_refused(
        &["render", &scene, "-o", &out, "--fov", "180"],
        &["--fov", "between 0 and 180"],
    );
    let far = "--look-at=1e30,0,0,0,0,0,0,1,0";
    assert_refused(
        &["render", &scene, "-o", &out, far],
        &["--look-at", "1e-19 to 1e19 apart"],
    );
    // A number below 0 is a value, not a flag.
    let compare = ["compare", &out, &out, "--max-bias", "-1"];
    assert_refused(&compare, &["--max-bias", "not negative"]);
    let bench = ["bench", "--generate", "uniform", "--seed", "-1"];
    assert_refused(&bench, &["--seed", "whole number from 0"]);
    let none = ["render", &scene, "-o", &out, "--light-samples", "0"];
    assert_refused(&none, &["--light-samples", "whole number from 1"]);
    let again = ["render", &scene, "-o", &out, "--watch", "--skip-existing"];
    assert_refused(&again, &["--watch", "--skip-existing"]);
    assert_refused(&["render", &scene], &["--output"]);
    assert_refused(&["redner"], &["redner"]);
    assert_refused(&["paint"], &["'paint'; `--help` lists the commands"]);
    assert_refused(&["--paint"], &["'--paint' found; `--help` lists the flags"]);
    assert_refused(&["env"], &["lights env", "convert", "median-cut"]);
    assert_refused(&["render", &scene, "-o", &out, "--sp", "4"], &["--sp"]);
    assert_refused(&["compare", &out, &out], &["out.exr"]);
    assert_eq!(
        lights(&["--help"]).status.code(),
        Some(0),
        "help was asked for"
    );
}

#[test]
fn limits_below_zero_are_named() {
    for limit in ["--max-bias", "--max-relmse"] {
        for value in ["-inf", "-1", "inf", "nan"] {
            let compare = ["compare", "a.exr", "b.exr", limit, value];
            assert_refused(&compare, &[limit, value, "not negative"]);
        }
    }
}

#[test]
fn scenes_end_in_capitals_too() {
    let folder = Folder::new("capitals");
    let scene = fs::read_to_string(folder.scene(LIT)).expect("a scene");
    let upper = folder.file("ROOM.OBJ", &scene);
    let out = folder.path("out.exr");
    let done = lights(&["render", &upper, "-o", &out, "--width", "8", "--spp", "1"]);
    assert!(done.status.success(), "{done:?}");
}
