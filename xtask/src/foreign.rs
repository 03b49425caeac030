//! `cargo xtask foreign DIR`: what the program makes of every scene file below a folder.

mod child;
mod outcome;

use core::time::Duration;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::steps::{Outcome, StepResult, cargo, root, run};
use child::run_limited;
use outcome::{SceneOutcome, Verdict};

/// Endings of the names of scene files.
const ENDINGS: [&str; 4] = ["gltf", "glb", "obj", "pbrt"];

/// How a scene is rendered: small, and not for long.
const TINY: [&str; 9] = [
    "--width",
    "32",
    "--spp",
    "4",
    "--time",
    "10",
    "--max-depth",
    "3",
    "--json",
];

/// Longer than the time above, for reading and hierarchies.
const LIMIT: Duration = Duration::from_secs(60);

/// Renders every scene file below the folder that `arguments` name, tiny and within limits, and
/// prints a table: whether it was loaded, or which line refused it; warnings; a black picture; time
/// and memory. A file that panics, hangs or is refused in more than one line fails.
///
/// # Errors
/// Wrong arguments, a folder without scenes, or how many files failed.
pub fn foreign(arguments: &[String]) -> StepResult {
    let [folder] = arguments else {
        return Err("expected cargo xtask foreign DIR".into());
    };
    let mut scenes = Vec::new();
    scenes_below(Path::new(folder), &mut scenes)?;
    scenes.sort();
    if scenes.is_empty() {
        return Err(format!("{folder}: expected a folder with scene files"));
    }
    let build = [
        "build",
        "--release",
        "--package",
        "light-render",
        "--bin",
        "lights",
    ];
    run(&mut cargo(build))?;
    let program = root().join("target/release/lights");
    let image = std::env::temp_dir().join(format!("lights-foreign-{}.exr", std::process::id()));
    println!("{}", SceneOutcome::HEADER);
    let mut outcomes = Vec::with_capacity(scenes.len());
    for scene in &scenes {
        let mut command = Command::new(&program);
        command
            .arg("render")
            .arg(scene)
            .arg("-o")
            .arg(&image)
            .args(TINY);
        let ended = run_limited(command, LIMIT).map_err(|error| error.to_string())?;
        let name = scene.strip_prefix(folder).unwrap_or(scene);
        let outcome = SceneOutcome::of(&name.display().to_string(), &ended);
        println!("{outcome}");
        outcomes.push(outcome);
    }
    drop(fs::remove_file(&image));
    print_summary(&outcomes);
    match outcomes
        .iter()
        .filter(|o| o.verdict == Verdict::Broken)
        .count()
    {
        0 => Ok(Outcome::Passed),
        broken => Err(format!(
            "{broken} of {} files break the program",
            outcomes.len()
        )),
    }
}

/// Adds every scene file below `folder`; links are not followed, so that none is found twice.
fn scenes_below(folder: &Path, scenes: &mut Vec<PathBuf>) -> Result<(), String> {
    let entries = fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    for entry in entries {
        let entry = entry.map_err(|e| format!("{}: {e}", folder.display()))?;
        let kind = entry
            .file_type()
            .map_err(|e| format!("{}: {e}", folder.display()))?;
        let path = entry.path();
        let ending = path.extension().and_then(|ending| ending.to_str());
        let ending = ending.unwrap_or_default().to_ascii_lowercase();
        if kind.is_dir() {
            scenes_below(&path, scenes)?;
        } else if kind.is_file() && ENDINGS.contains(&ending.as_str()) {
            scenes.push(path);
        }
    }
    Ok(())
}

/// Totals, and in how many files each kind of warning and refusal stands.
fn print_summary(outcomes: &[SceneOutcome]) {
    let count = |verdict| outcomes.iter().filter(|o| o.verdict == verdict).count();
    let black = outcomes.iter().filter(|o| o.is_black).count();
    println!(
        "\n{} files: {} rendered, {black} of them black; {} refused; {} broken",
        outcomes.len(),
        count(Verdict::Rendered),
        count(Verdict::Refused),
        count(Verdict::Broken)
    );
    let kinds = |of: fn(&SceneOutcome) -> &[String], what: &str| {
        let mut files: BTreeMap<&str, usize> = BTreeMap::new();
        for outcome in outcomes {
            for kind in of(outcome) {
                *files.entry(kind).or_default() += 1;
            }
        }
        let mut files: Vec<(&str, usize)> = files.into_iter().collect();
        files.sort_by_key(|&(_, count)| core::cmp::Reverse(count));
        if !files.is_empty() {
            println!("\nfiles  {what}");
        }
        for (kind, count) in files {
            println!("{count:>5}  {kind}");
        }
    };
    kinds(|outcome| &outcome.refusals, "are refused because");
    kinds(|outcome| &outcome.warnings, "have the warning");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_are_found_in_all_folders() {
        let folder = std::env::temp_dir().join(format!("lights-scenes-{}", std::process::id()));
        fs::create_dir_all(folder.join("deep/er")).expect("folders");
        for name in [
            "a.obj",
            "deep/b.PBRT",
            "deep/er/c.glb",
            "deep/d.png",
            "e.mtl",
        ] {
            fs::write(folder.join(name), "").expect("a file");
        }
        let mut scenes = Vec::new();
        scenes_below(&folder, &mut scenes).expect("a folder");
        fs::remove_dir_all(&folder).expect("removed");
        assert_eq!(scenes.len(), 3, "{scenes:?}");
        assert!(scenes_below(&folder, &mut scenes).is_err(), "no folder");
    }
}
