use std::fs;
use std::path::Path;

use super::ply::parse_ply;
use super::read_pbrt;
use crate::glam::{Affine3A, Vec2, Vec3};
use crate::test_folder::TestFolder;
use crate::{Color, Diagnostic, Prototype, Scene, Surface};
use ::lights::sources::LightDesc;

pub(super) fn read(name: &str, text: &str) -> Result<Scene, String> {
    let folder = TestFolder::new(name);
    let path = folder.path("a.pbrt");
    fs::write(&path, text).expect("written");
    let shown = |error: Diagnostic| {
        let error = error.to_string();
        error.replace(&*path.to_string_lossy(), "a.pbrt")
    };
    read_pbrt(&path).map_err(shown)
}

const BOX: &str = r#"
LookAt 0 0 -5  0 0 0  0 1 0
Camera "perspective" "float fov" [ 40 ] "float lensradius" 0.1 "float focaldistance" 5
Film "rgb" "integer xresolution" 64 "integer yresolution" [ 48 ] "string filename" "a.exr"
WorldBegin
MakeNamedMaterial "gold" "string type" "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k" "float roughness" 0.04
AttributeBegin
  Material "diffuse" "rgb reflectance" [ .1 .2 .3 ]
  AreaLightSource "diffuse" "rgb L" [ 1 2 3 ] "float scale" 2 "bool twosided" true
  Translate 0 2 0
  Shape "trianglemesh" "integer indices" [ 0 1 2  0 2 3 ]
    "point3 P" [ 0 0 0  1 0 0  1 0 1  0 0 1 ] "point2 uv" [ 0 0 1 0 1 1 0 1 ]
AttributeEnd
NamedMaterial "gold"
ObjectBegin "ball" Shape "sphere" "float radius" 0.5 ObjectEnd
TransformBegin Translate 3 0 0 ObjectInstance "ball" TransformEnd
ObjectInstance "ball"
LightSource "point" "rgb I" [ 4 4 4 ] "point3 from" [ 0 1 0 ] "float fog" 1
LightSource "spot" "blackbody I" 3000 "point3 to" [ 0 0 1 ]
LightSource "distant" "point3 from" [ 0 1 0 ] "point3 to" [ 0 0 0 ]
LightSource "infinite" "rgb L" [ .5 .5 .5 ]
"#;

#[test]
fn reads_camera_materials_shapes_instances_and_lights() {
    let scene = read("pbrt_box", BOX).expect("a scene");
    let camera = scene.camera.expect("a camera");
    assert!(
        camera.right.abs_diff_eq(Vec3::X, 1e-6),
        "left-handed: x right"
    );
    assert!(camera.position.abs_diff_eq(Vec3::NEG_Z * 5.0, 1e-5), "eye");
    assert_eq!(camera.resolution, Some([64, 48]), "film");
    assert_eq!(camera.lens.expect("a lens").focus_distance, 5.0, "lens");
    let [quad] = &scene.meshes[..] else {
        panic!("one mesh, not {}", scene.meshes.len());
    };
    assert_eq!(quad.positions[0], Vec3::Y * 2.0, "translated");
    assert_eq!(scene.emissive_triangle_count(), 2, "the quad shines");
    let emission = scene.material(quad.material).emission.expect("emission");
    let radiance = Color::Constant(Vec3::new(2.0, 4.0, 6.0));
    assert_eq!(emission.radiance, radiance, "scaled");
    assert_eq!(emission.sides, crate::EmissionSides::Both, "two-sided");
    let [Prototype { name, meshes }] = &scene.prototypes[..] else {
        panic!("one object, not {}", scene.prototypes.len());
    };
    assert_eq!((name.as_str(), meshes.len()), ("ball", 1), "a sphere");
    let ball = &meshes[0];
    let places: Vec<_> = scene.placements.iter().map(|p| p.place).collect();
    let moved = [Vec3::X * 3.0, Vec3::ZERO].map(Affine3A::from_translation);
    assert_eq!(places, moved, "placed twice");
    let gold = &scene.material(ball.material).surface;
    let Surface::Conductor { alpha, .. } = gold else {
        panic!("a metal, not {gold:?}");
    };
    assert!(
        alpha.abs_diff_eq(Vec2::splat(0.2), 1e-6),
        "root of roughness"
    );
    assert!(
        matches!(
            scene.lights[..],
            [
                LightDesc::Point(_),
                LightDesc::Spot(_),
                LightDesc::Distant(_),
                LightDesc::UniformInfinite(_)
            ]
        ),
        "four lights"
    );
    let warnings: Vec<_> = scene.warnings.iter().map(|w| w.message.as_str()).collect();
    let expected = [
        "Shape \"sphere\" was made of triangles",
        "LightSource \"point\": parameter `fog` was ignored",
    ];
    assert_eq!(warnings, expected, "named once");
    assert_eq!(
        scene.warnings[1].place,
        crate::Place::Line(18),
        "with its line"
    );
}

#[test]
fn alpha_is_the_share_that_is_there() {
    let share = |alpha: &str| {
        let text = format!("WorldBegin Shape \"disk\" {alpha}");
        let scene = read("pbrt_alpha", &text).expect("a scene");
        let alpha = scene.material(scene.meshes[0].material).alpha;
        alpha.map(|alpha| (alpha.share, alpha.cutoff))
    };
    let half = Color::Constant(Vec3::splat(0.5));
    assert_eq!(share("\"float alpha\" 0.5"), Some((half, None)), "half");
    assert_eq!(share("\"float alpha\" 1"), None, "all of it");
    assert_eq!(share(""), None, "nothing said");
}

#[test]
fn spectra_come_from_files_and_by_name() {
    fn table(path: &Path) -> Result<Vec<u8>, Diagnostic> {
        match path.to_str() {
            Some("dir/grey.spd") => Ok(b"# nm value\n300 3\n900 3 # flat\n".to_vec()),
            Some("dir/odd.spd") => Ok(b"300 3 900".to_vec()),
            _ => Err(Diagnostic::file(path, "cannot be read")),
        }
    }
    let text = |light: &str| {
        format!(
            "WorldBegin LightSource \"point\" \"spectrum I\" \"{light}\" \
             Material \"conductor\" \"spectrum eta\" \"grey.spd\" \"spectrum k\" [300 4 900 4] Shape \"disk\""
        )
    };
    let read = |light: &str| {
        let scene = super::parse_pbrt(
            Path::new("dir/a.pbrt"),
            &text(light),
            crate::Files::new(&table),
        );
        scene.map_err(|error| error.to_string())
    };
    let scene = read("stdillum-D65").expect("a scene");
    let LightDesc::Point(light) = &scene.lights[0] else {
        panic!("a point light");
    };
    assert!(
        light.emission.abs_diff_eq(Vec3::ONE, 0.01),
        "white: {}",
        light.emission
    );
    let Surface::Conductor { eta, k, .. } = scene.material(scene.meshes[0].material).surface else {
        panic!("a metal");
    };
    assert!(
        eta.abs_diff_eq(Vec3::splat(3.0), 0.02),
        "of the file: {eta}"
    );
    assert!(k.abs_diff_eq(Vec3::splat(4.0), 0.03), "above 1: {k}");
    let error = read("odd.spd").expect_err("three numbers");
    let expected = "dir/a.pbrt:1: dir/odd.spd: expected pairs of a wavelength and a value";
    assert_eq!(error, expected, "pairs");
    let unknown = read("stdillum-X").expect("a scene");
    let warning = &unknown.warnings[0].message;
    assert_eq!(
        warning, "the spectrum of `I` is not understood and was taken as white",
        "named"
    );
}

#[test]
fn mixtures_hold_their_parts() {
    let of = |materials: &str, amount: &str| {
        let text = format!(
            "WorldBegin MakeNamedMaterial \"a\" \"string type\" \"diffuse\" \
             MakeNamedMaterial \"b\" \"string type\" \"interface\" \
             Material \"mix\" {materials} {amount} Shape \"disk\""
        );
        let scene = read("pbrt_mix", &text)?;
        assert_eq!(
            scene.warnings.len(),
            1,
            "of the disk alone: {:?}",
            scene.warnings
        );
        Ok::<_, String>(scene.material(scene.meshes[0].material).surface.clone())
    };
    let both = "\"string materials\" [\"a\" \"b\"]";
    for (amount, expected) in [("\"float amount\" 0.2", 0.2), ("", 0.5)] {
        let mix = Surface::Mix {
            materials: [crate::MaterialId(0), crate::MaterialId(1)],
            amount: Color::Constant(Vec3::splat(expected)),
        };
        assert_eq!(of(both, amount), Ok(mix), "{amount}");
    }
    for (materials, expected) in [
        ("", "a.pbrt:1: expected \"string materials\" with two names"),
        (
            "\"string materials\" [\"a\"]",
            "a.pbrt:1: expected \"string materials\" with two names",
        ),
        (
            "\"string materials\" [\"a\" \"c\"]",
            "a.pbrt:1: expected a named material, found \"c\"",
        ),
    ] {
        assert_eq!(of(materials, ""), Err(expected.to_owned()), "{materials}");
    }
}

#[test]
fn fronts_follow_pbrt() {
    let front = |text: &str| {
        let all =
            format!("WorldBegin {text} Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]");
        let scene = read("pbrt_fronts", &all).expect("a scene");
        let [a, b, c] = scene.meshes[0].triangle(0);
        (b - a).cross(c - a).z
    };
    assert_eq!(front(""), 1.0, "counter-clockwise");
    assert_eq!(front("ReverseOrientation"), -1.0, "reversed");
    // The mirrored triangle runs clockwise, and mirroring turns that over once more.
    assert_eq!(front("Scale -1 1 1"), 1.0, "mirrored");
}

#[test]
fn broken_files_give_one_clear_line() {
    let cases = [
        ("", "a.pbrt: expected `WorldBegin`"),
        ("WorldBegin 3", "a.pbrt:1: expected a directive, found `3`"),
        (
            "WorldBegin \"x\"",
            "a.pbrt:1: expected a directive, found \"x\"",
        ),
        ("\nFoo", "a.pbrt:2: expected a directive, found `Foo`"),
        (
            "Translate 1 2",
            "a.pbrt:1: expected a distance, found the end of the file",
        ),
        (
            "Translate 1 2 x",
            "a.pbrt:1: expected a distance, found `x`",
        ),
        (
            "Scale 0 1 1",
            "a.pbrt:1: expected a transform that can be inverted",
        ),
        (
            "Rotate 1 0 0 0",
            "a.pbrt:1: expected an axis other than 0 0 0",
        ),
        (
            "LookAt 0 0 0 0 0 0 0 1 0",
            "a.pbrt:1: expected two points, and an up vector not along the view",
        ),
        ("AttributeEnd", "a.pbrt:1: expected `AttributeBegin` before"),
        ("TransformEnd", "a.pbrt:1: expected `TransformBegin` before"),
        ("ObjectEnd", "a.pbrt:1: expected `ObjectBegin` before"),
        (
            "NamedMaterial \"a\"",
            "a.pbrt:1: expected a named material, found \"a\"",
        ),
        (
            "Camera",
            "a.pbrt:1: expected a type in quotes, found the end of the file",
        ),
        (
            "Camera \"perspective\" \"float\" 1",
            "a.pbrt:1: expected \"TYPE NAME\", found \"float\"",
        ),
        (
            "Camera \"perspective\" \"float fov\" ]",
            "a.pbrt:1: expected a value of `fov`, found `]`",
        ),
        (
            "Camera \"perspective\" \"float fov\" [1",
            "a.pbrt:1: expected a value of `fov`, found the end of the file",
        ),
        (
            "Camera \"perspective\" \"float fov\" 200",
            "a.pbrt:1: expected a fov between 0 and 180 degrees",
        ),
        ("Shape \"trianglemesh\"", "a.pbrt:1: expected \"point3 P\""),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0]",
            "a.pbrt:1: expected \"integer indices\" from 0 on",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0] \"integer indices\" [0 0 7]",
            "a.pbrt:1: vertex 7 of 1 does not exist",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0] \"integer indices\" [0 0]",
            "a.pbrt:1: expected three indices a triangle, found 2",
        ),
        (
            "Shape \"plymesh\"",
            "a.pbrt:1: expected \"string filename\"",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"point2 uv\" [0 0]",
            "a.pbrt:1: expected as many normals and texture coordinates as vertices, 3",
        ),
        (
            "Include \"a.pbrt\"",
            "a.pbrt:1: expected a file that does not include itself",
        ),
    ];
    for (text, expected) in cases {
        let error = read("pbrt_broken", text).expect_err(text);
        assert_eq!(error, expected, "{text}");
    }
}

#[test]
fn ply_in_text_and_binary() {
    let path = Path::new("a.ply");
    let head = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        )
    };
    let text = head("ascii") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    let expected = parse_ply(path, text.as_bytes()).expect("a mesh");
    assert_eq!(expected.indices, [[0, 1, 2], [0, 2, 3]], "a fan");
    let corners = [
        [0.0f32, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    for (format, little) in [("binary_little_endian", true), ("binary_big_endian", false)] {
        let mut bytes = head(format).into_bytes();
        for x in corners.as_flattened() {
            bytes.extend(if little {
                x.to_le_bytes()
            } else {
                x.to_be_bytes()
            });
        }
        bytes.push(4);
        for i in 0..4i32 {
            bytes.extend(if little {
                i.to_le_bytes()
            } else {
                i.to_be_bytes()
            });
        }
        let mesh = parse_ply(path, &bytes).expect("a mesh");
        assert_eq!(mesh, expected, "{format}");
        let error = parse_ply(path, &bytes[..bytes.len() - 1]).expect_err("cut");
        assert!(error.message.starts_with("expected more data"), "{error}");
    }
    let compressed = crate::gunzip::tests::gzipped(text.as_bytes());
    let mesh = parse_ply(path, &compressed).expect("a mesh");
    assert_eq!(mesh, expected, "gzip");
    let broken = [
        ("x\n", "a.ply:1: expected `ply`"),
        ("ply\n", "a.ply:2: expected `end_header`"),
        (
            "ply\nfoo\n",
            "a.ply:2: expected a line of a PLY header, found `foo`",
        ),
        ("ply\nend_header\n", "a.ply:3: expected a `format` line"),
    ];
    for (text, expected) in broken {
        let error = parse_ply(path, text.as_bytes()).expect_err(text);
        assert_eq!(error.to_string(), expected, "{text}");
    }
    let text = head("ascii") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 9\n";
    let error = parse_ply(path, text.as_bytes()).expect_err("an index");
    assert!(
        error.to_string().contains("vertex 9 of 4 does not exist"),
        "{error}"
    );
}
