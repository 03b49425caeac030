//! Frames of an animation as jobs for farms: each is the picture that one machine makes of it.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::process::Command;

use super::farm::SBATCH;
use super::folder::{Folder, LIT, assert_refused, stdout};

/// A program that is killed in its first try of each odd part of each frame.
const KILLED: &str = r#"#!/bin/sh
for word; do last=$word; done
part=$(basename "$last" .exr)
frame=$(basename "$(dirname "$last")")
case "$1.$part" in
render.*[13579])
    if mkdir "$MARKS/$frame.$part" 2>/dev/null; then kill -9 $$; fi ;;
esac
exec "$REAL" "$@"
"#;

/// The flags of all pictures.
const PICTURE: [&str; 6] = ["--width", "8", "--spp", "36", "--seed", "3"];

/// A lamp that moves along, in frames 9 to 11.
struct Shot(Folder);

impl Shot {
    fn new(name: &str) -> Self {
        let folder = Folder::new(name);
        folder.file("scene.mtl", LIT);
        for frame in 9..=11 {
            let x = 0.3 * f64::from(frame - 10);
            let quad = "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\n";
            let lamp = [(-0.2, -0.2), (0.2, -0.2), (0.2, 0.2), (-0.2, 0.2)]
                .map(|(dx, z)| format!("v {} 1 {z}\n", x + dx))
                .concat();
            let faces = "usemtl floor\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n";
            let text = format!("mtllib scene.mtl\n{quad}{lamp}{faces}");
            folder.file(&format!("shot.{frame:03}.obj"), &text);
        }
        let program = folder.file("lights", KILLED);
        fs::set_permissions(program, fs::Permissions::from_mode(0o755)).expect("a program");
        fs::create_dir(folder.path("marks")).expect("a folder");
        Self(folder)
    }

    fn write(&self, parts: &str, engine: &str) -> String {
        let (scene, job) = (self.0.path("shot.###.obj"), self.0.path("job"));
        let farm = ["farm", &scene, "--frames", "9-11", "--parts", parts];
        let engine = ["--engine", engine, "-o", &job];
        stdout(&[&farm[..], &engine, &PICTURE].concat())
    }

    fn run(&self, script: &str, words: &[&str]) -> Option<i32> {
        let mut command = Command::new("sh");
        command
            .arg(self.0.path(&format!("job/{script}")))
            .args(words);
        command.env("LIGHTS", self.0.path("lights"));
        command.env("REAL", env!("CARGO_BIN_EXE_lights"));
        command.env("MARKS", self.0.path("marks"));
        command.output().expect("a shell").status.code()
    }

    fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.0.path(name)).expect("a picture")
    }

    /// Holds the picture of each frame against what one machine makes of its scene.
    fn check(&self) {
        let mut pictures = Vec::new();
        for frame in ["009", "010", "011"] {
            let scene = self.0.path(&format!("shot.{frame}.obj"));
            let whole = self.0.path("whole.exr");
            stdout(&[&["render", &scene, "-o", &whole][..], &PICTURE].concat());
            let picture = self.bytes(&format!("job/picture.{frame}.exr"));
            assert!(picture == self.bytes("whole.exr"), "frame {frame}");
            assert!(!pictures.contains(&picture), "the lamp of {frame} moved");
            pictures.push(picture);
        }
    }
}

#[test]
fn frames_are_the_pictures_of_one_machine() {
    let shot = Shot::new("farm-frames");
    let said = shot.write("3", "openjd");
    assert!(said.contains("009 to 011"), "how to go on: {said}");
    for (part, frame) in [
        ("1", "10"),
        ("0", "11"),
        ("2", "9"),
        ("1", "9"),
        ("0", "10"),
    ] {
        assert_eq!(shot.run("part.sh", &[part, frame]), Some(0), "{part}");
    }
    assert_ne!(shot.run("merge.sh", &["9"]), Some(0), "part 0 is missing");
    for (part, frame) in [
        ("0", "9"),
        ("2", "10"),
        ("1", "11"),
        ("2", "11"),
        ("1", "10"),
    ] {
        assert_eq!(shot.run("part.sh", &[part, frame]), Some(0), "{part}");
    }
    for frame in ["11", "9", "10"] {
        let killed = format!("marks/{:0>3}.1", frame);
        assert!(shot.0.0.join(killed).exists(), "part 1 was killed once");
        assert_eq!(shot.run("merge.sh", &[frame]), Some(0), "{frame}");
    }
    shot.check();
    let template = fs::read_to_string(shot.0.path("job/job.yaml")).expect("a template");
    let template: serde_json::Value = serde_json::from_str(&template).expect("JSON");
    for (step, parameters) in [(0, 2), (1, 1)] {
        let space = &template["steps"][step]["parameterSpace"]["taskParameterDefinitions"];
        assert_eq!(space.as_array().map(Vec::len), Some(parameters), "{space}");
        assert_eq!(space[0]["range"], "9-11", "{space}");
    }
}

#[test]
fn slurm_gets_an_array_for_each_frame() {
    let shot = Shot::new("farm-frames-slurm");
    shot.write("33", "slurm");
    let bin = shot.0.path("bin");
    fs::create_dir(&bin).expect("a folder");
    let sbatch = shot.0.file("bin/sbatch", SBATCH);
    fs::set_permissions(sbatch, fs::Permissions::from_mode(0o755)).expect("a program");
    let path = format!("{bin}:{}", std::env::var("PATH").expect("a path"));
    let mut submit = Command::new("sh");
    submit
        .arg(shot.0.path("job/submit.sh"))
        .arg("--partition=all");
    submit
        .env("PATH", path)
        .env("LIGHTS", env!("CARGO_BIN_EXE_lights"));
    let output = submit.output().expect("a shell");
    assert!(output.status.success(), "{output:?}");
    shot.check();
}

#[test]
fn frames_that_do_not_fit_together_are_refused() {
    let shot = Shot::new("farm-frames-refused");
    let job = shot.0.path("job");
    let farm = |scene: &str, frames: &str, words: &[&str]| {
        let scene = shot.0.path(scene);
        let farm = ["farm", &scene, "--frames", frames, "-o", &job];
        let engine = ["--engine", "slurm", "--parts", "2"];
        assert_refused(&[&farm[..], &engine].concat(), words);
    };
    farm("shot.009.obj", "9-11", &["shot.009.obj", "run of #"]);
    farm("shot.###.obj", "9-12", &["shot.012.obj"]);
    farm("shot.####.obj", "9", &["shot.0009.obj"]);
    farm("shot.###.obj", "11-9", &["--frames", "1-24"]);
    let text = |spp| format!("Sampler \"independent\" \"integer pixelsamples\" {spp} WorldBegin");
    for (frame, spp) in [(1, 8), (2, 8), (3, 9)] {
        shot.0.file(&format!("other.{frame}.pbrt"), &text(spp));
    }
    farm(
        "other.#.pbrt",
        "1-3",
        &["other.3.pbrt", "8 samples", "found 9"],
    );
    assert!(!shot.0.0.join("job").exists(), "and nothing is written");
}
