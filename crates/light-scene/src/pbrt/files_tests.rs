use crate::gunzip::tests::gzipped;
use std::path::Path;

use super::parse_pbrt;
use crate::glam::Vec3;
use crate::{Alpha, Color, Diagnostic, Files, Scene, Surface};

/// A scene in several files, as exporters write them: the first one lies in `dir`.
fn read(first: &str) -> Result<Scene, String> {
    const TRIANGLE: &[u8] = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n\
        property float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n\
        3 0 1 2\n";
    const GEOMETRY: &[u8] = b"Translate 0 0 3 NamedMaterial \"red\" Shape \"plymesh\" \"string \
                              filename\" \"geometry/a.ply\"";
    const MATERIALS: &[u8] =
        b"MakeNamedMaterial \"red\" \"string type\" [ \"diffuse\" ] \"rgb reflectance\" \
            [ .9 .1 .1 ]";
    fn read_sibling(path: &Path) -> Result<Vec<u8>, Diagnostic> {
        match path.to_str() {
            Some("dir/geometry/all.pbrt") => Ok(GEOMETRY.into()),
            Some("dir/geometry/a.ply") => Ok(TRIANGLE.into()),
            Some("dir/materials.pbrt") => Ok(MATERIALS.into()),
            _ => Err(Diagnostic::file(path, "cannot be read")),
        }
    }
    let scene = parse_pbrt(Path::new("dir/a.pbrt"), first, Files::new(&read_sibling));
    scene.map_err(|error| error.to_string())
}

const TRIANGLE: &str = "Shape \"trianglemesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0]";

#[test]
fn names_of_files_start_from_the_folder_of_the_first_one() {
    let text =
        format!("WorldBegin Include \"geometry/all.pbrt\" {TRIANGLE} Include \"materials.pbrt\"");
    let scene = read(&text).expect("a scene");
    assert_eq!(scene.warnings, [], "all understood");
    let heights = scene.meshes.iter().map(|mesh| mesh.positions[0].z);
    assert_eq!(heights.collect::<Vec<_>>(), [3.0; 2], "the state goes on");
}

#[test]
fn what_an_imported_file_does_to_the_state_ends_with_it() {
    let text =
        format!("WorldBegin Import \"materials.pbrt\" Import \"geometry/all.pbrt\" {TRIANGLE}");
    let scene = read(&text).expect("a scene");
    let heights = scene.meshes.iter().map(|mesh| mesh.positions[0].z);
    assert_eq!(heights.collect::<Vec<_>>(), [3.0, 0.0], "moved, and not");
    assert_ne!(
        scene.meshes[0].material, scene.meshes[1].material,
        "red, and not"
    );
}

#[test]
fn materials_may_be_described_after_their_use() {
    let light = "AreaLightSource \"diffuse\" \"rgb L\" [ 1 1 1 ]";
    let text = format!(
        "WorldBegin NamedMaterial \"red\" {light} {TRIANGLE} Material \"mix\" \
         \"string materials\" [\"red\" \"blue\"] Translate 0 0 1 {TRIANGLE}
        Include \"materials.pbrt\" MakeNamedMaterial \"blue\" \"string type\" \"interface\""
    );
    let scene = read(&text).expect("a scene");
    let lamp = scene.material(scene.meshes[0].material);
    let reflectance = Color::Constant(Vec3::new(0.9, 0.1, 0.1));
    assert_eq!(lamp.surface, Surface::Diffuse { reflectance }, "red");
    assert!(lamp.emission.is_some(), "and is emissive");
    let Surface::Mix { materials, .. } = scene.material(scene.meshes[1].material).surface else {
        panic!("a mixture");
    };
    let parts = materials.map(|part| scene.material(part).surface.clone());
    assert_eq!(
        parts,
        [Surface::Diffuse { reflectance }, Surface::Interface],
        "parts"
    );
    let late = "WorldBegin NamedMaterial \"m\"
        MakeNamedMaterial \"a\" \"string type\" \"diffuse\"
        MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string materials\" [\"a\" \"a\"]";
    let expected = "dir/a.pbrt:1: expected the mixture \"m\" to be described before its use";
    assert_eq!(
        read(late).map(|_| ()),
        Err(expected.to_owned()),
        "a mixture"
    );
}

#[test]
fn attributes_speak_to_what_follows_in_their_block() {
    let text = format!(
        "WorldBegin
        AttributeBegin
        Attribute \"shape\" \"float alpha\" .5 \"float gloss\" 2
        Attribute \"material\" \"rgb reflectance\" [ .1 .2 .3 ]
        Material \"diffuse\" {TRIANGLE} {TRIANGLE} \"float alpha\" .25
        AttributeEnd
        {TRIANGLE}"
    );
    let scene = read(&text).expect("a scene");
    let shares: Vec<_> = scene
        .meshes
        .iter()
        .map(|mesh| {
            let alpha = scene.material(mesh.material).alpha;
            alpha.map(|Alpha { opacity, .. }| opacity)
        })
        .collect();
    let share = |share: f32| Some(Color::Constant(Vec3::splat(share)));
    assert_eq!(
        shares,
        [share(0.5), share(0.25), None],
        "unless the shape says otherwise"
    );
    let reflectance = Color::Constant(Vec3::new(0.1, 0.2, 0.3));
    let surface = &scene.material(scene.meshes[0].material).surface;
    assert_eq!(
        surface,
        &Surface::Diffuse { reflectance },
        "of the material"
    );
    let warnings: Vec<_> = scene.warnings.iter().map(ToString::to_string).collect();
    let expected = "dir/a.pbrt:3: Attribute: parameter `gloss` was ignored";
    assert_eq!(warnings, [expected], "nobody asked for it");
}

#[test]
fn the_world_and_the_camera_are_coordinate_systems() {
    let text = format!(
        "Translate 0 0 -4 Camera \"perspective\" WorldBegin
        Translate 1 0 0 CoordinateSystem \"here\"
        CoordSysTransform \"world\" {TRIANGLE} CoordSysTransform \"camera\" {TRIANGLE} \
                            CoordSysTransform \"here\" {TRIANGLE}"
    );
    let scene = read(&text).expect("a scene");
    let corners: Vec<_> = scene.meshes.iter().map(|mesh| mesh.positions[0]).collect();
    assert_eq!(
        corners,
        [Vec3::ZERO, Vec3::Z * 4.0, Vec3::X],
        "where they are"
    );
}

/// Each file includes the next one twice: at a depth of 30 they are 2^30.
#[test]
fn files_that_double_are_refused_by_a_limit() {
    fn read_sibling(path: &Path) -> Result<Vec<u8>, Diagnostic> {
        let name = path.file_name().and_then(|name| name.to_str());
        let depth: u32 = name.and_then(|name| name.parse().ok()).unwrap_or_default();
        let next = format!("Include \"{}\"\n", depth + 1);
        Ok(if depth < 30 {
            next.repeat(2).into()
        } else {
            Vec::new()
        })
    }
    let scene = parse_pbrt(
        Path::new("a"),
        "WorldBegin Include \"1\"",
        Files::new(&read_sibling),
    );
    let error = scene.map(|_| ()).expect_err("too many").to_string();
    assert!(
        error.ends_with(": expected at most 65536 included files"),
        "{error}"
    );
}

/// A compressed mesh of 2 kB that unpacks to 0.6 of the most: it may be named once.
#[test]
fn compressed_meshes_count_together() {
    fn mesh(_: &Path) -> Result<Vec<u8>, Diagnostic> {
        let spaces = " ".repeat(650_000);
        let text = format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
             property float z\nelement face 1\nproperty list uchar int vertex_indices\n\
             end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n{spaces}"
        );
        Ok(gzipped(text.as_bytes()))
    }
    let read = |count| {
        let shape = "Shape \"plymesh\" \"string filename\" \"a.ply.gz\"\n";
        let text = format!("WorldBegin\n{}", shape.repeat(count));
        parse_pbrt(Path::new("a.pbrt"), &text, Files::new(&mesh))
    };
    let scene = read(1).expect("one mesh");
    assert_eq!(scene.triangle_count(), 1, "a triangle");
    let error = read(2).map(|_| ()).expect_err("two meshes").to_string();
    assert!(
        error.contains("a.ply.gz")
            && error
                .ends_with(": expected at most 1048576 bytes in all compressed meshes together"),
        "{error}"
    );
}

#[test]
fn an_imported_file_ends_what_it_begins() {
    for text in ["AttributeBegin", "TransformBegin", "AttributeEnd"] {
        let files = |_: &Path| Ok(text.as_bytes().to_vec());
        // One file of that text, however it is named.
        let files: &'static dyn Fn(&Path) -> Result<Vec<u8>, Diagnostic> =
            Box::leak(Box::new(files));
        let scene = "WorldBegin AttributeBegin\nImport \"b\"\nAttributeEnd";
        let scene = parse_pbrt(Path::new("a"), scene, Files::new(files));
        let error = scene.map(|_| ()).expect_err(text).to_string();
        let expected = "a:2: expected a file that ends what it begins, and nothing else";
        assert_eq!(error, expected, "{text}");
    }
}

#[test]
fn blocks_and_attributes_have_limits() {
    let refusal = |text: &str| {
        let scene = parse_pbrt(Path::new("a"), text, Files::NONE);
        scene.map(|_| ()).expect_err("too many").to_string()
    };
    let blocks = "AttributeBegin ".repeat((1 << 16) + 1);
    let error = "a:1: expected at most 65536 blocks in each other";
    assert_eq!(refusal(&blocks), error, "blocks");
    let attributes = "Attribute \"shape\" \"float alpha\" 1 ".repeat(257);
    let error = "a:1: expected at most 256 `Attribute`s in force";
    assert_eq!(refusal(&attributes), error, "attributes");
}
