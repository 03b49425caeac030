//! Files that pbrt renders although something in them cannot be used.

use super::tests::read;
use crate::glam::Vec3;
use crate::{Color, Scene, Surface};

const TRIANGLE: &str = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]";

fn read_world(text: &str) -> Scene {
    read("pbrt_leniency", &format!("WorldBegin\n{text}")).expect("a scene")
}

fn warnings(scene: &Scene) -> Vec<&str> {
    scene.warnings.iter().map(|w| w.message.as_str()).collect()
}

#[test]
fn what_a_transform_makes_flat_is_left_out() {
    let flat = "AttributeBegin Scale 1 1 0";
    let light = "LightSource \"point\"";
    let ball = "ObjectBegin \"ball\" Shape \"sphere\" ObjectEnd ObjectInstance \"ball\"";
    let all =
        format!("{flat} {TRIANGLE} {light} {TRIANGLE} AttributeEnd {TRIANGLE} {light} {ball}");
    let scene = read_world(&format!(
        "{all} {flat} ObjectInstance \"ball\" AttributeEnd"
    ));
    assert_eq!(scene.meshes.len(), 1, "the one outside of the block");
    assert_eq!(
        (scene.lights.len(), scene.instances.len()),
        (1, 1),
        "and so here"
    );
    let left_out = "under a transform that cannot be inverted was left out";
    let expected = [
        format!("Shape \"trianglemesh\" {left_out} (and 1 more like it)"),
        format!("LightSource \"point\" {left_out}"),
        format!("`ObjectInstance` {left_out}"),
    ];
    assert_eq!(warnings(&scene), expected, "each kind once, with its count");
    let back = read_world(&format!("Scale 1 1 0 Identity {TRIANGLE}"));
    assert_eq!(
        (back.meshes.len(), back.warnings.len()),
        (1, 0),
        "no longer flat"
    );
}

#[test]
fn normals_that_are_no_numbers_are_dropped() {
    for word in ["nan", "-nan", "inf", "-nan(ind)"] {
        let scene = read_world(&format!("{TRIANGLE} \"normal N\" [0 0 2 0 {word} 1 0 0 1]"));
        let normals = scene.meshes[0].normals.as_deref();
        let expected = [Vec3::Z, Vec3::ZERO, Vec3::Z];
        assert_eq!(normals, Some(&expected[..]), "the others stay");
        let expected = "Shape \"trianglemesh\" has normals that are not finite, which were dropped";
        assert_eq!(warnings(&scene), [expected], "named");
    }
    let error = read(
        "pbrt_nan",
        "WorldBegin Shape \"trianglemesh\" \"point3 P\" [0 0 nan]",
    );
    let expected = "a.pbrt:1: expected a number as a value of `P`, found `nan`";
    assert_eq!(
        error.map(drop),
        Err(expected.to_owned()),
        "of places there is no use"
    );
}

#[test]
fn a_mesh_file_may_have_normals_that_are_no_numbers() {
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
        property float z\nproperty float nx\nproperty float ny\nproperty float nz\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let body = "0 0 0 0 0 1\n1 0 0 0 nan 1\n0 1 0 0 0 1\n3 0 1 2\n";
    let mesh = super::parse_ply(
        std::path::Path::new("a.ply"),
        (header.to_owned() + body).as_bytes(),
    );
    let normals = mesh.expect("a mesh").normals;
    assert_eq!(normals, Some(vec![Vec3::Z, Vec3::ZERO, Vec3::Z]), "dropped");
}

#[test]
fn what_moves_is_shown_at_its_start() {
    let moved = "ActiveTransform StartTime Translate 0 0 1 ActiveTransform EndTime \
        Translate 0 0 5 Rotate 90 1 0 0 ActiveTransform All Translate 1 0 0";
    let scene = read_world(&format!("{moved} {TRIANGLE}"));
    assert_eq!(
        scene.meshes[0].positions[0],
        Vec3::new(1.0, 0.0, 1.0),
        "its start"
    );
    let expected = "`ActiveTransform` moves something; the picture shows it at its start time";
    assert_eq!(warnings(&scene), [expected], "named");
    let ended =
        format!("AttributeBegin ActiveTransform EndTime AttributeEnd Translate 2 0 0 {TRIANGLE}");
    let scene = read_world(&ended);
    assert_eq!(
        scene.meshes[0].positions[0],
        Vec3::X * 2.0,
        "the block ends it"
    );
    let times = read("pbrt_times", "TransformTimes 0 .5 WorldBegin").expect("a scene");
    let expected = "`TransformTimes` moves something; the picture shows it at its start time";
    assert_eq!(warnings(&times), [expected], "named");
}

#[test]
fn options_have_a_name_and_a_value() {
    for option in [
        "\"seed\" 5",
        "\"integer seed\" [ 5 ]",
        "\"msereferenceimage\" \"a.exr\"",
    ] {
        let text = format!("Option {option} WorldBegin {TRIANGLE}");
        let scene = read("pbrt_option", &text).expect("a scene");
        let [warning] = warnings(&scene)[..] else {
            panic!("one warning, not {:?}", scene.warnings);
        };
        assert!(
            warning.starts_with("`Option \"") && warning.ends_with(" was ignored"),
            "{warning}"
        );
    }
}

#[test]
fn names_are_not_cut_and_kinds_are_counted() {
    let long = "a_texture_whose_name_is_longer_than_a_line_of_an_error_message_would_have_room_for";
    let uses =
        (0..3).map(|n| format!("Material \"diffuse\" \"texture reflectance\" \"{long}{n}\""));
    let scene = read_world(&uses.collect::<Vec<_>>().join("\n"));
    let taken = "is not defined before it is used and was taken as grey (and 2 more like it)";
    assert_eq!(
        warnings(&scene),
        [format!("texture \"{long}0\" {taken}")],
        "one kind"
    );
    let foggy = |name: &str| {
        format!("MakeNamedMedium \"{name}\" \"string type\" \"homogeneous\" \"float fog\" 1")
    };
    let media = read_world(&format!("{}\n{}", foggy("a"), foggy("b")));
    let expected = "MakeNamedMedium: parameter `fog` was ignored (and 1 more like it)";
    assert_eq!(warnings(&media), [expected], "whatever their names");
    let line = crate::Location::Line(2);
    assert_eq!(scene.warnings[0].location, line, "where the first one is");
}

#[test]
fn clouds_of_another_program_are_named_with_what_converts_them() {
    let cloud = "MakeNamedMedium \"c\" \"string type\" \"nanovdb\" \"string filename\" \"a.nvdb\"";
    let scene = read_world(cloud);
    let expected = "the medium type \"nanovdb\" is not read and was taken as vacuum; \
        `nanovdb2pbrt FILE.nvdb` of pbrt-v4 prints its grid as a \"uniformgrid\"";
    assert!(
        warnings(&scene).contains(&expected),
        "{:?}",
        warnings(&scene)
    );
}

/// The color at (u, v) of a surface.
fn color_at(scene: &Scene, uv: [f32; 2]) -> f32 {
    let material = scene.meshes[0].material;
    let Surface::Diffuse {
        reflectance: Color::Image(shown),
    } = scene.material(material).surface
    else {
        panic!("an image");
    };
    let image = scene.images[shown.image.0 as usize].to_light();
    image
        .expect("light")
        .on_surface(uv.into(), &shown.mapping)
        .x
}

#[test]
fn checkerboards_have_sharp_checks() {
    let textured = |parameters: &str| {
        let texture = format!("Texture \"t\" \"spectrum\" \"checkerboard\" {parameters}");
        let material = "Material \"diffuse\" \"texture reflectance\" \"t\"";
        read_world(&format!("{texture} {material} {TRIANGLE}"))
    };
    let colors = "\"rgb tex1\" [.25 .25 .25] \"rgb tex2\" [.75 .75 .75]";
    let scene = textured(&format!("{colors} \"float uscale\" 2 \"float vscale\" 3"));
    assert_eq!(scene.warnings, [], "all read");
    for (uv, expected) in [
        ([0.25, 0.17], 0.25),
        ([0.75, 0.17], 0.75),
        ([0.25, 0.5], 0.75),
        ([0.75, 0.5], 0.25),
        ([0.49, 0.32], 0.25),
        ([0.51, 0.32], 0.75),
        ([1.25, 0.17], 0.25),
        ([-0.25, 0.17], 0.75),
    ] {
        let found = color_at(&scene, uv);
        assert!(
            (found - expected).abs() < 1e-6,
            "{uv:?}: {found}, not {expected}"
        );
    }
    let plain = textured("");
    assert_eq!(
        [color_at(&plain, [0.5, 0.5]), color_at(&plain, [1.5, 0.5])],
        [1.0, 0.0],
        "1, 0"
    );
    let solid = textured(&format!("{colors} \"integer dimension\" 3"));
    let material = solid.meshes[0].material;
    let mean = Color::Constant(Vec3::splat(0.5));
    let surface = Surface::Diffuse { reflectance: mean };
    assert_eq!(solid.material(material).surface, surface, "its mean");
    let expected = "Texture \"checkerboard\" of dimension 3 was taken as its mean";
    assert_eq!(warnings(&solid), [expected], "named");
}

#[test]
fn unknown_kinds_are_told_with_those_that_exist() {
    let scene = read_world(&format!(
        "LightSource \"spto\" \"rgb I\" [1 1 1] Material \"difuse\" {TRIANGLE} Shape \"shpere\""
    ));
    assert_eq!((scene.lights.len(), scene.meshes.len()), (0, 1), "the rest");
    let expected = [
        "LightSource \"spto\" is not understood and was left out: expected distant, goniometric, \
         infinite, point, projection or spot",
        "material \"difuse\" is not understood and was taken as diffuse: expected coatedconductor, \
         coateddiffuse, conductor, dielectric, diffuse, diffusetransmission, interface, mix or \
         thindielectric",
        "Shape \"shpere\" is not understood and was left out: expected bilinearmesh, curve, \
         cylinder, disk, loopsubdiv, plymesh, sphere or trianglemesh",
    ];
    assert_eq!(warnings(&scene), expected, "each once");
}
