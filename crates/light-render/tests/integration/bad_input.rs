//! Broken files of every format end the program with status 2 and one line on standard error.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use light_scene::glam::Vec3;
use light_scene::{Image, write_image};

/// Runs the program on a file of the folder; what it says if it ends with status 2.
fn refusal(folder: &Path, arguments: &[&str], file: &str) -> Option<String> {
    let path = folder.join(file);
    let mut command = Command::new(env!("CARGO_BIN_EXE_lights"));
    // Pictures without a name of their own are written to the current folder.
    let output = command
        .args(arguments)
        .arg(&path)
        .current_dir(folder)
        .output();
    let output = output.expect("the program runs");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let code = output.status.code();
    assert!(
        matches!(code, Some(0 | 2)),
        "{file}: status {code:?}: {said}"
    );
    (code == Some(2)).then_some(said)
}

/// A folder that is removed at the end.
struct Folder(PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        drop(fs::remove_dir_all(&self.0));
    }
}

#[test]
fn broken_files_of_every_format_end_with_status_2() {
    let name = format!("lights-bad-input-{}", std::process::id());
    let folder = Folder(std::env::temp_dir().join(name));
    let folder = &*folder.0;
    fs::create_dir_all(folder).expect("a folder");
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../light-scene/testdata/three_formats");
    let picture = Image::new(4, 4, vec![Vec3::splat(0.5); 16]).expect("an image");
    for image in ["a.exr", "a.hdr", "a.png"] {
        write_image(&folder.join(image), &picture).expect("written");
    }
    for (from, to) in [
        ("room.obj", "room.obj"),
        ("room.mtl", "room.mtl"),
        ("room.pbrt", "room.pbrt"),
        ("room.gltf", "room.gltf"),
        ("room.glb", "room.glb"),
        ("tiles.png", "tiles.png"),
    ] {
        fs::copy(data.join(from), folder.join(to)).expect("copied");
    }
    let ies =
        "IESNA:LM-63-2002\nTILT=NONE\n1 2000 1 3 1 1 2 0 0 0\n1 1 100\n0 60 90\n0\n500 250 0\n";
    fs::write(folder.join("a.ies"), ies).expect("written");
    let info = ["info", "--json"];
    let median = ["env", "median-cut", "-n", "2"];
    let cases: [(&str, &[&str]); 8] = [
        ("room.obj", &info),
        ("room.pbrt", &info),
        ("room.gltf", &info),
        ("room.glb", &info),
        ("a.exr", &median),
        ("a.hdr", &median),
        ("a.png", &median),
        ("a.ies", &["ies"]),
    ];
    for (file, arguments) in cases {
        let good = fs::read(folder.join(file)).expect("read");
        assert_eq!(refusal(folder, arguments, file), None, "{file} is good");
        let mut refused = 0;
        for k in 1..=6 {
            let cut = good.len() * k / 7;
            let hole = [&good[..cut], &b"\0x\xff"[..], &good[cut + 1..]].concat();
            for (kind, variant) in [("cut", good[..cut].to_vec()), ("hole", hole)] {
                let broken = format!("{kind}-{k}-{file}");
                fs::write(folder.join(&broken), variant).expect("written");
                if let Some(said) = refusal(folder, arguments, &broken) {
                    assert_eq!(said.lines().count(), 1, "{broken}: {said}");
                    assert!(
                        said.contains(&broken),
                        "{broken}: the file is named: {said}"
                    );
                    refused += 1;
                }
            }
        }
        assert!(refused >= 4, "{refused} of 12 variants of {file}");
    }
}

/// Parts of the pbrt format that the small rooms do not use.
const PBRT: &str = r#"LookAt 0 1 5  0 1 0  0 1 0
Camera "perspective" "float fov" 50
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
Attribute "shape" "float alpha" 1
Attribute "light" "float scale" 2
Texture "tiles" "spectrum" "imagemap" "string filename" "a.png" "string wrap" "clamp"
    "float uscale" 2 "float vscale" 3 "float udelta" .1 "float vdelta" .2 "bool invert" true
    "string encoding" "linear" "float scale" .5
Texture "more" "spectrum" "scale" "texture tex" "tiles" "float scale" .5
Texture "both" "spectrum" "mix" "texture tex1" "tiles" "texture tex2" "more" "float amount" .25
MakeNamedMaterial "red" "string type" "diffuse" "rgb reflectance" [ .8 .1 .1 ]
MakeNamedMaterial "tiled" "string type" "diffuse" "texture reflectance" "both"
Material "mix" "string materials" [ "red" "tiled" ] "float amount" .5
ObjectBegin "thing"
  Shape "sphere" "float radius" .5 "float phimax" 180
  Shape "disk" "float radius" 2 "float innerradius" 1 "float height" .5
  Shape "cylinder" "float zmin" 0 "float zmax" 1
ObjectEnd
AttributeBegin
  Translate 1 0 0
  ObjectInstance "thing"
  Rotate 30 0 1 0
  ObjectInstance "thing"
AttributeEnd
AreaLightSource "diffuse" "float power" 10 "bool twosided" true
Shape "sphere" "float radius" .25
"#;

/// Parts of the OBJ format that the small rooms do not use.
const OBJ: &str = "mtllib keys.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vn 0 0 1
o square
g one two
usemtl cloth
f 1/1/1 2/2/1 3/3/1
usemtl glass
f -4//1 -2//1 -1//1
";

/// Parts of the MTL format that the small rooms do not use.
const MTL: &str = "newmtl cloth
Kd .5 .5 .5
map_Kd -s 2 3 1 -o .5 .25 0 -clamp on a.png
Ke 1 1 1
map_Ke -clamp off -s 4 4 a.png
map_d -o .1 .1 a.png
d .75
Pr .3
newmtl glass
Ni 1.5
illum 7
Tr .5
newmtl metal
Kd .9 .7 .4
Pm 1
Ks .5 .5 .5
illum 3
";

/// Parts of glTF that the small rooms do not use.
const GLTF: &str = r#"{
 "asset": { "version": "2.0" },
 "extensionsUsed": [ "KHR_texture_transform", "KHR_lights_punctual",
 "KHR_materials_emissive_strength" ],
 "extensions": { "KHR_lights_punctual": { "lights": [
  { "type": "spot", "intensity": 20, "color": [ 1, 0.5, 0.25 ],
    "spot": { "innerConeAngle": 0.2, "outerConeAngle": 0.5 } },
  { "type": "directional", "intensity": 3 },
  { "type": "point", "intensity": 7, "range": 10 } ] } },
 "scene": 0,
 "scenes": [ { "nodes": [ 0, 1, 2, 3 ] } ],
 "nodes": [
  { "mesh": 0, "scale": [ 1, 2, 1 ], "rotation": [ 0, 0, 0, 1 ] },
  { "extensions": { "KHR_lights_punctual": { "light": 0 } }, "translation": [ 0, 3, 0 ] },
  { "extensions": { "KHR_lights_punctual": { "light": 1 } } },
  { "extensions": { "KHR_lights_punctual": { "light": 2 } } } ],
 "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0,
 "mode": 4 } ] } ],
 "materials": [ { "emissiveFactor": [ 1, 1, 1 ], "doubleSided": true, "alphaMode": "MASK",
 "alphaCutoff": 0.25,
  "emissiveTexture": { "index": 0, "extensions": { "KHR_texture_transform": {
   "offset": [ 0.5, 0.25 ], "rotation": 0.3, "scale": [ 2, 3 ] } } },
  "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 683 } } } ],
 "textures": [ { "source": 0, "sampler": 0 } ],
 "samplers": [ { "wrapS": 33071, "wrapT": 33648 } ],
 "images": [ { "uri": "a.png" } ],
 "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" },
  { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2" } ],
 "bufferViews": [ { "buffer": 0, "byteLength": 36 }, { "buffer": 0, "byteOffset": 36,
 "byteLength": 24 } ],
 "buffers": [ { "byteLength": 60, "uri": "a.bin" } ]
}
"#;

#[test]
fn broken_files_with_every_key_end_with_status_2() {
    /// Places at which each file is cut, and has a hole.
    const PLACES: usize = 160;
    /// The least number of variants that are refused: a text that ends early may still be a scene,
    /// and unknown names are left out with a warning.
    const BROKEN: usize = 200;
    /// As much of a library: the materials that a shorter one lacks are grey, with a warning.
    const BROKEN_LIBRARIES: usize = 100;
    let name = format!("lights-bad-keys-{}", std::process::id());
    let folder = Folder(std::env::temp_dir().join(name));
    let folder = &*folder.0;
    fs::create_dir_all(folder).expect("a folder");
    let picture = Image::new(4, 4, vec![Vec3::splat(0.5); 16]).expect("an image");
    write_image(&folder.join("a.png"), &picture).expect("written");
    let numbers = [
        0.0f32, 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 1.,
    ];
    let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
    fs::write(folder.join("a.bin"), bytes).expect("written");
    fs::write(folder.join("keys.mtl"), MTL).expect("written");
    for (file, good) in [
        ("keys.pbrt", PBRT),
        ("keys.obj", OBJ),
        ("keys.gltf", GLTF),
        ("keys.mtl", MTL),
    ] {
        let write = |name: &str, text: &[u8]| {
            fs::write(folder.join(name), text).expect("written");
            if !name.ends_with(".mtl") {
                return refusal(folder, &["info", "--json"], name);
            }
            let obj = OBJ.replace("keys.mtl", name);
            fs::write(folder.join("user.obj"), obj).expect("written");
            refusal(folder, &["info", "--json"], "user.obj")
        };
        assert_eq!(write(file, good.as_bytes()), None, "{file} is good");
        let good = good.as_bytes();
        let mut refused = 0;
        for k in 1..=PLACES {
            let cut = good.len() * k / (PLACES + 1);
            let hole = [&good[..cut], &b"\0x\xff"[..], &good[cut + 1..]].concat();
            for (kind, variant) in [("cut", &good[..cut]), ("hole", &*hole)] {
                let broken = format!("{kind}-{k}-{file}");
                if let Some(said) = write(&broken, variant) {
                    assert_eq!(said.lines().count(), 1, "{broken}: {said}");
                    let names = said.contains(&broken) || said.contains("user.obj");
                    assert!(names, "{broken}: the file is named: {said}");
                    refused += 1;
                }
            }
        }
        let least = if file.ends_with(".mtl") {
            BROKEN_LIBRARIES
        } else {
            BROKEN
        };
        assert!(refused >= least, "{refused} variants of {file}");
    }
}
