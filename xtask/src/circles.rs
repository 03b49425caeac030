//! Circles of imports: no two source files need each other, be it by way of others.

mod imports;
mod module;
mod paths;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::steps::{Outcome, StepResult, cargo, output, root};

use module::Modules;

/// For each file the files that it needs.
type Needs = BTreeMap<PathBuf, BTreeSet<PathBuf>>;

/// Follows the imports of every target of the workspace, tests of the same file left out, through
/// re-exports to the files that define the items.
///
/// # Errors
/// A shortest circle, or a file that cannot be read.
pub fn check() -> StepResult {
    let mut needs = Needs::new();
    for target in targets()? {
        let modules = Modules::read(&target)?;
        for (file, needed) in modules.imports() {
            needs.entry(file).or_default().insert(needed);
        }
    }
    match shortest_circle(&needs) {
        Some(files) => Err(format!("files import each other: {}", arrows(&files))),
        None => Ok(Outcome::Passed),
    }
}

/// The first file of every target of every package.
fn targets() -> Result<BTreeSet<PathBuf>, String> {
    let mut metadata = cargo(["metadata", "--quiet", "--no-deps", "--format-version=1"]);
    let metadata: Value =
        serde_json::from_str(&output(&mut metadata)?).map_err(|e| e.to_string())?;
    let packages = metadata["packages"].as_array().into_iter().flatten();
    let targets = packages.flat_map(|package| package["targets"].as_array().into_iter().flatten());
    let paths = targets.filter_map(|target| target["src_path"].as_str());
    Ok(paths.map(PathBuf::from).collect())
}

/// The fewest files that need each other in turn, the first of them once more at the end.
fn shortest_circle(needs: &Needs) -> Option<Vec<PathBuf>> {
    let circles = needs.keys().filter_map(|file| way_back(needs, file));
    circles.min_by_key(Vec::len)
}

/// The shortest way along needs from a file to itself.
fn way_back(needs: &Needs, file: &Path) -> Option<Vec<PathBuf>> {
    let mut seen = BTreeSet::new();
    let mut ways = vec![vec![file.to_owned()]];
    while !ways.is_empty() {
        let mut longer = Vec::new();
        for way in ways {
            for next in way.last().and_then(|last| needs.get(last))? {
                let way = [&way[..], core::slice::from_ref(next)].concat();
                if next == file {
                    return Some(way);
                }
                if needs.contains_key(next) && seen.insert(next.clone()) {
                    longer.push(way);
                }
            }
        }
        ways = longer;
    }
    None
}

fn arrows(files: &[PathBuf]) -> String {
    let short = |file: &PathBuf| {
        let path = file.strip_prefix(root()).unwrap_or(file);
        path.display().to_string()
    };
    files.iter().map(short).collect::<Vec<_>>().join(" -> ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn needs(pairs: &[(&str, &str)]) -> Needs {
        let mut needs = Needs::new();
        for &(file, needed) in pairs {
            needs.entry(file.into()).or_default().insert(needed.into());
        }
        needs
    }

    #[test]
    fn the_shortest_circle_is_found() {
        let straight = needs(&[("a", "b"), ("b", "c"), ("a", "c")]);
        assert_eq!(shortest_circle(&straight), None);
        let round = needs(&[("a", "b"), ("b", "c"), ("c", "a"), ("c", "d"), ("d", "c")]);
        let files = shortest_circle(&round).expect("two circles");
        assert_eq!(arrows(&files), "c -> d -> c");
    }
}
