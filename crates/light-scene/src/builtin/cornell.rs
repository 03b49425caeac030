use std::path::Path;

use crate::glam::Vec3;
use crate::obj::parse_obj;
use crate::{Camera, Scene};

/// The Cornell box from its published measurements, in millimetres: two blocks in a white room with
/// a red wall on the left and a green one on the right, under one lamp that emits light downward
/// only.
///
/// Half a turn about the y axis brings its opening to +z.
///
/// # Source
/// `[Cornell]`: geometry, reflectance spectra and the lamp's spectrum.
pub(super) fn cornell_box() -> Scene {
    let obj = include_str!("../../assets/cornell_box.obj");
    let mtl = include_str!("../../assets/cornell_box.mtl");
    let library = |_: &Path| Ok(mtl.into());
    let mut scene = parse_obj(
        Path::new("cornell_box.obj"),
        obj,
        crate::Files::new(&library),
    )
    .expect("the Cornell box that ships is a valid file");
    // A film of 25 mm by 25 mm behind a lens of 35 mm.
    let fov = 2.0 * (12.5f32 / 35.0).atan();
    let eye = Vec3::new(-278.0, 273.0, 800.0);
    let camera = Camera::look_at(eye, eye - Vec3::Z, Vec3::Y, fov);
    let camera = camera.expect("the published camera is valid");
    scene.camera = Some(Camera {
        resolution: Some([512, 512]),
        crop: None,
        ..camera
    });
    scene
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mesh;

    fn mesh<'a>(scene: &'a Scene, name: &str) -> &'a Mesh {
        let mut meshes = scene.meshes.iter();
        meshes
            .find(|mesh| mesh.name == name)
            .expect("a mesh of this name")
    }

    #[test]
    fn is_the_published_box() {
        let scene = cornell_box();
        assert_eq!(scene.warnings, [], "all understood");
        assert_eq!(scene.triangle_count(), 2 * 19, "nineteen quads");
        assert_eq!(scene.emissive_triangle_count(), 2, "the lamp");
        let lamp = mesh(&scene, "lamp");
        assert_eq!(lamp.area(), 130.0 * 105.0, "130 mm by 105 mm");
        let ceiling = mesh(&scene, "ceiling").area() + lamp.area();
        assert!((ceiling / (556.0 * 559.2) - 1.0).abs() < 1e-6, "one hole");
    }

    #[test]
    fn fronts_face_the_room() {
        let scene = cornell_box();
        let middle = Vec3::new(-278.0, 274.0, -280.0);
        for name in [
            "floor",
            "ceiling",
            "lamp",
            "back_wall",
            "right_wall",
            "left_wall",
        ] {
            let mesh = mesh(&scene, name);
            for index in 0..mesh.indices.len() {
                let [a, b, c] = mesh.triangle(index);
                let front = (b - a).cross(c - a);
                assert!(front.dot(middle - a) > 0.0, "{name} faces the room");
            }
        }
        for name in ["short_block", "tall_block"] {
            let mesh = mesh(&scene, name);
            let middle = mesh.bounds().center();
            for index in 0..mesh.indices.len() {
                let [a, b, c] = mesh.triangle(index);
                let front = (b - a).cross(c - a);
                assert!(front.dot(a - middle) > 0.0, "{name} faces outward");
            }
        }
    }

    #[test]
    fn red_is_on_the_left_of_the_picture() {
        let scene = cornell_box();
        let camera = scene.camera.expect("a camera");
        let red = mesh(&scene, "left_wall").bounds().center();
        assert!((red - camera.position).dot(camera.right) < 0.0, "left");
    }

    #[test]
    fn the_default_camera_looks_into_the_opening() {
        let scene = Scene {
            camera: None,
            ..cornell_box()
        };
        let camera = scene.camera_or_default();
        let back = mesh(&scene, "back_wall");
        let [a, b, c] = back.triangle(0);
        let front = (b - a).cross(c - a);
        assert!(front.dot(camera.position - a) > 0.0, "sees the inner side");
    }
}
