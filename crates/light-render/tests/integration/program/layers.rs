//! Pictures by groups of lights.

use std::path::Path;

use light_render::light_scene::ChannelFile;

use crate::program::folder::{Folder, assert_refused, stdout};

/// A floor below a lamp and a point, under a sky.
fn scene(lights: &[&str]) -> String {
    let floor = "Shape \"trianglemesh\" \"integer indices\" [0 1 2 1 3 2] \
        \"point3 P\" [-2 0 -2  2 0 -2  -2 0 2  2 0 2]\n";
    let camera = "LookAt 0 3 4  0 0 0  0 1 0\nCamera \"perspective\"\nWorldBegin\n";
    let grey = "MakeNamedMaterial \"grey\" \"string type\" \"diffuse\"\nNamedMaterial \"grey\"\n";
    format!("{camera}{grey}{floor}{}", lights.concat())
}

const POINT: &str = "LightSource \"point\" \"rgb I\" [3 2 1] \"point3 from\" [0 1 1]\n";
const SKY: &str = "LightSource \"infinite\" \"rgb L\" [.1 .2 .3]\n";
const LAMP: &str = "AttributeBegin\nMakeNamedMaterial \"lamp.001\" \"string type\" \"diffuse\"\n\
    NamedMaterial \"lamp.001\"\nAreaLightSource \"diffuse\" \"rgb L\" [8 8 4]\nTranslate -1 1 0\n\
    Shape \"sphere\" \"float radius\" .2\nAttributeEnd\n";

fn render(scene: &str, out: &str, more: &[&str]) -> ChannelFile {
    let size = ["--width", "16", "--height", "12", "--spp", "64"];
    stdout(&[&["render", scene, "-o", out], &size[..], more].concat());
    ChannelFile::read(Path::new(out)).expect("a picture")
}

fn mean(file: &ChannelFile, channel: &str) -> f64 {
    let texels = file.channel(channel).expect(channel);
    texels.iter().copied().map(f64::from).sum::<f64>() / texels.len() as f64
}

/// The sum of the layers is the picture, which is that without layers, and each layer is what its
/// lights alone give.
#[test]
fn layers_add_up_to_the_picture() {
    let folder = Folder::new("layers");
    let out = folder.path("a.exr");
    let all = folder.file("all.pbrt", &scene(&[POINT, SKY, LAMP]));
    let aov = ["--aov", "groups"];
    let file = render(&all, &out, &aov);
    let plain = render(&all, &folder.path("b.exr"), &[]);
    let layers = [("lamp.001", LAMP), ("point", POINT), ("uniform sky", SKY)];
    assert_eq!(file.channels.len(), 3 * (1 + layers.len()), "and no more");
    for color in ["R", "G", "B"] {
        let whole = file.channel(color).expect("the picture");
        for (pixel, &x) in whole.iter().enumerate() {
            let of = |name: &str| file.channel(&format!("{name}.{color}")).expect(name)[pixel];
            let sum: f32 = layers.iter().map(|(name, _)| of(name)).sum();
            assert!((sum - x).abs() <= 1e-5 * x, "{sum}, not {x} in {color}");
            let same = plain.channel(color).expect("the picture")[pixel];
            assert!((same - x).abs() <= 1e-4 * x, "{same}, not {x} without");
        }
    }
    for (name, light) in layers {
        let alone = folder.file("alone.pbrt", &scene(&[light]));
        let alone = render(&alone, &folder.path("c.exr"), &[]);
        for color in ["R", "G", "B"] {
            let ratio = mean(&file, &format!("{name}.{color}")) / mean(&alone, color);
            assert!((ratio - 1.0).abs() < 0.05, "{name}.{color}: {ratio}");
        }
    }
}

#[test]
fn patterns_name_groups() {
    let folder = Folder::new("groups");
    let out = folder.path("a.exr");
    let all = folder.file("all.pbrt", &scene(&[POINT, SKY, LAMP]));
    let asked = [
        "--aov",
        "groups",
        "--group",
        "key=lamp*",
        "--group",
        "key=light 0",
    ];
    let file = render(&all, &out, &asked);
    let names: Vec<&str> = file
        .channels
        .iter()
        .map(|(name, _)| name.as_str())
        .collect();
    let expected = [
        "B", "G", "R", "key.B", "key.G", "key.R", "rest.B", "rest.G", "rest.R",
    ];
    assert_eq!(names, expected, "one group, and the rest");
    let render = ["render", &all, "--spp", "1", "--width", "4", "-o"];
    let refused = |more: &[&str], words: &[&str]| {
        assert_refused(&[&render, more].concat(), words);
    };
    let none = [&out, "--aov", "groups", "--group", "key=bulb"];
    refused(&none, &["all.pbrt", "group key", "bulb", "lamp.001"]);
    refused(&[&out, "--group", "key=lamp*"], &["--aov"]);
    refused(
        &[&out, "--aov", "groups", "--samples", "0..1"],
        &["--samples"],
    );
    let once = ["--integrator", "single-scattering"];
    refused(
        &[&[&*out, "--aov", "groups"], &once[..]].concat(),
        &["volpath"],
    );
    refused(&[&folder.path("a.png"), "--aov", "groups"], &[".exr"]);
}
