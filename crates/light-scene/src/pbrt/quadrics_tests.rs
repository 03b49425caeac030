//! Spheres, disks and cylinders of pbrt files, whole and in part.

use core::f32::consts::PI;
use std::path::Path;

use super::parse_pbrt;
use crate::glam::Vec3;
use crate::{Color, Files, Mesh, Quadric, QuadricFront, QuadricKind, Scene};

fn scene(text: &str) -> Scene {
    let text = format!("WorldBegin {text}");
    parse_pbrt(Path::new("a"), &text, Files::NONE).expect("a scene")
}

/// The triangles of one that emits.
fn mesh(shape: &str) -> Mesh {
    let scene = scene(&format!("AreaLightSource \"diffuse\" Shape {shape}"));
    assert_eq!(
        scene.warnings.len(),
        1,
        "made of triangles: {:?}",
        scene.warnings
    );
    scene.meshes[0].clone()
}

/// The shape that is not made of triangles.
fn quadric(text: &str) -> Quadric {
    let scene = scene(text);
    assert!(
        scene.warnings.is_empty() && scene.meshes.is_empty(),
        "{text}: {:?}",
        scene.warnings
    );
    scene.quadrics[0].clone()
}

/// Whether the area is `expected` but for what triangles cut off: of a circle of 64 corners a part
/// of 0.0016, of a sphere a quarter more.
fn has_area(shape: &str, expected: f32) {
    let area = mesh(shape).area();
    assert!(
        (area / expected - 1.0).abs() < 2.1e-3,
        "{shape}: {area}, not {expected}"
    );
    let area = quadric(&format!("Shape {shape}")).area();
    assert!(
        (area / expected - 1.0).abs() < 1e-5,
        "{shape} as such: {area}, not {expected}"
    );
}

#[test]
fn parts_of_quadrics_have_their_areas() {
    has_area(
        "\"sphere\" \"float radius\" 2 \"float phimax\" 90",
        4.0 * PI,
    );
    // A zone has the area of the cylinder around it.
    has_area(
        "\"sphere\" \"float radius\" 2 \"float zmin\" -1 \"float zmax\" 1.5",
        10.0 * PI,
    );
    has_area(
        "\"disk\" \"float radius\" 2 \"float innerradius\" 1 \"float phimax\" 180",
        1.5 * PI,
    );
    has_area(
        "\"cylinder\" \"float zmin\" 0 \"float phimax\" 90",
        0.5 * PI,
    );
    let zone = mesh("\"sphere\" \"float zmin\" .5").bounds();
    assert!(
        (zone.min.z - 0.5).abs() < 1e-6 && zone.max.z == 1.0,
        "{zone:?}"
    );
}

#[test]
fn whole_disks_and_cylinders_are_no_triangles() {
    let disk = quadric(
        "Translate 1 0 0 Scale 2 2 5 Shape \"disk\" \"float radius\" 2 \"float height\" .5 \
         \"float innerradius\" 1",
    );
    assert_eq!(disk.kind, QuadricKind::Disk { inner_radius: 0.5 });
    assert_eq!(disk.front, QuadricFront::Outside);
    assert!((disk.area() / (12.0 * PI) - 1.0).abs() < 1e-6, "{disk:?}");
    assert_eq!(disk.center(), Vec3::new(1.0, 0.0, 2.5), "its height");
    let tube = quadric(
        "ReverseOrientation Scale 1 1 3 Shape \"cylinder\" \"float radius\" .5 \
         \"float zmin\" 2 \"float zmax\" 0",
    );
    assert_eq!(tube.front, QuadricFront::Inside, "reversed");
    assert!((tube.area() / (6.0 * PI) - 1.0).abs() < 1e-6, "{tube:?}");
    let bounds = tube.bounds();
    assert!(
        (bounds.min - Vec3::new(-0.5, -0.5, 0.0)).length() < 1e-5
            && (bounds.max - Vec3::new(0.5, 0.5, 6.0)).length() < 1e-5,
        "{bounds:?}"
    );
    let mirrored = quadric("Scale -1 1 1 Shape \"disk\"");
    assert_eq!(mirrored.front, QuadricFront::Inside, "as pbrt has it");
}

#[test]
fn a_mirrored_lamp_shines_where_it_does_unmirrored() {
    let lamp = |text: &str| scene(&format!("AreaLightSource \"diffuse\" Scale -1 1 1 {text}"));
    for shape in ["\"sphere\"", "\"disk\"", "\"cylinder\""] {
        let front = |text: &str| lamp(&format!("{text} Shape {shape}")).quadrics[0].front;
        assert_eq!(front(""), QuadricFront::Outside, "{shape}");
        assert_eq!(
            front("ReverseOrientation"),
            QuadricFront::Inside,
            "{shape}, reversed"
        );
        let part = &lamp(&format!("Shape {shape} \"float phimax\" 90")).meshes[0];
        let [a, b, c] = part.triangle(0);
        let outward = match shape {
            "\"disk\"" => Vec3::Z,
            _ => (a + b + c).with_z(0.0),
        };
        let normal = (b - a).cross(c - a);
        assert!(normal.dot(outward) > 0.0, "{shape} in part: {normal}");
    }
}

#[test]
fn stretched_quadrics_are_objects_in_one_place() {
    let ellipse = scene(
        "ObjectBegin \"a\" Shape \"sphere\" ObjectEnd ObjectInstance \"a\" ReverseOrientation \
         Scale 1 2 1 Shape \"disk\" \"float radius\" 3 \"float height\" 1",
    );
    assert!(ellipse.warnings.is_empty(), "{:?}", ellipse.warnings);
    assert!(ellipse.meshes.is_empty() && ellipse.quadrics.is_empty());
    let place = ellipse.instances[1];
    let quadric = &ellipse.prototype(place.prototype).quadrics[0];
    assert_eq!(quadric.front, QuadricFront::Inside, "reversed");
    let at = |p| place.transform.transform_point3(p);
    assert_eq!(at(Vec3::Y), Vec3::new(0.0, 6.0, 1.0), "its rim");
    // An object in an object is not read.
    let in_object = scene("Scale 1 2 1 ObjectBegin \"a\" Shape \"sphere\" ObjectEnd");
    assert_eq!(in_object.prototypes[0].meshes.len(), 1);
    assert_eq!(in_object.warnings.len(), 1, "{:?}", in_object.warnings);
    // As are those that emit, since no light has that shape.
    let lamp = scene("AreaLightSource \"diffuse\" Scale 1 2 1 Shape \"disk\"");
    assert_eq!((lamp.meshes.len(), lamp.warnings.len()), (1, 1));
    // And those whose squared scale is beyond what floats hold.
    let tiny = scene("Scale 1e-20 2e-20 1e-20 Shape \"sphere\"");
    assert_eq!(tiny.instances.len(), 0, "{:?}", tiny.meshes.len());
}

#[test]
fn shapes_with_uneven_light_or_light_from_behind_are_triangles() {
    let count = |light: &str, shape: &str| {
        let text = format!("AreaLightSource \"diffuse\" {light} Shape {shape}");
        scene(&text).quadrics.len()
    };
    let two_sided = "\"bool twosided\" true";
    assert_eq!(count("", "\"cylinder\" \"float alpha\" .5"), 1, "outside");
    assert_eq!(
        count(two_sided, "\"cylinder\""),
        1,
        "nothing shines through"
    );
    assert_eq!(
        count(two_sided, "\"cylinder\" \"float alpha\" .5"),
        0,
        "the far side shines through the near one"
    );
    assert_eq!(
        count(two_sided, "\"disk\" \"float alpha\" .5"),
        1,
        "a disk has no far side"
    );
    let alpha = |alpha: &str| count(two_sided, &format!("\"sphere\" \"float alpha\" {alpha}"));
    assert_eq!(alpha(".5"), 0, "the far side shines through");
    assert_eq!(
        alpha("0"),
        1,
        "pbrt samples the near side of a lamp that no ray meets"
    );
    assert_eq!(
        count(two_sided, "\"cylinder\" \"float alpha\" 0"),
        0,
        "and all of a cylinder"
    );
}

#[test]
fn quadrics_shine_with_the_power_that_is_asked_for_or_that_of_their_area() {
    let shapes = [
        ("\"disk\" \"float radius\" 2", 4.0 * PI),
        (
            "\"disk\" \"float radius\" 2 \"float innerradius\" 1",
            3.0 * PI,
        ),
        ("\"cylinder\" \"float zmin\" 0", 2.0 * PI),
        (
            "\"disk\" \"float radius\" 2 \"float innerradius\" 1 \"float phimax\" 180",
            1.5 * PI,
        ),
        (
            "\"cylinder\" \"float zmin\" 0 \"float phimax\" 90",
            0.5 * PI,
        ),
    ];
    for (shape, area) in shapes {
        for (amount, expected) in [
            ("\"float power\" 10", 10.0),
            ("\"rgb L\" [ 3 3 3 ]", 3.0 * PI * area),
        ] {
            let scene = scene(&format!(
                "AreaLightSource \"diffuse\" {amount} Shape {shape}"
            ));
            let meshes = scene.meshes.iter().map(|mesh| (mesh.area(), mesh.material));
            let quadrics = scene.quadrics.iter().map(|q| (q.area(), q.material));
            let (area, material) = meshes.chain(quadrics).next().expect("a shape");
            let emission = scene.material(material).emission.as_ref();
            let Color::Constant(radiance) = emission.expect("a lamp").radiance else {
                unreachable!("no image")
            };
            let power = PI * area * radiance.y;
            assert!(
                (power / expected - 1.0).abs() < 5e-3,
                "{shape}, {amount}: {power} W, not {expected}"
            );
        }
    }
}
