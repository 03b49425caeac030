use std::fs;

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
MakeNamedMaterial "gold" "string type" "conductor" "spectrum eta" "metal-Au-eta"
    "spectrum k" "metal-Au-k" "float roughness" 0.04
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
    assert_eq!(scene.emissive_triangle_count(), 2, "the quad is emissive");
    let emission = scene.material(quad.material).emission.expect("emission");
    let radiance = Color::Constant(Vec3::new(2.0, 4.0, 6.0));
    assert_eq!(emission.radiance, radiance, "scaled");
    assert_eq!(emission.sides, crate::EmissionSides::Both, "two-sided");
    let [Prototype { name, quadrics, .. }] = &scene.prototypes[..] else {
        panic!("one object, not {}", scene.prototypes.len());
    };
    assert_eq!((name.as_str(), quadrics.len()), ("ball", 1), "a sphere");
    let ball = &quadrics[0];
    let transforms: Vec<_> = scene.instances.iter().map(|i| i.transform).collect();
    let moved = [Vec3::X * 3.0, Vec3::ZERO].map(Affine3A::from_translation);
    assert_eq!(transforms, moved, "two instances");
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
    let expected = ["LightSource \"point\": parameter `fog` was ignored"];
    assert_eq!(warnings, expected, "named once");
    assert_eq!(
        scene.warnings[0].location,
        crate::Location::Line(19),
        "with its line"
    );
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
