//! Files that the program reads stay as they are, and outputs end as what they hold.

use std::fs;
use std::path::Path;

use light_scene::glam::Vec3;
use light_scene::{Image, write_image};

use crate::program::folder::{Folder, LAMP, LIT, SMALL, assert_refused, stdout};

#[test]
fn an_output_is_none_of_the_inputs() {
    let folder = Folder::new("overwrite");
    let scene = folder.scene(LIT);
    let [a, b, kept] = ["a.exr", "b.exr", "kept.exr"].map(|name| folder.path(name));
    for (out, samples) in [(&a, "0..2"), (&b, "2..4")] {
        stdout(&[
            "render",
            &scene,
            "-o",
            out,
            "--width",
            "8",
            "--samples",
            samples,
        ]);
    }
    let before = fs::read(&a).expect("a part");
    assert_refused(&["merge", &a, &b, "-o", &a], &["a.exr", "a part"]);
    assert_refused(&["compare", &a, &b, "--diff", &b], &["b.exr", "--diff"]);
    assert_eq!(fs::read(&a).expect("a part"), before, "as it was");
    let other_spelling = format!(
        "{}/../{}/kept.exr",
        folder.0.display(),
        folder_name(&folder)
    );
    for out in [&kept, &other_spelling] {
        let render = ["render", &scene, "-o", out, "--checkpoint", &kept];
        assert_refused(
            &[&render, &SMALL[..]].concat(),
            &["kept.exr", "--checkpoint"],
        );
    }
    let missing = folder.path("missing/kept.exr");
    // Before the scene is read: its file is missing too.
    let render = [
        "render",
        "missing.obj",
        "-o",
        &kept,
        "--checkpoint",
        &missing,
    ];
    assert_refused(&render, &["missing/kept.exr", "cannot be written"]);
    assert!(!Path::new(&kept).exists(), "nothing is rendered");
}

/// Whatever the command is: nothing is read for long, and nothing is written.
#[test]
fn no_command_writes_over_what_it_reads() {
    let folder = Folder::new("own-input");
    let scene = folder.scene(LIT);
    let ies = folder.file("lamp.svg", LAMP);
    let sky = folder.path("sky.exr");
    let texels = vec![Vec3::ONE; 8];
    let map = Image::new(4, 2, texels).expect("texels");
    write_image(Path::new(&sky), &map).expect("a map");
    let lights = folder.file("set.lights", "point 0 0 1 1\n");
    let points = folder.file("set.points", "0 0 0 0 0 1\n");
    let prefix = folder.path("set");
    let spelled = format!("{}/./{}", folder.0.display(), "sky.exr");
    let set = ["bench", "--lights", &lights, "--points", &points];
    let commands: [(&[&str], &str); 8] = [
        (&["ies", &ies, "-o", &ies], "lamp.svg"),
        (
            &["render", &scene, "--env", &sky, "-o", &spelled],
            "sky.exr",
        ),
        (
            &[
                "render",
                &scene,
                "--env",
                &sky,
                "-o",
                "a.png",
                "--checkpoint",
                &sky,
            ],
            "sky.exr",
        ),
        (
            &["env", "median-cut", &sky, "-n", "2", "-o", &sky],
            "sky.exr",
        ),
        (&["env", "convert", &sky, &spelled], "sky.exr"),
        (&[&set[..], &["--write", &prefix]].concat(), "set.lights"),
        (
            &[
                "bench", "--lights", &points, "--points", &lights, "--write", &prefix,
            ],
            "set.lights",
        ),
        (&["report", &scene, "-o", &scene], "scene.obj"),
    ];
    let before = folder.names();
    let bytes = || {
        before
            .iter()
            .map(|name| fs::read(folder.path(name)).expect("a file"))
    };
    let contents: Vec<Vec<u8>> = bytes().collect();
    for (command, name) in commands {
        assert_refused(command, &[name, "another file"]);
    }
    assert_eq!(folder.names(), before, "no more files");
    assert!(contents.into_iter().eq(bytes()), "as they were");
}

/// Textures are known once the scene is read.
#[test]
fn no_picture_is_written_over_a_texture_or_a_library() {
    let folder = Folder::new("own-texture");
    let scene = folder.scene(&format!("{LIT}map_Kd wall.png\n"));
    let texture = folder.path("wall.png");
    let texels = Image::new(2, 2, vec![Vec3::ONE; 4]).expect("texels");
    write_image(Path::new(&texture), &texels).expect("a texture");
    let mesh = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                property float z\nelement face 1\nproperty list uchar int vertex_indices\n\
                end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let mesh = folder.file("mesh.html", mesh);
    let pbrt = folder.file(
        "scene.pbrt",
        "WorldBegin\nAreaLightSource \"diffuse\"\n\
         Shape \"plymesh\" \"string filename\" \"mesh.html\"\n",
    );
    let before = folder.names();
    let contents = [&texture, &mesh].map(|path| fs::read(path).expect("a file"));
    let spelled = format!("{}/./wall.png", folder.0.display());
    let render = ["render", &scene, "-o"];
    assert_refused(
        &[&render[..], &[&spelled]].concat(),
        &["wall.png", "another file"],
    );
    let both = ["a.exr", &texture].map(|path| ["-o", path]).concat();
    assert_refused(
        &[&["render", &scene], &both[..]].concat(),
        &["wall.png", "another file"],
    );
    assert_refused(
        &["report", &pbrt, "-o", &mesh],
        &["mesh.html", "another file"],
    );
    assert_eq!(folder.names(), before, "no more files");
    assert_eq!(
        [&texture, &mesh].map(|path| fs::read(path).expect("a file")),
        contents
    );
    let fine = folder.path("fine.png");
    stdout(&[&["render", &scene, "-o", &fine], &SMALL[..]].concat());
}

#[test]
fn outputs_end_as_what_is_written() {
    let folder = Folder::new("endings");
    let scene = folder.scene(LIT);
    let ies = folder.file("lamp.ies", LAMP);
    let [png, txt, svg] = ["a.png", "a.txt", "a.SVG"].map(|name| folder.path(name));
    assert_refused(&["ies", &ies, "-o", &png], &["a.png", ".svg"]);
    assert_refused(&["report", &scene, "-o", &txt], &["a.txt", ".html"]);
    assert!(!Path::new(&png).exists(), "nothing is written");
    stdout(&["ies", &ies, "-o", &svg]);
}

fn folder_name(folder: &Folder) -> String {
    let name = folder.0.file_name().expect("a name");
    name.to_string_lossy().into_owned()
}
