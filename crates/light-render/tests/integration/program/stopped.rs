//! Programs that are stopped by Ctrl-C: what they keep, and what they say.

use core::time::Duration;
use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Instant;

use light_render::PartialPicture;
use light_scene::read_image;

use crate::program::folder::{Folder, LIT, stdout};
use crate::program::tev_stand_in::StandIn;
use crate::program::watched::PATIENCE;

/// Starts the program.
pub(crate) fn start(args: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_lights"))
        .args(args)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs")
}

/// Asks a program to stop; its status, and what it said.
pub(crate) fn interrupt(mut child: Child) -> (Option<i32>, String) {
    let kill = format!("kill -s INT {}", child.id());
    let sent = Command::new("sh").args(["-c", &kill]).status();
    assert!(sent.expect("sent").success(), "the signal is sent");
    let mut error = String::new();
    let mut pipe = child.stderr.take().expect("a pipe");
    pipe.read_to_string(&mut error).expect("text");
    (child.wait().expect("an end").code(), error)
}

pub(crate) fn wait_until(what: &str, is_so: impl Fn() -> bool) {
    let begin = Instant::now();
    while !is_so() {
        assert!(begin.elapsed() < PATIENCE, "waited for {what}");
        sleep(Duration::from_millis(20));
    }
}

/// Waits until the program answers Ctrl-C itself.
#[cfg(target_os = "linux")]
fn wait_until_it_listens(child: &Child) {
    let status = format!("/proc/{}/status", child.id());
    let catches = || {
        let status = fs::read_to_string(&status).ok()?;
        let caught = status.lines().find_map(|l| l.strip_prefix("SigCgt:"))?;
        let caught = u64::from_str_radix(caught.trim(), 16).ok()?;
        Some(caught & 1 << 1 != 0)
    };
    wait_until("a handler", || catches() == Some(true));
}

#[cfg(target_os = "linux")]
#[test]
fn what_cannot_go_on_ends_with_a_line() {
    let folder = Folder::new("stopped-at-once");
    let (scene, out, page) = (
        folder.scene(LIT),
        folder.path("out.exr"),
        folder.path("a.html"),
    );
    let set = folder.path("set");
    let before = folder.names();
    let samples = ["render", &scene, "-o", &out, "--samples", "0..4000000"];
    let layers = [
        "render", &scene, "-o", &out, "--aov", "groups", "--spp", "4000000",
    ];
    let report = ["report", &scene, "-o", &page, "--time", "500"];
    for args in [&samples[..], &layers, &report] {
        let child = start(args);
        wait_until_it_listens(&child);
        let (status, error) = interrupt(child);
        assert_eq!(status, Some(130), "{args:?}: {error}");
        let last = error.lines().last();
        let words = "lights: interrupted: nothing was written";
        assert_eq!(last, Some(words), "{args:?}: {error}");
        assert_eq!(folder.names(), before, "{args:?}");
    }
    let of_set = ["bench", "--generate", "uniform", "--n", "1000"];
    let bench = ["--samplers", "exhaustive", "--write", &set];
    let long = ["--var-points", "1000000"];
    let child = start(&[&of_set[..], &bench, &long].concat());
    let points = format!("{set}.points");
    wait_until("a set", || Path::new(&points).exists());
    let (status, error) = interrupt(child);
    assert_eq!(status, Some(130), "{error}");
    let words = format!("interrupted; written before: {set}.lights, {points}");
    assert!(error.contains(&words), "{error}");
}

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
