//! Every light sampler against a reference that the exhaustive one rendered, on a small scene with
//! many lamps.

use core::fmt::Write;

use light_render::SamplerKind;

use crate::program::folder::{Folder, stdout};

/// A floor under forty lamps of two strengths, and a wall that keeps half of the floor from half of
/// them.
fn scene(folder: &Folder) -> String {
    folder.file(
        "scene.mtl",
        "newmtl matt\nKd .6 .6 .6\nnewmtl dim\nKe 2 3 4\nnewmtl strong\nKe 90 60 30\n",
    );
    let mut text = String::from("mtllib scene.mtl\nusemtl matt\n");
    let mut quad = |material: &str, corners: [[f32; 3]; 4]| {
        let _ = writeln!(text, "usemtl {material}");
        for [x, y, z] in corners {
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        text.push_str("f -4 -3 -2 -1\n");
    };
    quad(
        "matt",
        [
            [-2.0, 0.0, -2.0],
            [-2.0, 0.0, 2.0],
            [2.0, 0.0, 2.0],
            [2.0, 0.0, -2.0],
        ],
    );
    quad(
        "matt",
        [
            [0.0, 0.0, -2.0],
            [0.0, 0.6, -2.0],
            [0.0, 0.6, 2.0],
            [0.0, 0.0, 2.0],
        ],
    );
    for i in 0..40u8 {
        let (x, z) = (f32::from(i % 8) * 0.5 - 1.75, f32::from(i / 8) * 0.8 - 1.6);
        let y = 0.4 + 0.1 * f32::from(i % 3);
        let material = if i % 7 == 0 { "strong" } else { "dim" };
        let r = 0.04;
        quad(
            material,
            [
                [x - r, y, z - r],
                [x + r, y, z - r],
                [x + r, y, z + r],
                [x - r, y, z + r],
            ],
        );
    }
    folder.file("lamps.obj", &text)
}

#[test]
fn all_samplers_agree_with_the_exhaustive_reference() {
    let folder = Folder::new("samplers");
    let scene = scene(&folder);
    let render = |out: &str, sampler: &str, spp: &str, seed: &str| {
        let look = [
            "--width",
            "20",
            "--height",
            "12",
            "--look-at",
            "0,2.5,4,0,0,0,0,1,0",
        ];
        let how = [
            "--light-sampler",
            sampler,
            "--spp",
            spp,
            "--seed",
            seed,
            "--max-depth",
            "3",
        ];
        stdout(&[&["render", &scene, "-o", out], &look[..], &how].concat());
    };
    let reference = folder.path("reference.exr");
    render(&reference, "exhaustive", "512", "1");
    for kind in SamplerKind::ALL {
        let out = folder.path("out.exr");
        render(&out, kind.name(), "128", "2");
        let line = stdout(&[
            "compare",
            &out,
            &reference,
            "--json",
            "--max-relmse",
            "0.05",
        ]);
        let figures: serde_json::Value = serde_json::from_str(&line).expect("one line of JSON");
        for channel in 0..3 {
            let of = |name: &str| figures[name][channel].as_f64().expect("a number");
            let (bias, error) = (of("bias"), of("bias_se"));
            assert!(bias.abs() < 4.0 * error, "{kind}: {line}");
        }
    }
}
