//! `cargo xtask api [--write]`: the public items of each library crate, held against `docs/api`, so
//! that a review sees every change.
//!
//! They are read from the pages of `cargo doc`, which stable Rust can make: a page an item, an
//! anchor a member.

use std::fs;
use std::path::{Path, PathBuf};

use crate::features::FEATURE_SETS;
use crate::steps::{Outcome, StepResult, cargo, root, run};

/// The kinds of items that have a page of their own, as its name begins.
const KINDS: [&str; 9] = [
    "attr", "constant", "derive", "enum", "fn", "macro", "struct", "trait", "type",
];

/// The kinds of members, as their anchors begin.
const MEMBERS: [&str; 6] = [
    "associatedconstant",
    "associatedtype",
    "method",
    "structfield",
    "tymethod",
    "variant",
];

/// The libraries without feature sets.
const WITHOUT_FEATURES: [&str; 3] = ["light-sets", "light-scene", "light-render"];

/// It has no items of its own.
const FACADE: &str = "lights";

/// In the title of a page that only leads to another one.
const REDIRECTION: &str = "<title>Redirection</title>";

/// Where what an item implements begins on its page: members before it are its own.
const IMPLEMENTATIONS: [&str; 4] = [
    "id=\"trait-implementations\"",
    "id=\"synthetic-implementations\"",
    "id=\"blanket-implementations\"",
    "id=\"implementors\"",
];

/// Compares with the files of `docs/api`, or writes them.
///
/// # Errors
/// A crate whose documentation does not build, or whose public items are others than its file says.
pub fn api(arguments: &[String]) -> StepResult {
    let is_written = match arguments {
        [] => false,
        [flag] if flag == "--write" => true,
        _ => return Err("usage: cargo xtask api [--write]".into()),
    };
    let packages = packages();
    document(&packages)?;
    let mut changed = Vec::new();
    for package in packages {
        let listed = listing(package)?;
        let path = root().join("docs/api").join(format!("{package}.txt"));
        println!("    {}", listed.lines().next().unwrap_or_default());
        if is_written {
            fs::create_dir_all(root().join("docs/api")).map_err(|e| e.to_string())?;
            fs::write(&path, listed).map_err(|e| format!("{}: {e}", path.display()))?;
        } else if fs::read_to_string(&path).unwrap_or_default() != listed {
            changed.push(package);
        }
    }
    if changed.is_empty() {
        Ok(Outcome::Passed)
    } else {
        let names = changed.join(", ");
        Err(format!(
            "public items of {names} differ from docs/api: `cargo xtask api --write`"
        ))
    }
}

/// The packages with a list.
fn packages() -> Vec<&'static str> {
    let mut packages: Vec<&str> = FEATURE_SETS.iter().map(|set| set.package).collect();
    packages.dedup();
    packages.retain(|&package| package != FACADE);
    packages.extend(WITHOUT_FEATURES);
    packages
}

/// The arguments of `cargo doc` for all libraries with all their features, together, so that each
/// crate is compiled once.
#[must_use]
pub fn selection() -> Vec<&'static str> {
    let packages = packages().into_iter().chain([FACADE]);
    let packages = packages.flat_map(|package| ["--package", package]);
    ["--lib", "--all-features"]
        .into_iter()
        .chain(packages)
        .collect()
}

/// The folder of the pages of a package.
fn pages(package: &str) -> PathBuf {
    root().join("target/doc").join(package.replace('-', "_"))
}

/// Writes the pages of the packages.
fn document(packages: &[&str]) -> Result<(), String> {
    for package in packages {
        let pages = pages(package);
        // Pages of items that are gone would stay.
        if pages.exists() {
            fs::remove_dir_all(&pages).map_err(|e| format!("{}: {e}", pages.display()))?;
        }
    }
    run(cargo(["doc", "--quiet", "--no-deps"]).args(selection()))
}

/// The count of the public items of a package, and a line for each, in alphabetical order.
fn listing(package: &str) -> Result<String, String> {
    let mut items = Vec::new();
    add_items(&pages(package), &package.replace('-', "_"), &mut items)?;
    items.sort();
    let mut text = format!("{package}: {} public items\n\n", items.len());
    for item in items {
        text.push_str(&item);
        text.push('\n');
    }
    Ok(text)
}

/// Adds the items of a module, whose pages are in `folder`, and of the modules below it.
fn add_items(folder: &Path, module: &str, items: &mut Vec<String>) -> Result<(), String> {
    let entries = fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    for entry in entries.filter_map(Result::ok) {
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = entry.path();
        if path.is_dir() {
            add_items(&path, &format!("{module}::{name}"), items)?;
            continue;
        }
        let Some((kind, item)) = item_of_page(&name) else {
            continue;
        };
        let item = format!("{module}::{item}");
        let page = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        // The page of an item in a private module leads to where the item is re-exported.
        if page.contains(REDIRECTION) {
            continue;
        }
        let own = members(&page);
        items.extend(own.map(|(kind, member)| format!("{item}::{member} ({kind})")));
        items.push(format!("{item} ({kind})"));
    }
    Ok(())
}

/// Kind and name of the item that a page is about; none if it is another page.
fn item_of_page(name: &str) -> Option<(&str, &str)> {
    let (kind, item) = name.strip_suffix(".html")?.split_once('.')?;
    KINDS.contains(&kind).then_some((kind, item))
}

/// Kind and name of the members that an item has by itself.
fn members(page: &str) -> impl Iterator<Item = (&str, &str)> {
    let ends = IMPLEMENTATIONS.iter().filter_map(|start| page.find(start));
    let own = &page[..ends.min().unwrap_or(page.len())];
    let anchors = own.split("id=\"").skip(1);
    anchors.filter_map(|anchor| {
        let (id, _) = anchor.split_once('"')?;
        let (kind, name) = id.split_once('.')?;
        // A name with a number is that of the same member in another implementation.
        let is_member = MEMBERS.contains(&kind) && !name.contains(['.', '-']);
        is_member.then_some((kind, name))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_name_items() {
        assert_eq!(item_of_page("struct.Aabb.html"), Some(("struct", "Aabb")));
        assert_eq!(item_of_page("index.html"), None, "a module");
        assert_eq!(item_of_page("sidebar-items.js"), None, "no page");
    }

    #[test]
    fn members_of_implemented_traits_do_not_count() {
        let page = "<section id=\"structfield.min\"><section id=\"method.new\">\
                    <section id=\"method.new-1\"><h2 id=\"trait-implementations\">\
                    <section id=\"method.clone\">";
        let found: Vec<_> = members(page).collect();
        assert_eq!(found, [("structfield", "min"), ("method", "new")]);
    }
}
