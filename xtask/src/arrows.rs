//! `cargo xtask arrows [--write]`: the drawing of the crates in `ARCHITECTURE.md` against the
//! manifests, and the files that the page links to.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use serde_json::Value;

use crate::steps::{Outcome, StepResult, cargo, output, root};

const PAGE: &str = "ARCHITECTURE.md";

/// What encloses the drawing in the page.
const BEGIN: &str = "<!-- cargo xtask arrows -->\n\n```text\n";
const END: &str = "```\n\n<!-- end of the arrows -->";

/// How many files the tour of the page leads to.
const STOPS: usize = 10;

/// For each crate the crates of this workspace that it needs, each with whether a feature turns it
/// on.
type Arrows = BTreeMap<String, BTreeMap<String, bool>>;

/// Compares the drawing with the manifests, or writes it, and looks for every file that is linked.
///
/// # Errors
/// A drawing that differs, a link to a file that does not exist, or a tour of another length.
pub fn arrows(arguments: &[String]) -> StepResult {
    let is_written = match arguments {
        [] => false,
        [flag] if flag == "--write" => true,
        _ => return Err("usage: cargo xtask arrows [--write]".into()),
    };
    let path = root().join(PAGE);
    let page = fs::read_to_string(&path).map_err(|e| format!("{PAGE}: {e}"))?;
    let (before, rest) = page.split_once(BEGIN).ok_or("no drawing of the arrows")?;
    let (drawn, after) = rest.split_once(END).ok_or("no end of the arrows")?;
    let drawing = drawing(needs()?);
    if is_written {
        let page = [before, BEGIN, &drawing, END, after].concat();
        fs::write(&path, page).map_err(|e| format!("{PAGE}: {e}"))?;
    } else if drawn != drawing {
        return Err(format!(
            "{PAGE}: {}; `cargo xtask arrows --write`",
            difference(drawn, &drawing)
        ));
    }
    let stops = page.lines().filter_map(stop).count();
    if stops != STOPS {
        return Err(format!("{PAGE}: a tour of {stops} stops, not {STOPS}"));
    }
    match links(&page).find(|link| !root().join(link).exists()) {
        Some(link) => Err(format!("{PAGE}: links to {link}, which does not exist")),
        None => Ok(Outcome::Passed),
    }
}

/// The normal dependencies between the crates of the workspace, as the manifests say.
fn needs() -> Result<Arrows, String> {
    let metadata = output(&mut cargo([
        "metadata",
        "--quiet",
        "--no-deps",
        "--format-version=1",
    ]))?;
    let metadata: Value = serde_json::from_str(&metadata).map_err(|e| e.to_string())?;
    Ok(arrows_of(&metadata))
}

fn arrows_of(metadata: &Value) -> Arrows {
    let name = |package: &Value| package["name"].as_str().unwrap_or_default().to_owned();
    let packages = metadata["packages"].as_array().into_iter().flatten();
    let crates: BTreeSet<String> = packages.clone().map(name).collect();
    let needs = |package: &Value| {
        let dependencies = package["dependencies"].as_array().into_iter().flatten();
        // The kind of a normal dependency is null, others are "dev" and "build".
        let normal = dependencies.filter(|dependency| dependency["kind"].is_null());
        let own = normal.filter(|dependency| crates.contains(&name(dependency)));
        own.map(|dependency| (name(dependency), dependency["optional"] == true))
            .collect()
    };
    packages
        .map(|package| (name(package), needs(package)))
        .collect()
}

/// A line a crate, each below all those that it needs.
fn drawing(mut rest: Arrows) -> String {
    let width = rest.keys().map(String::len).max().unwrap_or_default();
    let mut text = String::new();
    while !rest.is_empty() {
        let is_ready = |needs: &BTreeMap<String, bool>| {
            let waits = |name| rest.contains_key(name);
            !needs.keys().any(waits)
        };
        let next: Vec<String> = rest
            .iter()
            .filter(|(_, needs)| is_ready(needs))
            .map(|(name, _)| name.clone())
            .collect();
        // Cargo refuses circles: something is ready always.
        for name in next {
            let needs = rest.remove(&name).unwrap_or_default();
            let needs = needs.into_iter().map(|(need, is_optional)| {
                if is_optional {
                    format!("({need})")
                } else {
                    need
                }
            });
            let needs: Vec<String> = needs.collect();
            let line = if needs.is_empty() {
                name
            } else {
                format!("{name:width$} ──► {}", needs.join(", "))
            };
            text = text + &line + "\n";
        }
    }
    text
}

/// The first line in which two drawings differ.
fn difference(drawn: &str, drawing: &str) -> String {
    let (drawn, drawing) = (drawn.lines(), drawing.lines());
    let missing = drawing
        .clone()
        .find(|line| !drawn.clone().any(|d| d == *line));
    let wrong = drawn
        .clone()
        .find(|line| !drawing.clone().any(|d| d == *line));
    match (missing, wrong) {
        (Some(line), _) => format!("the arrows lack the line `{line}`"),
        (None, Some(line)) => format!("the arrows have the line `{line}` too much"),
        (None, None) => "the arrows are in another order".into(),
    }
}

/// The file of a stop of the tour: a numbered line that begins with a link.
fn stop(line: &str) -> Option<&str> {
    let (number, rest) = line.split_once(". [")?;
    number.parse::<usize>().ok()?;
    rest.split_once("](")?.1.split(')').next()
}

/// What the page links to, but for other sites and its own sections.
fn links(page: &str) -> impl Iterator<Item = &str> {
    let targets = page.split("](").skip(1);
    targets
        .filter_map(|rest| rest.split([')', '#']).next())
        .filter(|link| !link.is_empty() && !link.contains("://"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn crates_stand_below_what_they_need() {
        let metadata = json!({ "packages": [
            { "name": "a", "dependencies": [
                { "name": "leaf", "kind": null, "optional": false },
                { "name": "b", "kind": "dev", "optional": false },
                { "name": "other", "kind": null, "optional": false },
            ]},
            { "name": "b", "dependencies": [
                { "name": "a", "kind": null, "optional": false },
                { "name": "leaf", "kind": null, "optional": true },
            ]},
            { "name": "leaf", "dependencies": [] },
        ]});
        assert_eq!(
            drawing(arrows_of(&metadata)),
            "leaf\na    ──► leaf\nb    ──► a, (leaf)\n"
        );
    }

    #[test]
    fn differences_name_a_line() {
        assert!(difference("a\n", "a\nb\n").contains("lack the line `b`"));
        assert!(difference("a\nb\n", "a\n").contains("`b` too much"));
        assert!(difference("a\nb\n", "b\na\n").contains("order"));
    }

    #[test]
    fn stops_and_links() {
        let line = "3. [`scene.rs`](crates/scene.rs): what was read, see [here](#rooms) and \
                    [there](https://a.b).";
        assert_eq!(stop(line), Some("crates/scene.rs"), "a stop");
        assert_eq!(stop("- [a](b)"), None, "no number");
        assert_eq!(links(line).collect::<Vec<_>>(), ["crates/scene.rs"]);
    }
}
