//! Pictures that are seen while they are made, and renderings that are stopped.

use core::time::Duration;
use std::collections::HashMap;
use std::fs;
use std::io::Read;
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread::{JoinHandle, sleep, spawn};
use std::time::Instant;

use light_render::PartialPicture;
use light_scene::glam::Vec3;
use light_scene::read_image;

use crate::program::folder::{Folder, LIT, assert_refused, stdout};

/// Longer than anything here takes on a busy machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// An image of the stand-in: its width, and its pixels.
type Shown = HashMap<String, (u32, Vec<Vec3>)>;

/// A stand-in for tev, written from the description of its protocol: packets that begin with their
/// length and the kind of request.
struct StandIn {
    flag: String,
    first_update: Receiver<()>,
    images: JoinHandle<Shown>,
}

impl StandIn {
    fn listen() -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let flag = format!("tev={}", listener.local_addr().expect("an address"));
        let (sender, first_update) = channel();
        let images = spawn(move || {
            let (stream, _) = listener.accept().expect("a connection");
            serve(stream, || {
                // The test may have ended.
                let _ = sender.send(());
            })
        });
        Self {
            flag,
            first_update,
            images,
        }
    }
}

/// The images when the connection ends.
fn serve(mut stream: TcpStream, updated: impl Fn()) -> Shown {
    let mut images = Shown::new();
    let mut length = [0; 4];
    while stream.read_exact(&mut length).is_ok() {
        let mut packet = vec![0; u32::from_le_bytes(length) as usize - 4];
        stream.read_exact(&mut packet).expect("a whole packet");
        let mut fields = Fields(&packet);
        let (kind, _shows, name) = (fields.byte(), fields.byte(), fields.text());
        match kind {
            4 => {
                let (width, height) = (fields.integer(), fields.integer());
                assert_eq!(fields.texts(), ["R", "G", "B"], "channels");
                let pixels = vec![Vec3::ZERO; width as usize * height as usize];
                images.insert(name, (width, pixels));
            }
            6 => {
                assert_eq!(fields.texts(), ["R", "G", "B"], "channels");
                let [x, y, w, h] = [0; 4].map(|_| fields.integer());
                let offsets = [0; 3].map(|_| fields.long());
                let strides = [0; 3].map(|_| fields.long());
                let numbers: Vec<f32> = fields.rest();
                let (width, pixels) = images.get_mut(&name).expect("a created image");
                for (i, (column, row)) in (0..h)
                    .flat_map(|row| (0..w).map(move |c| (c, row)))
                    .enumerate()
                {
                    let at = |c: usize| numbers[offsets[c] + strides[c] * i];
                    let pixel = (y + row) * *width + x + column;
                    pixels[pixel as usize] = Vec3::new(at(0), at(1), at(2));
                }
                updated();
            }
            other => panic!("an unknown kind of packet: {other}"),
        }
    }
    images
}

/// What is left of a packet.
struct Fields<'a>(&'a [u8]);

impl Fields<'_> {
    fn byte(&mut self) -> u8 {
        let byte = self.0[0];
        self.0 = &self.0[1..];
        byte
    }

    fn text(&mut self) -> String {
        let end = self.0.iter().position(|&byte| byte == 0).expect("an end");
        let text = String::from_utf8(self.0[..end].to_vec()).expect("text");
        self.0 = &self.0[end + 1..];
        text
    }

    fn integer(&mut self) -> u32 {
        let (bytes, rest) = self.0.split_first_chunk().expect("four bytes");
        self.0 = rest;
        u32::from_le_bytes(*bytes)
    }

    fn long(&mut self) -> usize {
        let (bytes, rest) = self.0.split_first_chunk().expect("eight bytes");
        self.0 = rest;
        usize::try_from(u64::from_le_bytes(*bytes)).expect("a place in the packet")
    }

    fn texts(&mut self) -> Vec<String> {
        (0..self.integer()).map(|_| self.text()).collect()
    }

    fn rest(&mut self) -> Vec<f32> {
        let numbers = self.0.chunks_exact(4);
        numbers
            .map(|bytes| f32::from_le_bytes(bytes.try_into().expect("four bytes")))
            .collect()
    }
}

fn start(args: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_lights"))
        .args(args)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs")
}

/// Asks a program to stop; its status, and what it said.
fn interrupt(mut child: Child) -> (Option<i32>, String) {
    let kill = format!("kill -s INT {}", child.id());
    let sent = Command::new("sh").args(["-c", &kill]).status();
    assert!(sent.expect("sent").success(), "the signal is sent");
    let mut error = String::new();
    let mut pipe = child.stderr.take().expect("a pipe");
    pipe.read_to_string(&mut error).expect("text");
    (child.wait().expect("an end").code(), error)
}

fn wait_until(what: &str, is_so: impl Fn() -> bool) {
    let begin = Instant::now();
    while !is_so() {
        assert!(begin.elapsed() < PATIENCE, "waited for {what}");
        sleep(Duration::from_millis(20));
    }
}

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

#[cfg(unix)]
#[test]
fn a_stopped_rendering_is_kept_and_goes_on() {
    let folder = Folder::new("stopped");
    let (scene, out) = (folder.scene(LIT), folder.path("out.exr"));
    let viewer = StandIn::listen();
    let common = ["render", &scene, "-o", &out, "--width", "24"];
    let live = ["--spp", "4000000", "--view", &viewer.flag];
    let child = start(&[&common[..], &live].concat());
    viewer
        .first_update
        .recv_timeout(PATIENCE)
        .expect("a first pass");
    let (status, error) = interrupt(child);
    assert_eq!(status, Some(130), "{error}");
    let kept = folder.path("out.checkpoint.exr");
    for words in [
        "interrupted after",
        "of 4000000",
        &out,
        "--checkpoint",
        &kept,
    ] {
        assert!(error.contains(words), "{words:?} in {error}");
    }
    let part = PartialPicture::read(Path::new(&kept)).expect("the samples");
    let shown = read_image(Path::new(&out)).expect("a picture").image;
    assert_eq!(part.film.develop(), shown.texels(), "what there was");
    let more = (part.samples.end + 3).to_string();
    let go_on = ["--spp", &more, "--checkpoint", &kept];
    stdout(&[&common[..], &go_on].concat());
    let gone_on = fs::read(&out).expect("a picture");
    stdout(&[&common[..], &["--spp", &more]].concat());
    assert_eq!(
        gone_on,
        fs::read(&out).expect("a picture"),
        "as if never stopped"
    );
}

/// The samples of an interrupted rendering replace no file but those that it made itself.
#[cfg(unix)]
#[test]
fn a_stopped_rendering_writes_over_nothing() {
    let folder = Folder::new("stopped-kept");
    let (scene, out) = (folder.scene(LIT), folder.path("out.exr"));
    let names = ["out.exr", "out.checkpoint.exr", "out.checkpoint-2.exr"];
    let old = names.map(|name| folder.file(name, name));
    let [third, png] = ["out.checkpoint-3.exr", "out.png"].map(|name| folder.path(name));
    let interrupted = |more: &[&str]| {
        let viewer = StandIn::listen();
        let args = ["render", &scene, "-o", &out, "--width", "8"];
        let live = ["--spp", "4000000", "--view", &viewer.flag];
        let child = start(&[&args, &live[..], more].concat());
        let first = viewer.first_update.recv_timeout(PATIENCE);
        first.expect("a first pass");
        let (status, error) = interrupt(child);
        assert_eq!(status, Some(130), "{error}");
        for (name, path) in names.iter().zip(&old) {
            let content = fs::read_to_string(path).expect("as it was");
            assert_eq!(&content, name, "{error}");
        }
        error
    };
    let error = interrupted(&[]);
    let as_it_was = "out.exr stays as it was";
    for words in [as_it_was, &format!("--checkpoint {third} ")] {
        assert!(error.contains(words), "{words:?} in {error}");
    }
    let samples = |path: &str| {
        let part = PartialPicture::read(Path::new(path)).expect("the samples");
        part.samples.end
    };
    let before = samples(&third);
    let error = interrupted(&["--checkpoint", &third, "-o", &png]);
    for words in [as_it_was, "out.png holds", "goes on from"] {
        assert!(error.contains(words), "{words:?} in {error}");
    }
    assert!(samples(&third) > before, "never fewer samples");
    assert!(Path::new(&png).exists(), "a picture that was not there");
}

#[cfg(unix)]
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
