//! What the program writes: whole files or none.

use std::fs;
use std::path::Path;

use crate::program::folder::{Folder, LAMP, LIT, SMALL, assert_refused, stdout};

#[test]
fn folders_and_empty_files_are_no_files_to_read_or_write() {
    let folder = Folder::new("no-files");
    let scene = folder.scene(LIT);
    let place = folder.0.to_string_lossy().into_owned();
    let names = [
        "a.exr", "b.png", "c.obj", "d.ies", "e.hdr", "f.pbrt", "g.glb", "h.lights",
    ];
    for name in names {
        fs::create_dir(folder.0.join(format!("folder-{name}"))).expect("a folder");
        folder.file(&format!("empty-{name}"), "");
    }
    let out = folder.path("out.exr");
    for kind in ["folder", "empty"] {
        let path = |name: &str| folder.path(&format!("{kind}-{name}"));
        for name in ["c.obj", "f.pbrt", "g.glb"] {
            if kind == "folder" || name == "g.glb" {
                assert_refused(&["info", &path(name)], &[name]);
            }
            assert_refused(&["render", &path(name), "-o", &out], &[name]);
        }
        for name in ["a.exr", "b.png", "e.hdr"] {
            assert_refused(&["compare", &path(name), &out], &[name]);
            assert_refused(&["env", "convert", &path(name), &out], &[name]);
            assert_refused(&["env", "median-cut", &path(name), "-n", "1"], &[name]);
        }
        assert_refused(&["merge", &path("a.exr"), "-o", &out], &["a.exr"]);
        assert_refused(&["ies", &path("d.ies")], &["d.ies"]);
        let lights = path("h.lights");
        let bench = ["bench", "--lights", &lights, "--points", &lights];
        assert_refused(&bench, &["h.lights"]);
    }
    for out in [&place, &folder.path("folder-a.exr"), "/", "..", ""] {
        assert_refused(&["render", &scene, "-o", out, "--spp", "1"], &[]);
    }
    let render = ["render", &scene, "-o", &folder.path("folder-b.png")];
    assert_refused(&render, &["folder-b.png", "it is a folder"]);
    assert!(!Path::new(&out).exists(), "nothing is written");
}

#[cfg(unix)]
mod full {
    use std::fs::File;
    use std::os::unix::fs::{FileTypeExt, symlink};
    use std::process::{Command, Stdio};

    use super::*;
    use crate::program::watched::watch_after;

    /// Files may have one block, and the signal that says so is off, as a full disk sends none.
    const FULL: &str = "trap '' XFSZ && ulimit -f 1";

    #[test]
    fn a_full_disk_leaves_nothing_behind() {
        let folder = Folder::new("full");
        let scene = folder.scene(LIT);
        let before = folder.names();
        let full = |arguments: &[&str], name: &str| {
            let ending = watch_after(&folder.0, FULL, arguments);
            ending.assert_refused(&[name, "cannot be written"]);
            assert_eq!(folder.names(), before, "nothing is left of {name}");
        };
        let set = [
            "bench",
            "--generate",
            "uniform",
            "--n",
            "1000",
            "--samplers",
            "uniform",
        ];
        full(&[&set[..], &["--write", "set"]].concat(), "set.lights");
        let size = ["--width", "64", "--height", "64", "--quiet"];
        let render = |more: &[&'static str]| [&["render", &scene], &size[..], more].concat();
        for name in ["a.exr", "a.png"] {
            full(&render(&["--spp", "1", "-o", name]), name);
        }
        full(&render(&["--samples", "0..1", "-o", "a.exr"]), "a.exr");
        let checkpoint = ["--spp", "1", "-o", "a.png", "--checkpoint", "kept.exr"];
        full(&render(&checkpoint), "kept.exr");
    }

    #[test]
    fn what_has_no_end_is_not_read_for_ever() {
        let folder = Folder::new("endless");
        let link = folder.path("endless.obj");
        symlink("/dev/zero", &link).expect("a link");
        let words = ["cannot be read", "256 MiB"];
        assert_refused(&["ies", "/dev/zero"], &words);
        assert_refused(&["info", &link], &words);
        let bench = ["bench", "--lights", "/dev/zero", "--points", "/dev/zero"];
        assert_refused(&bench, &["/dev/zero", "256 MiB"]);
    }

    #[test]
    fn an_interrupted_program_leaves_no_half_file() {
        let folder = Folder::new("interrupted");
        let scene = folder.scene(LIT);
        let (out, kept) = (folder.path("out.exr"), folder.path("kept.exr"));
        for signal in ["INT", "TERM", "INT", "HUP", "INT"] {
            // Most of the time it writes its checkpoint.
            let arguments = [
                "render", &scene, "-o", &out, "--spp", "4000000", "--width", "64",
            ];
            let mut program = Command::new(env!("CARGO_BIN_EXE_lights"));
            let program = program.args(arguments).args(["--checkpoint", &kept]);
            let program = program.args(["--checkpoint-every", "1e-3"]);
            let mut child = program.spawn().expect("it runs");
            let before = fs::metadata(&kept).and_then(|file| file.modified()).ok();
            let start = std::time::Instant::now();
            let is_new = || {
                let now = fs::metadata(&kept).and_then(|file| file.modified()).ok();
                now.is_some() && now != before
            };
            while !is_new() && start.elapsed().as_secs() < 60 {
                std::thread::sleep(core::time::Duration::from_millis(3));
            }
            let kill = format!("kill -s {signal} {}", child.id());
            let killed = Command::new("sh").args(["-c", &kill]).status();
            assert!(killed.expect("sent").success(), "{signal} is sent");
            let status = child.wait().expect("an end");
            assert_eq!(status.code(), Some(130), "{signal}: {status}");
            let names = ["kept.exr", "out.exr", "scene.mtl", "scene.obj"];
            assert_eq!(folder.names(), names, "nothing half written");
            let picture = light_scene::read_image(Path::new(&out));
            assert!(picture.is_ok(), "what there is is a picture");
            let part = light_render::PartialPicture::read(Path::new(&kept));
            assert!(part.is_ok(), "the checkpoint is whole");
        }
    }

    #[test]
    fn devices_are_written_to_and_stay() {
        let folder = Folder::new("devices");
        let ies = folder.file("lamp.ies", LAMP);
        stdout(&["ies", &ies, "-o", "/dev/null"]);
        assert_refused(
            &["ies", &ies, "-o", "/dev/full"],
            &["/dev/full", "cannot be written"],
        );
        for device in ["/dev/null", "/dev/full"] {
            let kind = fs::metadata(device).expect("a device").file_type();
            assert!(kind.is_char_device(), "{device} is still a device");
        }
        // A link leads to what is replaced.
        let (file, link) = (folder.file("plot.svg", "old"), folder.path("link.svg"));
        symlink(&file, &link).expect("a link");
        stdout(&["ies", &ies, "-o", &link]);
        let plot = fs::read_to_string(&file).expect("a plot");
        assert!(plot.starts_with("<svg"), "through the link");
        assert!(
            fs::symlink_metadata(&link).expect("a link").is_symlink(),
            "still"
        );
        // As well to one that is not there yet, if its folder is.
        let [early, nowhere] = ["early.svg", "nowhere.exr"].map(|name| folder.path(name));
        symlink("new.svg", &early).expect("a link");
        stdout(&["ies", &ies, "-o", &early]);
        let new = fs::read_to_string(folder.path("new.svg")).expect("a plot");
        assert!(new.starts_with("<svg"), "through the link");
        symlink("no-folder/new.exr", &nowhere).expect("a link");
        // Before the scene is read: its file is missing too.
        let render = ["render", "missing.obj", "-o", &nowhere];
        assert_refused(&render, &["nowhere.exr", "cannot be written"]);
    }

    #[test]
    fn a_checkpoint_behind_a_link_is_no_output() {
        let folder = Folder::new("linked");
        let scene = folder.scene(LIT);
        let (kept, link) = (folder.path("kept.exr"), folder.path("link.exr"));
        let render =
            |out: &str| ["render", &scene, "-o", out, "--checkpoint", &kept].map(String::from);
        stdout(
            &[
                &render(&folder.path("a.exr")).each_ref().map(String::as_str),
                &SMALL[..],
            ]
            .concat(),
        );
        symlink(&kept, &link).expect("a link");
        let linked = render(&link);
        let words = ["kept.exr", "--checkpoint"];
        assert_refused(&linked.each_ref().map(String::as_str), &words);
    }

    #[test]
    fn results_that_nobody_takes_are_no_panic() {
        let folder = Folder::new("nobody");
        let scene = folder.scene(LIT);
        let picture = folder.path("a.exr");
        stdout(&[&["render", &scene, "-o", &picture], &SMALL[..]].concat());
        let commands: [&[&str]; 4] = [
            &["info", &scene],
            &["compare", &picture, &picture],
            &["--help"],
            &["render", "--help"],
        ];
        for command in commands {
            let run = |stdout: Stdio| {
                let mut program = Command::new(env!("CARGO_BIN_EXE_lights"));
                let program = program.args(command).stdout(stdout).stderr(Stdio::piped());
                let output = program.output().expect("it runs");
                let error = String::from_utf8_lossy(&output.stderr).into_owned();
                (output.status.code(), error)
            };
            let full = File::options()
                .write(true)
                .open("/dev/full")
                .expect("a device");
            let (status, error) = run(full.into());
            assert_eq!(status, Some(2), "{command:?}: {error}");
            assert!(
                error.starts_with("lights: standard output: cannot"),
                "{error}"
            );
            let (reader, writer) = std::io::pipe().expect("a pipe");
            drop(reader);
            let ending = run(writer.into());
            assert_eq!(ending, (Some(0), String::new()), "{command:?}: closed");
        }
        // The exit status reports a failed check, even if nobody reads the output.
        let other = folder.path("b.exr");
        stdout(&[&["render", &scene, "-o", &other, "--seed", "1"], &SMALL[..]].concat());
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let mut program = Command::new(env!("CARGO_BIN_EXE_lights"));
        let compare = program.args(["compare", &picture, &other, "--max-relmse", "0"]);
        let output = compare.stdout(writer).output().expect("it runs");
        assert_eq!(output.status.code(), Some(1), "a check that fails");
    }
}
