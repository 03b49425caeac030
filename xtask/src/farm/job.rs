use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::steps::{Outcome, StepResult, output, root, run};

/// A small picture in parts, the program that renders it, and the picture as one machine makes it.
#[derive(Debug)]
pub(super) struct Job {
    engine: &'static str,
    folder: PathBuf,
    whole: Vec<u8>,
}

/// Why an engine made no picture.
#[derive(Debug)]
pub(super) enum NoPicture {
    /// It cannot be had here.
    NoEngine(String),
    /// It failed.
    Failed(String),
}

impl NoPicture {
    /// What the step says.
    pub(super) fn outcome(self) -> StepResult {
        match self {
            Self::NoEngine(why) => Ok(Outcome::Skipped(why)),
            Self::Failed(why) => Err(why),
        }
    }
}

/// What stands before the program: it is killed in its first try of each odd part, and waits in its
/// first try of part 2, so that the machine can be lost.
const KILLED: &str = r#"#!/bin/sh
for word; do last=$word; done
part=$(basename "$last" .exr)
case "$1.$part" in
render.*[13579]) mkdir "$MARKS/$part" 2>/dev/null && kill -9 $$ ;;
render.2)
    echo start >> "$MARKS/starts"
    mkdir "$MARKS/$part" 2>/dev/null && sleep 4 ;;
esac
exec "$REAL" "$@"
"#;

/// What both pictures are.
const PICTURE: [&str; 7] = [
    "cornell-box",
    "--width",
    "64",
    "--height",
    "64",
    "--spp",
    "48",
];

impl Job {
    /// Writes the job for `engine` into a folder of its own below `folder`.
    ///
    /// # Errors
    /// The command line that failed, or what cannot be written.
    pub(super) fn new(folder: &Path, engine: &'static str) -> Result<Self, String> {
        let folder = folder.join(engine);
        // It is left over from another run, if it is there.
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(folder.join("marks")).map_err(|e| e.to_string())?;
        fs::write(folder.join("lights"), KILLED).map_err(|e| e.to_string())?;
        run(Command::new("chmod").arg("+x").arg(folder.join("lights")))?;
        let whole = folder.join("whole.exr");
        run(lights()
            .arg("render")
            .args(PICTURE)
            .arg("--quiet")
            .arg("-o")
            .arg(&whole))?;
        let parts = ["--parts", "6", "--threads", "1", "--engine", engine];
        let mut farm = lights();
        farm.arg("farm").args(PICTURE).args(parts);
        output(farm.arg("-o").arg(folder.join("job")))?;
        Ok(Self {
            engine,
            whole: fs::read(whole).map_err(|e| e.to_string())?,
            folder,
        })
    }

    /// A folder for the files of the engine.
    pub(super) fn folder(&self) -> &Path {
        &self.folder
    }

    /// A file of the job.
    pub(super) fn file(&self, name: &str) -> PathBuf {
        self.folder.join("job").join(name)
    }

    /// Whether part 2 waits.
    pub(super) fn waits(&self) -> bool {
        self.folder.join("marks/2").exists()
    }

    /// How often part 2 was started.
    pub(super) fn starts_of_waiting_part(&self) -> usize {
        let starts = fs::read_to_string(self.folder.join("marks/starts"));
        starts.map_or(0, |starts| starts.lines().count())
    }

    /// Lets the tasks that `command` starts find the program.
    pub(super) fn with_program<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        command
            .env("LIGHTS", self.folder.join("lights"))
            .env("REAL", program())
            .env("MARKS", self.folder.join("marks"))
    }

    /// Holds the picture against the one of one machine, renders a part again and merges again.
    ///
    /// # Errors
    /// What differs or is missing.
    pub(super) fn check(&self) -> StepResult {
        let engine = self.engine;
        for part in [1, 3, 5] {
            if !self.folder.join(format!("marks/{part}")).exists() {
                return Err(format!("{engine}: part {part} was not killed"));
            }
        }
        self.compare("the picture")?;
        fs::remove_file(self.file("picture.exr")).map_err(|e| e.to_string())?;
        fs::remove_file(self.file("parts/4.exr")).map_err(|e| e.to_string())?;
        for words in [&["part.sh", "4"][..], &["part.sh", "0"], &["merge.sh"]] {
            let mut command = Command::new("sh");
            command.arg(self.file(words[0])).args(&words[1..]);
            run(self.with_program(&mut command))?;
        }
        self.compare("the picture with a part that was rendered again")?;
        Ok(Outcome::Passed)
    }

    fn compare(&self, what: &str) -> Result<(), String> {
        let engine = self.engine;
        let picture = fs::read(self.file("picture.exr"))
            .map_err(|error| format!("{engine}: picture.exr: {error}"))?;
        if picture == self.whole {
            Ok(())
        } else {
            Err(format!("{engine}: {what} is not that of one machine"))
        }
    }
}

fn program() -> PathBuf {
    root().join("target/debug/lights")
}

fn lights() -> Command {
    Command::new(program())
}
