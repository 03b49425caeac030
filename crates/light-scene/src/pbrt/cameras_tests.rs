use super::tests::read;
use crate::glam::Vec3;
use crate::{Camera, Projection, Scene, ScreenWindow};

fn camera(text: &str) -> Camera {
    scene(text).camera.expect("a camera")
}

fn scene(text: &str) -> Scene {
    let scene = read("pbrt_cameras", &format!("{text} WorldBegin")).expect("a scene");
    assert_eq!(scene.warnings, [], "all read: {text}");
    scene
}

#[test]
fn windows_of_the_screen_are_kept() {
    assert_eq!(camera("Camera \"perspective\"").screen, None, "the middle");
    let window = "\"float screenwindow\" [-1 2 -0.5 .25]";
    let expected = ScreenWindow {
        x: [-1.0, 2.0],
        y: [-0.5, 0.25],
    };
    for kind in ["perspective", "orthographic"] {
        let found = camera(&format!("Camera \"{kind}\" {window}"));
        assert_eq!(found.screen, Some(expected), "{kind}");
    }
    for (aspect, x, y) in [("2", 2.0, 1.0), (".25", 1.0, 4.0)] {
        let found = camera(&format!(
            "Camera \"perspective\" \"float frameaspectratio\" {aspect}"
        ));
        let expected = ScreenWindow {
            x: [-x, x],
            y: [-y, y],
        };
        assert_eq!(
            found.screen,
            Some(expected),
            "the shorter side shows -1 to 1"
        );
    }
}

#[test]
fn orthographic_cameras_scale_with_their_transform() {
    let found = camera("Scale .5 .5 .5 LookAt 1 2 -3  1 2 0  0 1 0 Camera \"orthographic\"");
    assert_eq!(
        found.projection,
        Projection::Orthographic { scale: 2.0 },
        "a length of 2"
    );
    assert!(
        found.position.abs_diff_eq(Vec3::new(1.0, 2.0, -3.0), 1e-5),
        "its place"
    );
    assert_eq!(found.forward, Vec3::Z, "its axis");
}

/// Of this camera, that of a public scene, the inverse has a last row that is not quite 0 0 0 1.
#[test]
fn a_view_from_far_away_is_no_projection() {
    let found = camera(
        "Scale -1 1 1 LookAt 328 40.282 245  328 10 0  -0.00212272 0.998201 -0.0599264 \
         Camera \"perspective\"",
    );
    let eye = Vec3::new(328.0, 40.282, 245.0);
    assert!(found.position.abs_diff_eq(eye, 1e-3), "{}", found.position);
    let forward = (Vec3::new(328.0, 10.0, 0.0) - eye).normalize();
    assert!(
        found.forward.abs_diff_eq(forward, 1e-5),
        "{}",
        found.forward
    );
}

#[test]
fn spherical_cameras_have_one_of_two_maps() {
    for (mapping, expected) in [
        ("", Projection::EqualArea),
        ("\"string mapping\" \"equalarea\"", Projection::EqualArea),
        (
            "\"string mapping\" \"equirectangular\"",
            Projection::LatLong,
        ),
    ] {
        let found = camera(&format!("Camera \"spherical\" {mapping}"));
        assert_eq!(found.projection, expected, "{mapping}");
    }
}

#[test]
fn other_cameras_are_named() {
    let scene = read("pbrt_realistic", "Camera \"realistic\" WorldBegin").expect("a scene");
    let warning = scene.warnings[0].message.as_str();
    assert_eq!(
        warning, "Camera \"realistic\" was taken as perspective",
        "named"
    );
}

/// pbrt counts the points between the ends of a path.
#[test]
fn integrators_say_how_long_paths_are() {
    let depth = |text: &str| scene(text).max_depth;
    assert_eq!(depth(""), None, "nothing said");
    assert_eq!(depth("Integrator \"path\""), None, "nothing said");
    let named = "Integrator \"volpath\" \"integer maxdepth\"";
    assert_eq!(depth(&format!("{named} 0")), Some(1), "emitters alone");
    let lights = "\"string lightsampler\" \"bvh\"";
    assert_eq!(
        depth(&format!("{named} [ 100 ] {lights}")),
        Some(101),
        "long paths"
    );
    let other = "Integrator \"mlt\" \"integer maxdepth\" 4 WorldBegin";
    let other = read("pbrt_mlt", other).expect("a scene");
    assert_eq!(other.max_depth, Some(5), "of every integrator");
    let warning = other.warnings[0].message.as_str();
    let expected = "Integrator \"mlt\" was taken as the program's own path tracer";
    assert_eq!(warning, expected, "named");
}

#[test]
fn a_film_without_a_camera_has_its_size() {
    let film = "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 48";
    let ball = "WorldBegin Translate 5 0 0 Shape \"sphere\"";
    let read = |text: &str| read("pbrt_film", text).expect("a scene");
    let bare = read(ball);
    assert_eq!(bare.camera, None, "no film");
    let expected = Camera {
        resolution: Some([64, 48]),
        ..bare.camera_or_default()
    };
    let filmed = read(&format!("{film} {ball}"));
    assert_eq!(
        filmed.camera,
        Some(expected),
        "the view that it has without"
    );
}
