//! `cargo xtask rust-gpu [--write]`: the places of the core that rust-gpu does not take, against
//! the table in `docs/rust-gpu.md`.
//!
//! A scan of the sources, since the compiler of rust-gpu is not at hand: tests, comments, strings,
//! and what needs an allocator are left out.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::steps::{Outcome, StepResult, root};

const PAGE: &str = "docs/rust-gpu.md";

/// What encloses the table in the page.
const BEGIN: &str = "<!-- cargo xtask rust-gpu -->\n\n";
const END: &str = "\n<!-- end of the places -->";

/// The rooms of the core that a shader calls, below `crates`: a file, or all files of a folder.
const ROOMS: [(&str, &[&str]); 4] = [
    (
        "the tree's queries",
        &[
            "light-bvh/src/importance",
            "light-bvh/src/query",
            "light-bvh/src/cut",
            "light-bvh/src/node/child_codes.rs",
            "light-bvh/src/node/wide_node.rs",
            "light-bvh/src/node/light_emission.rs",
            "light-bvh/src/lane_math.rs",
            "light-bounds/src/context.rs",
            "light-bounds/src/sampled_light.rs",
        ],
    ),
    (
        "samplers",
        &[
            "light-samplers/src/bvh_choices.rs",
            "light-samplers/src/bvh_ref.rs",
            "light-samplers/src/first_choice.rs",
            "light-samplers/src/infinite_lights.rs",
            "light-samplers/src/infinite_lights",
            "light-samplers/src/light_sampler.rs",
            "light-samplers/src/uniform.rs",
        ],
    ),
    (
        "numbers and warps",
        &[
            "light-math/src/discrete.rs",
            "light-math/src/equal_area.rs",
            "light-math/src/float",
            "light-math/src/float.rs",
            "light-math/src/fraction.rs",
            "light-math/src/frame.rs",
            "light-math/src/octahedral.rs",
            "light-math/src/warp",
        ],
    ),
    (
        "analytic lights",
        &[
            "light-sources/src/distant.rs",
            "light-sources/src/point.rs",
            "light-sources/src/point_source.rs",
            "light-sources/src/spot.rs",
            "light-sources/src/uniform_infinite.rs",
            "light-sources/src/shape/receiver_cosine.rs",
            "light-sources/src/shape/rectangle.rs",
            "light-sources/src/shape/sphere.rs",
            "light-sources/src/shape/triangle.rs",
        ],
    ),
];

/// What rust-gpu does not take, or takes with a capability that not every device has.
const RESTRICTIONS: [(&str, Finds); 8] = [
    ("`dyn`", |code| words(code).any(|word| word == "dyn")),
    ("function pointer", |code| {
        [": fn(", "<fn(", "&fn(", "= fn("]
            .iter()
            .any(|form| code.contains(form))
    }),
    ("`static`", |code| {
        code.trim_start().starts_with("static ") || code.contains("pub static ")
    }),
    ("pointer or `unsafe`", |code| {
        code.contains("*const ") || code.contains("*mut ") || words(code).any(|w| w == "unsafe")
    }),
    ("checked multiplication", |code| {
        ["checked_mul", "saturating_mul", "overflowing_mul"]
            .iter()
            .any(|f| code.contains(f))
    }),
    ("64-bit integer", |code| {
        words(code).any(|word| word == "u64" || word == "i64" || ends_in(word, "u64"))
    }),
    ("8- or 16-bit number", |code| {
        words(code).any(|word| matches!(word, "u8" | "i8" | "u16" | "i16" | "f16"))
    }),
    ("64-bit float", |code| {
        words(code).any(|word| word == "f64" || ends_in(word, "f64"))
    }),
];

/// Whether a line of code holds what is looked for.
type Finds = fn(&str) -> bool;

/// Lines by room, restriction and file.
type Places = BTreeMap<(usize, usize, String), usize>;

/// Compares the table, or writes it.
///
/// # Errors
/// A table that differs.
pub fn rust_gpu(arguments: &[String]) -> StepResult {
    let is_written = match arguments {
        [] => false,
        [flag] if flag == "--write" => true,
        _ => return Err("usage: cargo xtask rust-gpu [--write]".into()),
    };
    let path = root().join(PAGE);
    let page = fs::read_to_string(&path).map_err(|e| format!("{PAGE}: {e}"))?;
    let (before, rest) = page.split_once(BEGIN).ok_or("no table of places")?;
    let (written, after) = rest.split_once(END).ok_or("no end of the places")?;
    let table = table(&places()?);
    if is_written {
        let page = [before, BEGIN, &table, END, after].concat();
        fs::write(&path, page).map_err(|e| format!("{PAGE}: {e}"))?;
    } else if written != table {
        let lines = table.lines().zip(written.lines());
        let other = lines.into_iter().find(|(now, then)| now != then);
        let (now, then) = other.unwrap_or(("another number of rows", ""));
        return Err(format!(
            "{PAGE}: {now}, not {then}; `cargo xtask rust-gpu --write`"
        ));
    }
    Ok(Outcome::Passed)
}

fn places() -> Result<Places, String> {
    let mut places = Places::new();
    for (room, (_, paths)) in ROOMS.iter().enumerate() {
        let mut files = Vec::new();
        for path in *paths {
            add_files(&root().join("crates").join(path), &mut files)?;
        }
        for file in files {
            let text = fs::read_to_string(&file).map_err(|e| format!("{}: {e}", file.display()))?;
            let name = file.strip_prefix(root().join("crates")).unwrap_or(&file);
            let name = name.display().to_string();
            for line in code(&text) {
                for (restriction, (_, finds)) in RESTRICTIONS.iter().enumerate() {
                    if finds(&line) {
                        *places.entry((room, restriction, name.clone())).or_default() += 1;
                    }
                }
            }
        }
    }
    Ok(places)
}

/// Adds a file, or all files of a folder but tests.
fn add_files(path: &Path, files: &mut Vec<PathBuf>) -> Result<(), String> {
    if path.is_file() {
        files.push(path.to_owned());
        return Ok(());
    }
    let folder = fs::read_dir(path).map_err(|e| format!("{}: {e}", path.display()))?;
    let mut entries: Vec<PathBuf> = folder.flatten().map(|entry| entry.path()).collect();
    entries.sort();
    for entry in entries {
        let name = entry.file_stem().unwrap_or_default().to_string_lossy();
        if !name.ends_with("tests") {
            add_files(&entry, files)?;
        }
    }
    Ok(())
}

/// The lines of code: without comments, strings, tests, and items that need an allocator.
fn code(text: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let mut all = text.lines();
    while let Some(line) = all.next() {
        let trimmed = line.trim();
        if trimmed == "#[cfg(test)]" {
            // Tests end the file.
            break;
        }
        if trimmed.starts_with("#[cfg(") && (trimmed.contains("alloc") || trimmed.contains("test"))
        {
            // The item behind it, to the line that closes it.
            let indent = line.len() - line.trim_start().len();
            for item in all.by_ref() {
                let is_at_indent = item.len() - item.trim_start().len() == indent;
                if is_at_indent && (item.ends_with('}') || item.ends_with(';')) {
                    break;
                }
            }
            continue;
        }
        if trimmed.starts_with("#[") || trimmed.starts_with("reason = ") {
            continue;
        }
        let code = line.split("//").next().unwrap_or_default();
        let outside: String = code.split('"').step_by(2).collect();
        if !outside.trim().is_empty() {
            lines.push(outside);
        }
    }
    lines
}

fn words(code: &str) -> impl Iterator<Item = &str> {
    code.split(|c: char| !(c.is_alphanumeric() || c == '_'))
}

/// Whether a word is a number with this suffix.
fn ends_in(word: &str, suffix: &str) -> bool {
    word.ends_with(suffix) && word.starts_with(|c: char| c.is_ascii_digit())
}

/// A row for each room and restriction: how many lines, and in which files.
fn table(places: &Places) -> String {
    let mut text =
        "| room | restriction | lines | files |\n| --- | --- | ---: | --- |\n".to_owned();
    for (room, (name, _)) in ROOMS.iter().enumerate() {
        for (restriction, (what, _)) in RESTRICTIONS.iter().enumerate() {
            let of = places
                .iter()
                .filter(|(key, _)| (key.0, key.1) == (room, restriction));
            let files: Vec<String> = of
                .clone()
                .map(|((_, _, file), lines)| format!("`{}` {lines}", short(file)))
                .collect();
            let lines: usize = of.map(|(_, lines)| lines).sum();
            let files = if lines == 0 {
                "none".to_owned()
            } else {
                files.join(", ")
            };
            text += &format!("| {name} | {what} | {lines} | {files} |\n");
        }
    }
    text
}

/// The name of a file without the folders that all have.
fn short(file: &str) -> String {
    file.replacen("/src/", "/", 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(line: &str) -> Vec<&'static str> {
        let finds = RESTRICTIONS.iter().filter(|(_, finds)| finds(line));
        finds.map(|(what, _)| *what).collect()
    }

    #[test]
    fn each_restriction_is_found() {
        assert_eq!(found("fn f(light: &dyn Light) {}"), ["`dyn`"], "an object");
        assert_eq!(found("let f: fn(f32) -> f32 = g;"), ["function pointer"]);
        assert_eq!(found("static TABLE: [f32; 2] = [0.0; 2];"), ["`static`"]);
        assert_eq!(found("let p = a as *const f32;"), ["pointer or `unsafe`"]);
        assert_eq!(found("a.checked_mul(b)"), ["checked multiplication"]);
        assert_eq!(found("let u = 1u64;"), ["64-bit integer"]);
        assert_eq!(found("let code: u16 = 1;"), ["8- or 16-bit number"]);
        assert_eq!(found("let x = 1.0f64;"), ["64-bit float"]);
        assert!(
            found("let x: f32 = dynamic(statics);").is_empty(),
            "nothing"
        );
    }

    #[test]
    fn the_page_lists_the_places() {
        assert_eq!(rust_gpu(&[]), Ok(Outcome::Passed), "{PAGE}");
    }

    #[test]
    fn comments_strings_and_tests_are_no_code() {
        let text = "/// An u64.\nfn f() {\n    g(\"u64\"); // u64\n}\n\n#[cfg(feature = \"alloc\")]\n\
                    fn h(u: u64) {\n    u64\n}\nfn i() {}\n#[cfg(test)]\nmod tests { u64 }\n";
        let lines = code(text);
        assert!(lines.iter().all(|line| found(line).is_empty()), "{lines:?}");
        assert!(
            lines.iter().any(|line| line.contains("fn i()")),
            "{lines:?}"
        );
    }
}
