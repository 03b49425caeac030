//! Files for a test, and the program that works on them.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

/// A folder of its own for a test, removed at its end.
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    pub(crate) fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("lights-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).expect("a folder to write to");
        Self(path)
    }

    pub(crate) fn file(&self, name: &str, content: &str) -> String {
        let path = self.path(name);
        fs::write(&path, content).expect("a file");
        path
    }

    pub(crate) fn path(&self, name: &str) -> String {
        self.0.join(name).to_str().expect("a plain path").into()
    }

    /// Two triangles, one of which emits light unless `mtl` says otherwise.
    pub(crate) fn scene(&self, mtl: &str) -> String {
        self.file("scene.mtl", mtl);
        let quad = "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\n";
        let lamp = "v -.2 1 -.2\nv .2 1 -.2\nv .2 1 .2\nv -.2 1 .2\n";
        let faces = "usemtl floor\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n";
        self.file(
            "scene.obj",
            &format!("mtllib scene.mtl\n{quad}{lamp}{faces}"),
        )
    }

    pub(crate) fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(&self.0)
            .expect("the folder")
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

pub(crate) const LIT: &str = "newmtl floor\nKd .5 .5 .5\nnewmtl lamp\nKe 5 4 3\n";
/// An .ies file.
pub(crate) const LAMP: &str =
    "IESNA:LM-63-2002\nTILT=NONE\n1 2000 1 3 1 1 2 0 0 0\n1 1 100\n0 60 90\n0\n5 2 0\n";
pub(crate) const UNLIT: &str = "newmtl floor\nKd .5 .5 .5\nnewmtl lamp\nKd .5 .5 .5\n";

pub(crate) fn lights(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lights"))
        .args(args)
        .output()
        .expect("the program runs")
}

/// The program refuses `args` with one line that holds all of `words`, and prints nothing else.
pub(crate) fn assert_refused(args: &[&str], words: &[&str]) {
    let output = lights(args);
    let error = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(2), "{args:?}: {error}");
    assert_eq!(error.trim_end().lines().count(), 1, "one line: {error}");
    assert!(
        output.stdout.is_empty(),
        "nothing on standard output: {args:?}"
    );
    for word in words {
        assert!(error.contains(word), "{word:?} in {error:?}");
    }
}

pub(crate) fn stdout(args: &[&str]) -> String {
    let output = lights(args);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{args:?}: {error}");
    String::from_utf8(output.stdout).expect("text")
}

/// What the program says on standard error of a picture that it makes, a [`SMALL`] one.
pub(crate) fn words(args: &[&str]) -> String {
    let output = lights(&[args, &SMALL[..]].concat());
    let error = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(0), "{args:?}: {error}");
    error
}

pub(crate) const SMALL: [&str; 4] = ["--width", "12", "--spp", "4"];
