//! Broken variants of good files: every reader answers each with a scene or with one line.

use std::path::Path;

use crate::Diagnostic;
use crate::obj::parse_obj;
use crate::pbrt::{parse_pbrt, parse_ply};

/// Texts with one place of `good` (ASCII) cut off, left out, or replaced.
fn variants(good: &str) -> impl Iterator<Item = String> {
    const OTHERS: [&str; 8] = ["[", "]", "\"", "-", "x", " ", "\n", "99999999999"];
    (0..600usize).map(move |k| {
        // A prime stride visits all places.
        let at = (k * 7919) % good.len();
        let (before, after) = good.split_at(at);
        match k % 3 {
            0 => before.to_owned(),
            1 => format!("{before}{}", &after[1..]),
            _ => format!("{before}{}{}", OTHERS[k / 3 % OTHERS.len()], &after[1..]),
        }
    })
}

fn check<T>(name: &str, variant: &str, answer: Result<T, Diagnostic>) -> usize {
    let Err(error) = answer else {
        return 0;
    };
    let shown = error.to_string();
    assert_eq!(shown.lines().count(), 1, "{name}: one line for {variant:?}");
    1
}

#[test]
fn text_formats() {
    let path = Path::new("no/such/file");
    let obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0 1\nv 1 1 0\nvt 0 1\nvn 0 0 1\no a\nusemtl a\n\
        f 1/1/1 2/1/1 3/1/1\nf -1//1 -2//1 -3//1\n";
    let mtl = "newmtl a\nKd .5 .5 .5\nKe 1 2 3\nillum 5\nNi 1.5\n";
    let pbrt = "LookAt 0 0 -5 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" [40]\nWorldBegin\n\
        AttributeBegin Material \"conductor\" \"float roughness\" .1\n\
        AreaLightSource \"diffuse\" \"blackbody L\" 3000 Rotate 30 0 1 0\n\
        Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [0 0 0 1 0 0 0 1 0]\n\
        AttributeEnd LightSource \"infinite\" \"rgb L\" [1 1 1] Shape \"disk\"\n";
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
        property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
        0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let mut refused = [0; 4];
    for text in variants(obj) {
        let answer = parse_obj(path, &text, &|_| Ok(mtl.to_owned()));
        refused[0] += check("obj", &text, answer);
    }
    for text in variants(mtl) {
        let answer = parse_obj(path, obj, &|_| Ok(text.clone()));
        refused[1] += check("mtl", &text, answer);
    }
    for text in variants(pbrt) {
        refused[2] += check("pbrt", &text, parse_pbrt(path, &text));
    }
    for text in variants(ply) {
        refused[3] += check("ply", &text, parse_ply(path, text.as_bytes()));
    }
    assert!(
        refused.iter().all(|&n| n >= 100),
        "refused {refused:?} of 600 each"
    );
}
