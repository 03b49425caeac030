//! `cargo xtask tint`: the project's WGSL by `tint`, the compiler of Dawn and Chrome. That naga
//! takes it is a test of `light-gpu`.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::steps::{Outcome, StepResult, output, root};

/// The least that a user writes beside the functions of `light-gpu`.
const SMALLEST: &str = "\
fn light_row(i: u32) -> vec4<u32> { return vec4<u32>(i); }
@compute @workgroup_size(1) fn entry() {}
";

/// The functions of `light-gpu`.
const LIGHTS: &str = "crates/light-gpu/lights.wgsl";

/// The shaders made of them: a name, and the files behind them.
const SHADERS: [(&str, &[&str]); 5] = [
    ("lights", &[]),
    ("check", &["gpu/wgsl/src/check.wgsl"]),
    ("lit_pixel", &["gpu/wgsl/examples/lit_pixel/pixel.wgsl"]),
    ("gbuffer", &["gpu/wgsl/examples/gbuffer/gbuffer.wgsl"]),
    (
        "techniques",
        &[
            "gpu/wgsl/examples/gbuffer/gbuffer.wgsl",
            "gpu/wgsl/examples/techniques/techniques.wgsl",
        ],
    ),
];

/// Compiles each shader.
///
/// # Errors
/// The first message of `tint`.
pub fn tint() -> StepResult {
    if Command::new("tint").arg("--help").output().is_err() {
        return Ok(Outcome::Skipped("`tint` of Dawn is not in the path".into()));
    }
    let folder = root().join("target/tint");
    fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    for (name, files) in SHADERS {
        let mut text = read(LIGHTS)?;
        match files {
            [] => text.push_str(SMALLEST),
            _ => {
                for file in files {
                    text.push_str(&read(file)?);
                }
            }
        }
        is_valid(&folder.join(format!("{name}.wgsl")), &text)?;
    }
    Ok(Outcome::Passed)
}

fn read(file: &str) -> Result<String, String> {
    fs::read_to_string(root().join(file)).map_err(|e| format!("{file}: {e}"))
}

/// Writes `text` to `path` and compiles it, to WGSL, which every build of `tint` can.
fn is_valid(path: &Path, text: &str) -> Result<(), String> {
    fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))?;
    let mut tint = Command::new("tint");
    tint.args(["--format", "wgsl", "--output-name"])
        .arg(path.with_extension("compiled"));
    output(tint.arg(path)).map(drop)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shaders_include_every_wgsl_file() {
        let listed: Vec<&str> = SHADERS
            .iter()
            .flat_map(|(_, files)| *files)
            .copied()
            .collect();
        let files = output(
            Command::new("git")
                .args(["ls-files", "*.wgsl"])
                .current_dir(root()),
        );
        let Ok(files) = files else {
            println!("not checked: no list of files from git");
            return;
        };
        for file in files.lines() {
            assert!(file == LIGHTS || listed.contains(&file), "{file}");
        }
    }
}
