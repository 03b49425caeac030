//! `cargo xtask gpu [QUERIES [SET]]`: the shaders of `light-gpu` against the Rust crates, on the
//! driver of this machine, or on Mesa's software driver from Debian; then the examples `lit_pixel`,
//! `gbuffer` and `techniques`.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::debian::{libraries, unpacked};
use crate::steps::{Outcome, StepResult, cargo, output, root};

/// The workspace of the check, which needs a graphics stack to build.
const MANIFEST: &str = "gpu/wgsl/Cargo.toml";

/// The exit status by which the check says that there is no device.
const NO_DEVICE: i32 = 77;

/// Debian's packages of a Vulkan driver that needs no graphics card.
const DRIVER: [&str; 2] = ["mesa-vulkan-drivers", "libvulkan1"];

/// Runs the check.
///
/// # Errors
/// When the shaders answer otherwise than they may, or the check does not build.
pub fn gpu(arguments: &[String]) -> StepResult {
    if holds(check(arguments))? {
        return examples(&[]);
    }
    println!("    no driver for Vulkan, Metal or DirectX 12");
    let folder = match unpacked("vulkan", &DRIVER.map(String::from)) {
        Ok(folder) => folder,
        Err(why) => {
            return Ok(Outcome::Skipped(format!(
                "no driver, and none from Debian: {why}"
            )));
        }
    };
    let driver = [
        ("LD_LIBRARY_PATH", libraries(&folder)),
        ("VK_ICD_FILENAMES", description(&folder)?),
    ];
    let mut with_driver = check(arguments);
    with_driver.envs(driver.clone());
    if !holds(with_driver)? {
        return Ok(Outcome::Skipped("Mesa's driver does not run here".into()));
    }
    examples(&driver)
}

/// What is wrong with the `arguments` of the check, in one line; the names of its sets are its own.
pub fn wrong_arguments(arguments: &[String]) -> Option<String> {
    let (queries, set) = match arguments {
        [] => return None,
        [queries] => (queries, None),
        [queries, set] => (queries, Some(set)),
        _ => return Some("gpu: expected QUERIES and SET at most".into()),
    };
    if queries.parse::<u32>().is_err() {
        return Some(format!(
            "gpu: expected a number of queries, found {queries}"
        ));
    }
    let set = set?;
    let mut list = check(&["--sets".to_owned()]);
    // A check that does not build is reported by the check itself.
    let listed = list
        .output()
        .ok()
        .filter(|output| output.status.success())?;
    unknown_set(&String::from_utf8_lossy(&listed.stdout), set)
}

/// What to say where none of the names, a line each, has this `part`.
fn unknown_set(names: &str, part: &str) -> Option<String> {
    if names.lines().any(|name| name.contains(part)) {
        return None;
    }
    let names = names.lines().collect::<Vec<_>>().join(", ");
    Some(format!(
        "gpu: no set has {part} in its name; there are: {names}"
    ))
}

/// Runs the examples; those of pictures hold them against the CPU's.
fn examples(driver: &[(&str, String)]) -> StepResult {
    let mut command = program(["--example", "lit_pixel"]);
    let printed = output(command.envs(driver.iter().cloned()))?;
    println!("\nlit_pixel: {}", printed.trim());
    if !is_lit(&printed) {
        return Err(format!("the pixel of `lit_pixel` is none of {PIXEL:?}"));
    }
    for example in ["gbuffer", "techniques"] {
        println!();
        let mut command = program(["--example", example]);
        command.envs(driver.iter().cloned());
        if !command.status().map_err(|e| e.to_string())?.success() {
            return Err(format!("the example `{example}` fails"));
        }
    }
    Ok(Outcome::Passed)
}

/// What `lit_pixel` prints: a white floor under a white light of irradiance 1 and a red one.
const PIXEL: [u8; 4] = [162, 81, 81, 255];

/// Whether the program printed this pixel; by 256 choices it may be off by 2.
fn is_lit(printed: &str) -> bool {
    let bytes = printed.trim().trim_matches(['[', ']']).split(", ");
    let bytes: Result<Vec<u8>, _> = bytes.map(str::parse).collect();
    let near = |bytes: &[u8]| bytes.iter().zip(PIXEL).all(|(a, b)| a.abs_diff(b) <= 2);
    bytes.is_ok_and(|bytes| bytes.len() == PIXEL.len() && near(&bytes))
}

fn check(arguments: &[String]) -> Command {
    let mut command = program(["--bin", "light-gpu-check"]);
    command.arg("--").args(arguments);
    command
}

/// A program of the workspace of the check.
fn program(which: [&str; 2]) -> Command {
    let mut command = cargo(["run", "--quiet", "--release", "--manifest-path", MANIFEST]);
    let target = root().join("target").join("gpu");
    command.env("CARGO_TARGET_DIR", target).args(which);
    command
}

/// Whether the check ran and holds; false where there is no device.
fn holds(mut command: Command) -> Result<bool, String> {
    match command.status().map_err(|e| e.to_string())?.code() {
        Some(0) => Ok(true),
        Some(NO_DEVICE) => Ok(false),
        Some(_) => Err("the shaders answer otherwise than the crates".into()),
        None => Err("the check was stopped".into()),
    }
}

/// The file that tells the loader where the driver is: Debian's, with the path of this folder.
fn description(folder: &Path) -> Result<String, String> {
    let drivers = folder.join("usr/share/vulkan/icd.d");
    let name = format!("lvp_icd.{}.json", std::env::consts::ARCH);
    let theirs = fs::read_to_string(drivers.join(&name)).map_err(|e| format!("{name}: {e}"))?;
    let installed = "\"library_path\": \"";
    let here = format!("{installed}{}", folder.display());
    let ours = folder.join("driver.json");
    fs::write(&ours, theirs.replace(installed, &here)).map_err(|e| e.to_string())?;
    Ok(ours.display().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_arguments_are_one_line() {
        let wrong =
            |words: &[&str]| wrong_arguments(&words.iter().map(|&w| w.into()).collect::<Vec<_>>());
        assert_eq!(wrong(&[]), None, "all sets");
        assert_eq!(wrong(&["1024"]), None, "so many queries");
        let words = wrong(&["many"]).expect("no number");
        assert!(
            words.contains("expected a number") && words.contains("many"),
            "{words}"
        );
        assert!(
            wrong(&["1", "uniform", "100"]).is_some(),
            "a name is one word"
        );
    }

    #[test]
    fn a_pixel_is_lit_or_not() {
        assert!(is_lit("[162, 81, 81, 255]\n"), "as computed");
        assert!(is_lit("[160, 83, 81, 255]"), "off by two");
        for other in ["[159, 81, 81, 255]", "[162, 81, 81]", "[0, 0, 0, 0]", ""] {
            assert!(!is_lit(other), "{other}");
        }
    }

    #[test]
    fn an_unknown_set_is_told_those_that_there_are() {
        let names = "uniform 100\nspots 100\n";
        for part in ["spots", "100", ""] {
            assert_eq!(unknown_set(names, part), None, "{part:?}");
        }
        let words = unknown_set(names, "unifrom").expect("none has it");
        assert_eq!(words.lines().count(), 1, "{words}");
        for word in ["unifrom", "uniform 100, spots 100"] {
            assert!(words.contains(word), "{word} in {words}");
        }
    }
}
