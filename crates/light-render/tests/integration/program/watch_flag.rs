//! Pictures that are made again when their scene changes.

use core::time::Duration;
use std::path::Path;
use std::thread::sleep;

use light_scene::glam::Vec3;
use light_scene::read_image;

use crate::program::folder::{Folder, LIT};
use crate::program::stopped::{interrupt, start, wait_until};

#[test]
fn a_scene_that_changes_is_rendered_again() {
    let folder = Folder::new("watch");
    let (scene, out) = (folder.scene(LIT), folder.path("out.exr"));
    let child = start(&[
        "render", &scene, "-o", &out, "--width", "8", "--spp", "2", "--watch",
    ]);
    let mean = || {
        let image = read_image(Path::new(&out)).ok()?.image;
        let sum: Vec3 = image.texels().iter().sum();
        Some(sum / image.texels().len() as f32)
    };
    wait_until("the first picture", || mean().is_some());
    let white = mean().expect("a picture");
    // The material's file, which the scene's file names, is watched as well.
    folder.file("scene.mtl", &LIT.replace("Ke 5 4 3", "Ke 0 40 0"));
    wait_until("a green picture", || {
        mean().is_some_and(|mean| mean.x == 0.0 && mean.y > white.y)
    });
    // A scene that cannot be read is waited out.
    folder.file("scene.obj", "f 1 2 3\n");
    sleep(Duration::from_millis(500));
    folder.scene(LIT);
    wait_until("the first picture again", || mean() == Some(white));
    let (status, error) = interrupt(child);
    assert_eq!(status, Some(130), "{error}");
    assert!(error.contains("scene.mtl has changed"), "{error}");
}
