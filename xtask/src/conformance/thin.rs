//! Makes the project's own set of vectors from a full one: small enough to ship, with every corner case kept.
//!
//! Lines are grouped by what they are (operation, light type, tags, oddities in the results). Lines that others refer
//! to stay, every group keeps its first lines, and the rest is taken at equal strides until the file's share is full.

use super::{default_folder, kind_of, vector_files};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::ExitCode;

/// What the files together may weigh, with room below the 3 MiB that the project allows itself.
const BUDGET_BYTES: usize = 2_900_000;

/// A file whose lines refer to each other stays whole.
const WHOLE: [&str; 1] = ["light_samplers"];

/// Fields whose value says which case a line is.
const GROUPING: [&str; 7] = [
    "kind",
    "op",
    "type",
    "sampler",
    "tag",
    "bounds_tag",
    "point_tag",
];

/// `cargo xtask thin-vectors FROM`.
#[must_use]
pub fn run(arguments: &[String]) -> ExitCode {
    let [from] = arguments else {
        eprintln!("usage: cargo xtask thin-vectors FROM");
        return ExitCode::from(2);
    };
    match thin_folder(Path::new(from), &default_folder()) {
        Ok(bytes) => {
            println!("{bytes} bytes");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}

fn thin_folder(from: &Path, to: &Path) -> Result<usize, String> {
    let explain = |path: &Path, e: std::io::Error| format!("{}: {e}", path.display());
    fs::create_dir_all(to).map_err(|e| explain(to, e))?;
    let mut texts = Vec::new();
    for file in vector_files(from)? {
        let text = fs::read_to_string(&file).map_err(|e| explain(&file, e))?;
        texts.push((kind_of(&file), text));
    }
    let is_whole = |kind: &str| WHOLE.contains(&kind);
    let whole: usize = texts
        .iter()
        .filter(|t| is_whole(&t.0))
        .map(|t| t.1.len())
        .sum();
    let rest: usize = texts
        .iter()
        .filter(|t| !is_whole(&t.0))
        .map(|t| t.1.len())
        .sum();
    let share = BUDGET_BYTES.saturating_sub(whole) as f64 / rest.max(1) as f64;

    let mut written = 0;
    for (kind, text) in texts {
        let kept = if is_whole(&kind) {
            text
        } else {
            thin_text(&text, share)
        };
        let file = to.join(format!("{kind}.jsonl"));
        fs::write(&file, &kept).map_err(|e| explain(&file, e))?;
        written += kept.len();
    }
    Ok(written)
}

/// The lines of `text` that make up about `share` of its bytes, in their old order.
fn thin_text(text: &str, share: f64) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let mut groups: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (index, line) in lines.iter().enumerate() {
        groups.entry(group_of(line)).or_default().push(index);
    }
    let mut kept: Vec<usize> = groups.values().flat_map(|g| spread(g, share)).collect();
    kept.sort_unstable();
    kept.iter()
        .flat_map(|&index| [lines[index], "\n"])
        .collect()
}

/// A `share` of the members of a group, at least one, at equal strides.
fn spread(group: &[usize], share: f64) -> impl Iterator<Item = usize> + '_ {
    let count = ((group.len() as f64 * share).round() as usize).clamp(1, group.len());
    (0..count).map(move |i| group[i * group.len() / count])
}

/// What kind of case `line` is: equal for lines that test the same thing.
fn group_of(line: &str) -> String {
    let value: Value = serde_json::from_str(line).unwrap_or_default();
    let field = |name: &&str| value.get(*name).map(Value::to_string).unwrap_or_default();
    let oddity = |word: &&&str| line.contains(**word);
    let tags = GROUPING.iter().map(field);
    let oddities = ["\"nan\"", "inf\"", "abort", "null"];
    let oddities = oddities
        .iter()
        .filter(oddity)
        .map(|word| (*word).to_owned());
    tags.chain(oddities).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_group_survives() {
        let text = "{\"op\":\"a\"}\n{\"op\":\"a\"}\n{\"op\":\"a\"}\n{\"op\":\"b\"}\n{\"op\":\"a\",\"x\":\"nan\"}\n";
        let kept = thin_text(text, 0.34);
        assert_eq!(
            kept, "{\"op\":\"a\"}\n{\"op\":\"b\"}\n{\"op\":\"a\",\"x\":\"nan\"}\n",
            "one of each"
        );
    }
}
