//! Corrupted variants of good files: every reader returns a scene or a message of one line, and
//! allocates no more memory than the size of the file justifies.

use std::fs;
use std::path::Path;

use crate::glam::Vec3;
use crate::image::tests::png;
use crate::test_folder::TestFolder;
use crate::{
    Diagnostic, Files, Image, parse_image, parse_luminaire, parse_obj, parse_ply, parse_scene,
    write_image,
};

/// Variants of each good file.
const VARIANTS: usize = 600;

/// Files with one part of `good` cut off, left out, or replaced.
fn variants(good: &[u8]) -> impl Iterator<Item = Vec<u8>> {
    const OTHERS: [&[u8]; 11] = [
        b"[",
        b"]",
        b"\"",
        b"-",
        b"x",
        b" ",
        b"\n",
        b"99999999999",
        b"\0",
        b"\xff",
        b"\x80",
    ];
    (0..VARIANTS).map(move |k| {
        // A prime stride visits all positions.
        let at = (k * 7919) % good.len();
        let (before, after) = (&good[..at], &good[at + 1..]);
        match k % 4 {
            0 => before.to_vec(),
            1 => [before, after].concat(),
            // One bit, as a bad copy flips it.
            2 => [before, &[good[at] ^ 1 << (k / 4 % 8)], after].concat(),
            _ => [before, OTHERS[k / 4 % OTHERS.len()], after].concat(),
        }
    })
}

/// How many variants are refused; each by one line that is not too long to read.
fn refused<T>(
    name: &str,
    good: &[u8],
    mut read: impl FnMut(&[u8]) -> Result<T, Diagnostic>,
) -> usize {
    if let Err(error) = read(good) {
        panic!("{name}: the good file: {error}");
    }
    let mut refused = 0;
    for (k, variant) in variants(good).enumerate() {
        if let Err(error) = read(&variant) {
            let shown = error.to_string();
            assert_eq!(shown.lines().count(), 1, "{name}, variant {k}: {shown:?}");
            assert!(shown.len() < 300, "{name}, variant {k}: {shown}");
            refused += 1;
        }
    }
    refused
}

const OBJ: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0 1\nv 1 1 0\nvt 0 1\nvn 0 0 1\no a\nusemtl a\n\
    f 1/1/1 2/1/1 3/1/1\nf -1//1 -2//1 -3//1\n";
const MTL: &str = "newmtl a\nKd .5 .5 .5\nKe 1 2 3\nillum 5\nNi 1.5\nnewmtl b\nd .5\nTr .5\n\
    Pr .3\nKs .1\n\
    map_d -s 2 2 1 -clamp on a.png\nmap_Kd -o .5 a.png\n";

#[test]
fn obj_and_its_materials() {
    let path = Path::new("no/such/file");
    let texel = png(image::GrayImage::new(1, 1));
    let read = |obj: &[u8], mtl: &[u8]| {
        let beside = |path: &Path| match path.extension() {
            Some(ending) if ending == "png" => Ok(texel.clone()),
            _ => Ok(mtl.to_vec()),
        };
        parse_obj(path, &String::from_utf8_lossy(obj), Files::new(&beside))
    };
    let n = refused("obj", OBJ.as_bytes(), |obj| read(obj, MTL.as_bytes()));
    assert!(n >= 100, "{n} of {VARIANTS} OBJ files");
    let n = refused("mtl", MTL.as_bytes(), |mtl| read(OBJ.as_bytes(), mtl));
    assert!(n >= 100, "{n} of {VARIANTS} MTL files");
}

#[test]
fn pbrt_and_its_meshes() {
    let pbrt = "LookAt 0 0 -5 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" [40]\n\
        Film \"rgb\" \"float cropwindow\" [0 .5 0 1] PixelFilter \"box\"\nWorldBegin\n\
        MakeNamedMaterial \"a\" \"string type\" \"diffuse\" MakeNamedMaterial \"b\" \
        \"string type\" \"conductor\"\n\
        AttributeBegin Material \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" .1\n\
        AreaLightSource \"diffuse\" \"blackbody L\" 3000 Rotate 30 0 1 0\n\
        Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [0 0 0 1 0 0 0 1 0]\n\
        AttributeEnd LightSource \"infinite\" \"rgb L\" [1 1 1] Shape \"disk\" \
        \"float alpha\" .5\n";
    let n = refused("pbrt", pbrt.as_bytes(), |bytes| {
        parse_scene(Path::new("a.pbrt"), bytes, Files::NONE)
    });
    assert!(n >= 100, "{n} of {VARIANTS} pbrt files");
    let head = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let text = format!("ply\nformat ascii 1.0\n{head}0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    let mut binary = format!("ply\nformat binary_little_endian 1.0\n{head}").into_bytes();
    binary.extend(
        [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]
            .map(f32::to_le_bytes)
            .concat(),
    );
    binary.push(3);
    binary.extend([0i32, 1, 2].map(i32::to_le_bytes).concat());
    let gzip = crate::gunzip::tests::gzipped(text.as_bytes());
    for (name, good) in [
        ("text", text.into_bytes()),
        ("binary", binary),
        ("gzip", gzip),
    ] {
        let n = refused(name, &good, |bytes| parse_ply(Path::new("a.ply"), bytes));
        assert!(n >= 100, "{n} of {VARIANTS} PLY files, {name}");
    }
}

#[test]
fn gltf_and_glb() {
    for (name, good) in [
        (
            "a.gltf",
            &include_bytes!("../testdata/three_formats/room.gltf")[..],
        ),
        (
            "a.glb",
            &include_bytes!("../testdata/three_formats/room.glb")[..],
        ),
    ] {
        let n = refused(name, good, |bytes| {
            parse_scene(Path::new(name), bytes, Files::NONE)
        });
        assert!(n >= 100, "{n} of {VARIANTS}: {name}");
    }
}

#[test]
fn luminaires() {
    let lm63 = "IESNA:LM-63-2002\n[TEST] a\n[MANUFAC] b\nTILT=NONE\n1 1000 1 3 2 1 2 0 0 0\n\
        1 1 100\n\
        0 60 90\n0 90\n500 250 0\n400 200 0\n";
    // One plane of three intensities, symmetrical about the vertical.
    let zeros = |n: usize| "0\n".repeat(n);
    let eulumdat = format!(
        "A maker\n1\n1\n1\n0\n3\n45\nreport\nA lamp\n1\na.ldt\ntoday\n{}100\n0\n1,0\n0\n1\n\
        1\nLED\n2000\n830\n80\n20\n{}0\n0\n45\n90\n100\n55\n10\n",
        zeros(9),
        zeros(10)
    );
    for (name, good) in [("a.ies", lm63), ("a.ldt", &eulumdat)] {
        let n = refused(name, good.as_bytes(), |bytes| {
            let text = String::from_utf8_lossy(bytes);
            parse_luminaire(Path::new(name), &text, Files::NONE)
        });
        assert!(n >= 100, "{n} of {VARIANTS}: {name}");
    }
}

#[test]
fn images() {
    let folder = TestFolder::new("broken_variants");
    let texel = |i: u8| Vec3::new(f32::from(i), 2.0, 0.5) / 35.0;
    let picture = Image::new(7, 5, (0..35).map(texel).collect()).expect("an image");
    for name in ["a.exr", "a.hdr", "a.png"] {
        let path = folder.path(name);
        write_image(&path, &picture).expect("written");
        let good = fs::read(&path).expect("read");
        let n = refused(name, &good, |bytes| parse_image(Path::new(name), bytes));
        assert!(n >= 100, "{n} of {VARIANTS}: {name}");
    }
    // Decoders of JPEG mend what they can.
    let path = folder.path("a.jpg");
    let grey = image::GrayImage::from_pixel(9, 8, image::Luma([77]));
    grey.save(&path).expect("written");
    let good = fs::read(&path).expect("read");
    let n = refused("a.jpg", &good, |bytes| {
        parse_image(Path::new("a.jpg"), bytes)
    });
    assert!(n >= 40, "{n} of {VARIANTS} JPEG files");
}
