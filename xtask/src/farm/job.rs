use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::steps::{Outcome, StepResult, output, root, run};

/// Small pictures in parts, the program that renders them, and the pictures as one machine makes
/// them.
#[derive(Debug)]
pub(super) struct Job {
    engine: &'static str,
    pictures: Pictures,
    folder: PathBuf,
    /// What one machine makes, in the order of the pictures.
    whole: Vec<Vec<u8>>,
}

/// What a job makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pictures {
    /// One of a scene.
    One,
    /// One of each of three frames, in which a lamp moves.
    Frames,
}

impl Pictures {
    /// What it is called.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::One => "picture",
            Self::Frames => "frames",
        }
    }

    /// How many parts each has.
    const fn parts(self) -> u32 {
        match self {
            Self::One => 6,
            Self::Frames => 4,
        }
    }

    /// Where the numbers of frames stand in names, and what a task is told to name its frame.
    const fn frames(self) -> &'static [(&'static str, &'static [&'static str])] {
        match self {
            Self::One => &[("", &[])],
            Self::Frames => &[(".01", &["1"]), (".02", &["2"]), (".03", &["3"])],
        }
    }

    /// The words of `lights farm` that say what it is.
    fn scene(self, folder: &Path) -> Vec<String> {
        match self {
            Self::One => vec!["cornell-box".into()],
            Self::Frames => {
                let shot = folder.join("shot.##.obj").display().to_string();
                vec![shot, "--frames".into(), "1-3".into()]
            }
        }
    }

    /// The scene of a picture.
    fn scene_of(self, folder: &Path, frame: &str) -> String {
        match self {
            Self::One => "cornell-box".into(),
            Self::Frames => folder
                .join(format!("shot{frame}.obj"))
                .display()
                .to_string(),
        }
    }

    /// Writes the scenes of frames.
    fn write_scenes(self, folder: &Path) -> std::io::Result<()> {
        if self == Self::One {
            return Ok(());
        }
        let materials = "newmtl floor\nKd .5 .5 .5\nnewmtl lamp\nKe 5 4 3\n";
        fs::write(folder.join("shot.mtl"), materials)?;
        for (i, (frame, _)) in (0_u8..).zip(self.frames()) {
            let x = f32::from(i) * 0.4 - 0.4;
            let floor = "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\n";
            let corners = [(-0.2, -0.2), (0.2, -0.2), (0.2, 0.2), (-0.2, 0.2)];
            let lamp = corners.map(|(dx, z)| format!("v {} 1 {z}\n", x + dx));
            let faces = "usemtl floor\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n";
            let text = format!("mtllib shot.mtl\n{floor}{}{faces}", lamp.concat());
            fs::write(folder.join(format!("shot{frame}.obj")), text)?;
        }
        Ok(())
    }
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
mark=$MARKS/$(basename "$(dirname "$last")").$part
case "$1.$part" in
render.*[13579]) mkdir "$mark" 2>/dev/null && kill -9 $$ ;;
render.2)
    echo start >> "$MARKS/starts"
    mkdir "$mark" 2>/dev/null && sleep 4 ;;
esac
exec "$REAL" "$@"
"#;

/// The flags of all pictures.
const PICTURE: [&str; 6] = ["--width", "64", "--height", "64", "--spp", "48"];

impl Job {
    /// Writes the job for `engine` into a folder of its own below `folder`.
    ///
    /// # Errors
    /// The command line that failed, or what cannot be written.
    pub(super) fn new(
        folder: &Path,
        engine: &'static str,
        pictures: Pictures,
    ) -> Result<Self, String> {
        let folder = folder.join(engine).join(pictures.name());
        // It is left over from another run, if it is there.
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(folder.join("marks")).map_err(|e| e.to_string())?;
        fs::write(folder.join("lights"), KILLED).map_err(|e| e.to_string())?;
        run(Command::new("chmod").arg("+x").arg(folder.join("lights")))?;
        pictures.write_scenes(&folder).map_err(|e| e.to_string())?;
        let mut whole = Vec::new();
        for (frame, _) in pictures.frames() {
            let file = folder.join("whole.exr");
            let mut render = lights();
            render.arg("render").arg(pictures.scene_of(&folder, frame));
            run(render.args(PICTURE).arg("--quiet").arg("-o").arg(&file))?;
            whole.push(fs::read(file).map_err(|e| e.to_string())?);
        }
        let parts = pictures.parts().to_string();
        let parts = ["--parts", &parts, "--threads", "1", "--engine", engine];
        let mut farm = lights();
        farm.arg("farm").args(pictures.scene(&folder));
        farm.args(PICTURE).args(parts);
        output(farm.arg("-o").arg(folder.join("job")))?;
        Ok(Self {
            engine,
            pictures,
            whole,
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

    /// Whether part 2 of a picture waits.
    pub(super) fn waits(&self) -> bool {
        self.starts_of_waiting_parts() > 0
    }

    /// A file that parts 2 write a line to when they start.
    pub(super) fn starts(&self) -> PathBuf {
        self.folder.join("marks/starts")
    }

    /// How often parts 2 were started.
    fn starts_of_waiting_parts(&self) -> usize {
        let starts = fs::read_to_string(self.starts());
        starts.map_or(0, |starts| starts.lines().count())
    }

    /// Whether a part 2, whose machine was lost, was started more than once.
    ///
    /// # Errors
    /// That it was not.
    pub(super) fn was_started_again(&self) -> Result<(), NoPicture> {
        if self.starts_of_waiting_parts() > self.whole.len() {
            return Ok(());
        }
        let engine = self.engine;
        let why = format!("{engine}: the part on the lost machine was not started again");
        Err(NoPicture::Failed(why))
    }

    /// Whether all pictures are there.
    pub(super) fn is_done(&self) -> bool {
        let mut frames = self.pictures.frames().iter();
        frames.all(|(frame, _)| self.picture(frame).exists())
    }

    fn picture(&self, frame: &str) -> PathBuf {
        self.file(&format!("picture{frame}.exr"))
    }

    /// The folder of the parts of a picture, in the one of the job.
    fn parts(frame: &str) -> String {
        format!("parts/{}", frame.trim_start_matches('.'))
    }

    /// Lets the tasks that `command` starts find the program.
    pub(super) fn with_program<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        command
            .env("LIGHTS", self.folder.join("lights"))
            .env("REAL", program())
            .env("MARKS", self.folder.join("marks"))
    }

    /// Holds the pictures against those of one machine, renders a part of each again and merges
    /// again.
    ///
    /// # Errors
    /// What differs or is missing.
    pub(super) fn check(&self) -> StepResult {
        let engine = self.engine;
        for (frame, _) in self.pictures.frames() {
            let folder = Self::parts(frame);
            let folder = folder.trim_end_matches('/');
            let folder = folder.rsplit('/').next().unwrap_or_default();
            for part in (1..self.pictures.parts()).step_by(2) {
                let mark = format!("marks/{folder}.{part}");
                if !self.folder.join(&mark).exists() {
                    return Err(format!("{engine}: {mark}: the part was not killed"));
                }
            }
        }
        self.compare("the picture")?;
        for (frame, words) in self.pictures.frames() {
            let part = self.file(&Self::parts(frame)).join("0.exr");
            for file in [self.picture(frame), part] {
                fs::remove_file(file).map_err(|e| e.to_string())?;
            }
            let tasks: [&[&str]; 3] = [&["part.sh", "0"], &["part.sh", "3"], &["merge.sh"]];
            for task in tasks {
                let mut command = Command::new("sh");
                command
                    .arg(self.file(task[0]))
                    .args(&task[1..])
                    .args(*words);
                run(self.with_program(&mut command))?;
            }
        }
        self.compare("the picture with a part that was rendered again")?;
        Ok(Outcome::Passed)
    }

    fn compare(&self, what: &str) -> Result<(), String> {
        let engine = self.engine;
        for ((frame, _), whole) in self.pictures.frames().iter().zip(&self.whole) {
            let picture = fs::read(self.picture(frame))
                .map_err(|error| format!("{engine}: picture{frame}.exr: {error}"))?;
            if picture != *whole {
                return Err(format!(
                    "{engine}: {what}{frame} is not that of one machine"
                ));
            }
        }
        let mut others = self.whole.iter().skip(1);
        if others.any(|other| *other == self.whole[0]) {
            return Err(format!("{engine}: the lamp does not move"));
        }
        Ok(())
    }
}

fn program() -> PathBuf {
    root().join("target/debug/lights")
}

fn lights() -> Command {
    Command::new(program())
}
