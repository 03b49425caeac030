//! Makes the scene in flash from the files in `scene/`: whatever takes memory is done here.

mod lights_file;
mod records;
mod sky_file;

#[path = "../src/light_record.rs"]
#[allow(dead_code, reason = "the firmware reads what this writes")]
mod light_record;
#[path = "../src/scene_records.rs"]
mod scene_records;

use std::fs;
use std::path::{Path, PathBuf};

fn main() -> Result<(), String> {
    let variable = |name: &str| std::env::var(name).map_err(|e| format!("{name}: {e}"));
    let here = PathBuf::from(variable("CARGO_MANIFEST_DIR")?);
    let out = PathBuf::from(variable("OUT_DIR")?);
    println!("cargo::rerun-if-changed=scene");
    println!("cargo::rerun-if-changed=link");
    let scene = here.join("scene");
    for (file, bytes) in records::all(&scene)? {
        write(&out.join(file), &bytes)?;
    }
    if variable("CARGO_CFG_TARGET_OS")? == "none" {
        let link = here.join("link");
        println!("cargo::rustc-link-arg-bins=-L{}", link.display());
        println!("cargo::rustc-link-arg-bins=-T{}.ld", variable("TARGET")?);
    }
    Ok(())
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    fs::write(path, bytes).map_err(|e| format!("{}: {e}", path.display()))
}
