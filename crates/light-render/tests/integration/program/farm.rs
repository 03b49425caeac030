//! Jobs for farms, run as an engine runs them: by their scripts, in any order, more than once.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

use light_render::PartialPicture;

use super::folder::{Folder, LIT, assert_refused, lights, stdout};

/// A program that is killed in its first try of each odd part, and is the real one otherwise.
const KILLED: &str = r#"#!/bin/sh
for word; do last=$word; done
part=$(basename "$last" .exr)
case "$1.$part" in
render.*[13579])
    if mkdir "$MARKS/$part" 2>/dev/null; then kill -9 $$; fi ;;
esac
exec "$REAL" "$@"
"#;

/// The part in a file. The order of what a file says beside its pixels is not always the same.
fn read(path: &str) -> PartialPicture {
    PartialPicture::read(Path::new(path)).expect("a part")
}

struct Job {
    folder: Folder,
    scene: String,
}

impl Job {
    fn new(name: &str) -> Self {
        let folder = Folder::new(name);
        let scene = folder.scene(LIT);
        let program = folder.file("lights", KILLED);
        fs::set_permissions(program, fs::Permissions::from_mode(0o755)).expect("a program");
        fs::create_dir(folder.path("marks")).expect("a folder");
        Self { folder, scene }
    }

    fn write(&self, parts: &str, engine: &str) -> String {
        let job = self.folder.path("job");
        let picture = ["--width", "8", "--spp", "40", "--seed", "3", "-o", &job];
        let farm = ["farm", &self.scene, "--parts", parts, "--engine", engine];
        stdout(&[&farm[..], &picture].concat())
    }

    fn run(&self, script: &str, words: &[&str]) -> Option<i32> {
        let script = self.folder.path(&format!("job/{script}"));
        let mut command = Command::new("sh");
        command.arg(script).args(words);
        command.env("LIGHTS", self.folder.path("lights"));
        command.env("REAL", env!("CARGO_BIN_EXE_lights"));
        command.env("MARKS", self.folder.path("marks"));
        let output = command.output().expect("a shell");
        output.status.code()
    }

    fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.folder.path(name)).expect("a picture")
    }

    /// Whether the picture of the job has the bytes that one machine makes.
    fn is_whole(&self) -> bool {
        let whole = self.folder.path("whole.exr");
        let picture = ["--width", "8", "--spp", "40", "--seed", "3", "-o", &whole];
        stdout(&[&["render", &self.scene][..], &picture].concat());
        self.bytes("job/picture.exr") == self.bytes("whole.exr")
    }
}

#[test]
fn killed_damaged_and_repeated_parts_make_the_same_picture() {
    let job = Job::new("farm");
    let said = job.write("5", "slurm");
    assert!(said.contains("submit.sh"), "how to go on: {said}");
    for part in ["4", "1", "0", "3"] {
        assert_eq!(job.run("part.sh", &[part]), Some(0), "part {part}");
    }
    assert!(
        job.folder.0.join("marks/3").exists(),
        "part 3 was killed once"
    );
    assert_ne!(job.run("merge.sh", &[]), Some(0), "part 2 is missing");
    assert_eq!(job.run("part.sh", &["2"]), Some(0), "part 2");
    let part = job.folder.0.join("job/parts/4.exr");
    let written = || {
        fs::metadata(&part)
            .and_then(|file| file.modified())
            .expect("a time")
    };
    let first = written();
    assert_eq!(job.run("part.sh", &["4"]), Some(0), "again");
    assert_eq!(written(), first, "a part that is whole is kept");
    let whole = fs::read(&part).expect("a part");
    let mut damaged = whole.clone();
    let middle = damaged.len() / 2;
    damaged[middle] ^= 1;
    fs::write(&part, damaged).expect("written");
    assert_ne!(job.run("merge.sh", &[]), Some(0), "part 4 is damaged");
    assert_eq!(job.run("part.sh", &["4"]), Some(0), "once more");
    let parse = |bytes: &[u8]| PartialPicture::parse(&part, bytes).expect("a part");
    let again = fs::read(&part).expect("a part");
    assert!(parse(&again) == parse(&whole), "rendered again");
    assert_eq!(job.run("merge.sh", &[]), Some(0), "all parts");
    assert!(job.is_whole(), "as by one machine");
}

#[test]
fn many_parts_are_merged_by_groups() {
    let job = Job::new("farm-groups");
    job.write("40", "openjd");
    for part in 0..40 {
        assert_eq!(job.run("part.sh", &[&part.to_string()]), Some(0), "{part}");
    }
    for group in ["1", "0"] {
        assert_eq!(job.run("group.sh", &[group]), Some(0), "group {group}");
    }
    assert_eq!(job.run("merge.sh", &[]), Some(0), "both groups");
    assert!(job.is_whole(), "as by one machine");
}

#[test]
fn a_part_of_another_picture_is_rendered_again() {
    let folder = Folder::new("farm-other");
    let scene = folder.scene(LIT);
    let part = folder.path("part.exr");
    let render = |seed: &str, samples: &str| {
        let keep = ["--skip-existing", "--samples", samples, "--seed", seed];
        stdout(&[&["render", &scene, "--width", "8", "-o", &part][..], &keep].concat());
        read(&part)
    };
    let first = render("1", "0..2");
    assert!(render("2", "0..2") != first, "another seed");
    assert!(render("1", "2..4") != first, "other samples");
    assert!(render("1", "0..2") == first, "the first once more");
}

#[test]
fn parts_join_into_a_part() {
    let folder = Folder::new("farm-join");
    let scene = folder.scene(LIT);
    let part = |samples: &str| {
        let path = folder.path(&format!("{samples}.exr"));
        stdout(&[
            "render",
            &scene,
            "--width",
            "8",
            "-o",
            &path,
            "--samples",
            samples,
        ]);
        path
    };
    let [a, b, c] = ["0..2", "2..3", "3..5"].map(part);
    let joined = folder.path("joined.exr");
    stdout(&["merge", &c, &b, "--part", "-o", &joined]);
    let whole = read(&part("2..5"));
    assert!(read(&joined) == whole, "as if rendered at once");
    assert_refused(&["merge", &a, &c, "--part", "-o", &joined], &["2..3"]);
    let png = folder.path("joined.png");
    assert_refused(&["merge", &a, &b, "--part", "-o", &png], &["joined.png"]);
}

#[test]
fn engines_get_what_was_typed() {
    let job = Job::new("farm-engines");
    job.write("40", "openjd");
    let text = |name: &str| fs::read_to_string(job.folder.path(name)).expect("a file");
    let part = text("job/part.sh");
    for word in ["--width 8", "--seed 3", "scene.obj", "40 * $1 / 40"] {
        assert!(part.contains(word), "{word}: {part}");
    }
    assert!(!part.contains("--spp"), "samples are the part's: {part}");
    let openjd: serde_json::Value = serde_json::from_str(&text("job/job.yaml")).expect("JSON");
    assert_eq!(
        openjd["steps"][2]["dependencies"][0]["dependsOn"], "Group",
        "{openjd}"
    );
    // What stands in for Slurm runs each array at once and says its number.
    let job = Job::new("farm-slurm");
    job.write("33", "slurm");
    let bin = job.folder.path("bin");
    fs::create_dir(&bin).expect("a folder");
    let sbatch = job.folder.file("bin/sbatch", SBATCH);
    fs::set_permissions(sbatch, fs::Permissions::from_mode(0o755)).expect("a program");
    let path = format!("{bin}:{}", std::env::var("PATH").expect("a path"));
    let mut submit = Command::new("sh");
    submit
        .arg(job.folder.path("job/submit.sh"))
        .arg("--partition=all");
    submit
        .env("PATH", path)
        .env("LIGHTS", env!("CARGO_BIN_EXE_lights"));
    let output = submit.output().expect("a shell");
    assert!(output.status.success(), "{output:?}");
    assert!(job.is_whole(), "as by one machine");
}

pub(crate) const SBATCH: &str = r#"#!/bin/sh
array= partition=
while [ $# -gt 0 ]; do
    case $1 in
    --array=*) array=${1#--array=0-} ;;
    --partition=all) partition=all ;;
    --wrap) script=$2; shift ;;
    esac
    shift
done
[ "$partition" = all ] || exit 1
SLURM_ARRAY_TASK_ID=0
while :; do
    export SLURM_ARRAY_TASK_ID
    sh -c "$script" >&2 || exit 1
    [ -n "$array" ] && [ $SLURM_ARRAY_TASK_ID -lt "$array" ] || break
    SLURM_ARRAY_TASK_ID=$((SLURM_ARRAY_TASK_ID + 1))
done
echo 17
"#;

#[test]
fn jobs_that_cannot_run_are_refused() {
    let folder = Folder::new("farm-refused");
    let scene = folder.scene(LIT);
    let job = folder.path("job");
    let farm = |more: &[&str], words: &[&str]| {
        let args = ["farm", &scene, "-o", &job];
        assert_refused(&[&args[..], more].concat(), words);
    };
    let parts = ["--parts", "9", "--engine", "slurm"];
    farm(&[&parts[..], &["--spp", "8"]].concat(), &["8 parts"]);
    farm(
        &[&parts[..], &["--samples", "0..8"]].concat(),
        &["--samples", "--spp"],
    );
    farm(
        &[&parts[..], &["--time", "8"]].concat(),
        &["--time", "--spp"],
    );
    farm(&["--parts", "9", "--engine", "sge"], &["sge", "hyperqueue"]);
    farm(&["--parts", "0", "--engine", "slurm"], &["--parts"]);
    assert_eq!(
        lights(&["farm", "none.obj", "-o", &job]).status.code(),
        Some(2),
        "flags"
    );
    assert!(!folder.0.join("job").exists(), "and nothing is written");
}
