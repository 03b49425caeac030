//! Broken files of every format end the program with status 2 and one line on standard error.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use light_scene::glam::Vec3;
use light_scene::{Image, write_image};

/// Runs the program on a file of the folder; what it says if it ends with status 2.
fn refusal(folder: &Path, arguments: &[&str], file: &str) -> Option<String> {
    let path = folder.join(file);
    let mut command = Command::new(env!("CARGO_BIN_EXE_lights"));
    let output = command.args(arguments).arg(&path).output();
    let output = output.expect("the program runs");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let code = output.status.code();
    assert!(
        matches!(code, Some(0 | 2)),
        "{file}: status {code:?}: {said}"
    );
    (code == Some(2)).then_some(said)
}

/// A folder that is removed at the end.
struct Folder(PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        drop(fs::remove_dir_all(&self.0));
    }
}

#[test]
fn broken_files_of_every_format_end_with_status_2() {
    let name = format!("lights-bad-input-{}", std::process::id());
    let folder = Folder(std::env::temp_dir().join(name));
    let folder = &*folder.0;
    fs::create_dir_all(folder).expect("a folder");
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../light-scene/testdata/three_formats");
    let picture = Image::new(4, 4, vec![Vec3::splat(0.5); 16]).expect("an image");
    for image in ["a.exr", "a.hdr", "a.png"] {
        write_image(&folder.join(image), &picture).expect("written");
    }
    for (from, to) in [
        ("room.obj", "room.obj"),
        ("room.mtl", "room.mtl"),
        ("room.pbrt", "room.pbrt"),
        ("room.gltf", "room.gltf"),
        ("room.glb", "room.glb"),
        ("tiles.png", "tiles.png"),
    ] {
        fs::copy(data.join(from), folder.join(to)).expect("copied");
    }
    let ies =
        "IESNA:LM-63-2002\nTILT=NONE\n1 2000 1 3 1 1 2 0 0 0\n1 1 100\n0 60 90\n0\n500 250 0\n";
    fs::write(folder.join("a.ies"), ies).expect("written");
    let info = ["info", "--json"];
    let median = ["env", "median-cut", "-n", "2"];
    let cases: [(&str, &[&str]); 8] = [
        ("room.obj", &info),
        ("room.pbrt", &info),
        ("room.gltf", &info),
        ("room.glb", &info),
        ("a.exr", &median),
        ("a.hdr", &median),
        ("a.png", &median),
        ("a.ies", &["ies"]),
    ];
    for (file, arguments) in cases {
        let good = fs::read(folder.join(file)).expect("read");
        assert_eq!(refusal(folder, arguments, file), None, "{file} is good");
        let mut refused = 0;
        for k in 1..=6 {
            let cut = good.len() * k / 7;
            let hole = [&good[..cut], &b"\0x\xff"[..], &good[cut + 1..]].concat();
            for (kind, variant) in [("cut", good[..cut].to_vec()), ("hole", hole)] {
                let broken = format!("{kind}-{k}-{file}");
                fs::write(folder.join(&broken), variant).expect("written");
                if let Some(said) = refusal(folder, arguments, &broken) {
                    assert_eq!(said.lines().count(), 1, "{broken}: {said}");
                    assert!(
                        said.contains(&broken),
                        "{broken}: the file is named: {said}"
                    );
                    refused += 1;
                }
            }
        }
        assert!(refused >= 4, "{refused} of 12 variants of {file}");
    }
}
