use std::fs;

use lights::media::{AnyMedium, Medium};
use lights::sources::Rgb;

use super::read_pbrt;
use crate::Scene;
use crate::glam::Vec3;
use crate::test_folder::TestFolder;

fn read(name: &str, text: &str) -> Result<Scene, String> {
    let folder = TestFolder::new(name);
    let path = folder.path("a.pbrt");
    fs::write(&path, text).expect("written");
    read_pbrt(&path).map_err(|error| {
        error
            .to_string()
            .replace(&*path.to_string_lossy(), "a.pbrt")
    })
}

const SCENE: &str = r#"
MediumInterface "" "air"
Camera "perspective"
MakeNamedMedium "air" "string type" "homogeneous" "rgb sigma_a" [ 1 2 3 ] "rgb sigma_s" [ 4 5 6 ]
    "float scale" .5
  "rgb Le" [ 1 0 0 ] "float Lescale" 2 "float g" -.3
WorldBegin
MakeNamedMedium "milk" "string type" "homogeneous" "string preset" "Skimmilk"
AttributeBegin
  Translate 1 0 0
  MakeNamedMedium "smoke" "string type" "uniformgrid" "integer nx" 2 "integer ny" 1 "integer nz" 1
    "float density" [ 1 3 ] "float temperature" [ 0 1500 ] "rgb sigma_a" [ 1 1 1 ]
    "rgb sigma_s" [ 2 2 2 ]
    "point3 p0" [ 0 0 0 ] "point3 p1" [ 2 1 1 ]
AttributeEnd
MakeNamedMedium "dye" "string type" "rgbgrid" "integer nx" 1 "integer ny" 1 "integer nz" 2
  "rgb sigma_a" [ 1 0 0  0 0 2 ] "float scale" 10 "rgb Le" [ 1 1 1  1 1 1 ]
MakeNamedMedium "puff" "string type" "cloud"
AttributeBegin
  Material "interface"
  MediumInterface "smoke" "air"
  Shape "sphere"
  Shape "sphere" "float radius" 2
AttributeEnd
MediumInterface "air"
Material ""
Shape "sphere" "float radius" 3
LightSource "point"
"#;

fn at(medium: &AnyMedium<Rgb>, p: Vec3) -> [Vec3; 3] {
    let here = medium.coefficients(p, &());
    [here.sigma_a, here.sigma_s, here.emission]
}

#[test]
fn media_are_read_with_their_coefficients_and_their_places() {
    let scene = read("pbrt_media", SCENE).expect("a scene");
    let names: Vec<&str> = scene.media.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(
        names,
        ["air", "milk", "smoke", "dye", "puff"],
        "by first use"
    );
    let [air, milk, smoke, dye, puff] = [0, 1, 2, 3, 4].map(|i| &scene.media[i].medium);

    let sigma_a = Vec3::new(0.5, 1.0, 1.5);
    let expected = [sigma_a, Vec3::new(2.0, 2.5, 3.0), Vec3::X];
    assert_eq!(at(air, Vec3::ZERO), expected, "scaled; Le times sigma_a");
    assert!(
        air.phase().pdf(Vec3::X, Vec3::X) > air.phase().pdf(Vec3::X, Vec3::NEG_X),
        "g < 0"
    );
    assert_eq!(at(milk, Vec3::ZERO)[1], Vec3::new(0.7, 1.22, 1.9), "preset");

    let [a, s, glow] = at(smoke, Vec3::new(2.5, 0.5, 0.5));
    assert!(
        a.abs_diff_eq(Vec3::splat(3.0), 1e-5) && s.abs_diff_eq(2.0 * a, 1e-5),
        "{a} {s}"
    );
    assert!(
        glow.x > glow.y && glow.y > glow.z && glow.z >= 0.0,
        "red-hot: {glow}"
    );
    assert_eq!(
        at(smoke, Vec3::new(0.5, 0.5, 0.5))[0],
        Vec3::ZERO,
        "moved by 1"
    );

    let [a, s, glow] = at(dye, Vec3::new(0.5, 0.5, 0.25));
    assert!(a.abs_diff_eq(Vec3::X * 10.0, 1e-4), "red below: {a}");
    assert!(
        s.abs_diff_eq(Vec3::ONE, 1e-5),
        "1 where it is not given: {s}"
    );
    assert!(glow.abs_diff_eq(a, 1e-4), "Le of 1: {glow}");
    assert!(at(puff, Vec3::new(0.5, 0.1, 0.5))[1].x > 0.5, "dense below");

    let air_id = scene.camera_medium.expect("a medium");
    assert_eq!(air_id.index(), 0, "the camera is in air");
    let media = |i: usize| scene.material(scene.quadrics[i].material).media;
    assert_eq!(
        media(0).inside.map(|id| id.index()),
        Some(2),
        "smoke inside"
    );
    assert_eq!(media(0).outside, Some(air_id), "air outside");
    assert_eq!(
        scene.quadrics[0].material, scene.quadrics[1].material,
        "one twin"
    );
    assert_eq!(
        media(2),
        lights::sources::MediumInterface::default(),
        "no boundary"
    );
    assert_ne!(
        scene.quadrics[0].material, scene.quadrics[2].material,
        "another"
    );
}

#[test]
fn bad_media_are_refused_with_the_line() {
    let grid = |rest: &str| {
        format!("MakeNamedMedium \"m\" \"string type\" \"uniformgrid\" \"integer nx\" 2 {rest}")
    };
    let homogeneous =
        |rest: &str| format!("MakeNamedMedium \"m\" \"string type\" \"homogeneous\" {rest}");
    let cases = [
        (
            homogeneous("\"rgb sigma_a\" [ 1 -1 1 ]"),
            "expected a colour of at least 0 for `sigma_a`",
        ),
        (
            homogeneous("\"float scale\" -1"),
            "expected `scale` of at least 0, found -1",
        ),
        (
            homogeneous("\"rgb Le\" [ 0 0 -1 ]"),
            "expected a colour of at least 0 for `Le`",
        ),
        (
            homogeneous("\"rgb sigma_s\" [ 1 nan 1 ]"),
            "expected a number as a value of `sigma_s`, found `nan`",
        ),
        (
            homogeneous("\"float g\" 1.5"),
            "medium \"m\": the asymmetry of a phase function must lie between -1 and 1, \
             both excluded",
        ),
        (
            grid("\"float density\" [ 1 ]"),
            "medium \"m\": expected 2 values of `density` for a grid of 2 x 1 x 1, found 1",
        ),
        (
            grid("\"float density\" [ 1 -2 ]"),
            "medium \"m\": `density`: grid value 1 is negative or not finite",
        ),
        (grid(""), "medium \"m\": expected values of `density`"),
        (
            grid("\"integer nz\" 0 \"float density\" [ 1 2 ]"),
            "expected `nz` from 1 to 65536, found 0",
        ),
        (
            grid("\"float density\" [ 1 2 ] \"point3 p1\" [ 0 0 0 ]"),
            "medium \"m\": the transform of a medium must be finite and have an inverse",
        ),
        (
            "MakeNamedMedium \"m\" ".into(),
            "medium \"m\": expected \"string type\"",
        ),
        (
            homogeneous("") + "\n" + &homogeneous(""),
            "medium \"m\": expected one description, found another",
        ),
        (
            "MediumInterface \"fog\" \"\"".into(),
            "expected a named medium, found \"fog\"",
        ),
    ];
    for (text, expected) in cases {
        let line = 1 + text.lines().count();
        let error = read("pbrt_bad_media", &format!("WorldBegin\n{text}\n"));
        let error = error.expect_err(&text);
        assert_eq!(error, format!("a.pbrt:{line}: {expected}"), "{text}");
    }
}

#[test]
fn a_preset_counts_before_coefficients_and_one_is_the_default() {
    let text = r#"
Camera "perspective"
WorldBegin
MakeNamedMedium "bare" "string type" "homogeneous"
MakeNamedMedium "both" "string type" "homogeneous" "string preset" "Skin1" "rgb sigma_a" [ 9 9 9 ]
MakeNamedMedium "odd" "string type" "homogeneous" "string preset" "Tar" "rgb sigma_a" [ 9 9 9 ]
"#;
    let scene = read("pbrt_presets", text).expect("a scene");
    let [bare, both, odd] = [0, 1, 2].map(|i| at(&scene.media[i].medium, Vec3::ZERO));
    assert_eq!(bare, [Vec3::ONE, Vec3::ONE, Vec3::ZERO], "as pbrt has it");
    assert_eq!(both[0], Vec3::new(0.032, 0.17, 0.48), "measured");
    assert_eq!(odd[0], Vec3::splat(9.0), "of the file");
    let warned = scene.warnings.iter().any(|w| w.to_string().contains("Tar"));
    assert!(warned, "{:?}", scene.warnings);
}
