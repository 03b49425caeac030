//! Pictures that are seen while they are made.

use std::fs;
use std::net::TcpListener;
use std::path::Path;
use std::thread::spawn;

use light_scene::read_image;

use crate::program::folder::{Folder, LIT, assert_refused, stdout};
use crate::program::tev_stand_in::StandIn;

#[test]
fn the_viewer_shows_the_picture_that_is_written() {
    let folder = Folder::new("tev");
    let (scene, out) = (folder.scene(LIT), folder.path("out.exr"));
    let viewer = StandIn::listen();
    let size = ["--width", "300", "--height", "260", "--spp", "3"];
    let args = ["render", &scene, "-o", &out, "--view", &viewer.flag];
    stdout(&[&args[..], &size].concat());
    let images = viewer.images.join().expect("packets that are understood");
    let (width, pixels) = &images[&out];
    let written = read_image(Path::new(&out)).expect("a picture").image;
    assert_eq!((*width, pixels.len()), (300, 300 * 260), "its size");
    assert_eq!(
        pixels,
        written.texels(),
        "all rows, in more than one packet"
    );
}

#[test]
fn no_viewer_is_an_error_and_one_that_leaves_is_not() {
    let folder = Folder::new("no-tev");
    let (scene, out) = (folder.scene(LIT), folder.path("out.exr"));
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let flag = format!("tev={}", listener.local_addr().expect("an address"));
    let args = [
        "render", &scene, "-o", &out, "--width", "8", "--view", &flag,
    ];
    let leaves = spawn(move || drop(listener.accept().expect("a connection")));
    stdout(&args);
    leaves.join().expect("it left");
    assert!(Path::new(&out).exists(), "a picture all the same");
    fs::remove_file(&out).expect("removed");
    assert_refused(&args, &["--view", "tev", "cannot be reached"]);
    assert!(!Path::new(&out).exists(), "nothing rendered");
}
