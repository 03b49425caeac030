//! A JSON document that records which members were read.

use core::cell::RefCell;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

use serde_json::{Error, Value};

use crate::text::{shown, without_mark};
use crate::{Diagnostic, Location};

/// The members of a document that are lists, whether something refers to them or not.
const LISTS: [&str; 13] = [
    "accessors",
    "animations",
    "buffers",
    "bufferViews",
    "cameras",
    "images",
    "materials",
    "meshes",
    "nodes",
    "samplers",
    "scenes",
    "skins",
    "textures",
];

/// A document.
#[derive(Debug)]
pub(super) struct Document {
    path: PathBuf,
    pub(super) root: Value,
    /// The addresses of the members that were read.
    pub(super) visited: RefCell<HashSet<*const Value>>,
}

impl Document {
    pub(super) fn parse(path: &Path, json: &[u8]) -> Result<Self, Diagnostic> {
        let root = serde_json::from_slice(without_mark(json));
        let root = root.map_err(|error| no_document(path, json, &error))?;
        refuse_other_lists(path, &root)?;
        Ok(Self {
            path: path.to_path_buf(),
            root,
            visited: RefCell::default(),
        })
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }
}

/// Why `json` is no document.
fn no_document(path: &Path, json: &[u8], error: &Error) -> Diagnostic {
    if json.is_empty() {
        return Diagnostic::file(path, "expected a document of JSON, found an empty file");
    }
    let line = Location::Line(error.line());
    if error.is_eof() {
        let message = "expected the rest of the document of JSON, found the end of the file";
        return Diagnostic::at(path, line, message);
    }
    // The location stands in front, as in every message.
    let words = error.to_string();
    let words = words.split(" at line ").next().unwrap_or_default();
    let message = format!(
        "column {}: expected a document of JSON: {words}",
        error.column()
    );
    Diagnostic::at(path, line, message)
}

/// Refuses a document with something else where a list belongs.
fn refuse_other_lists(path: &Path, root: &Value) -> Result<(), Diagnostic> {
    for name in LISTS {
        if let Some(value) = root.get(name).filter(|value| !value.is_array()) {
            let message = format!("{name}: expected a list, found {}", found(value));
            return Err(Diagnostic::file(path, message));
        }
    }
    Ok(())
}

/// What a value is, for a message.
pub(super) fn found(value: &Value) -> String {
    match value {
        Value::Object(_) => "an object".to_owned(),
        Value::Array(_) => "a list".to_owned(),
        other => shown(&other.to_string()),
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(crate) fn document(json: &str) -> Document {
        Document::parse(Path::new("a.gltf"), json.as_bytes()).expect("JSON")
    }

    fn error(json: &str) -> String {
        let parsed = Document::parse(Path::new("a"), json.as_bytes());
        parsed.map(|_| ()).expect_err(json).to_string()
    }

    #[test]
    fn broken_json_says_where() {
        let none = "expected a document of JSON";
        for (json, expected) in [
            ("", "a: expected a document of JSON, found an empty file"),
            (
                "{\n\"a\": [1,",
                "a:2: expected the rest of the document of JSON, found the end of the file",
            ),
            (
                "{\n\"a\":}",
                &format!("a:2: column 5: {none}: expected value"),
            ),
            (
                "{\"a\": 1,}",
                &format!("a:1: column 9: {none}: trailing comma"),
            ),
            (
                "{\"a\": 1e999}",
                &format!("a:1: column 11: {none}: number out of range"),
            ),
        ] {
            assert_eq!(error(json), expected, "{json}");
        }
    }

    #[test]
    fn lists_are_lists_also_where_nothing_refers_to_them() {
        for (json, expected) in [
            ("{\"meshes\": 5}", "a: meshes: expected a list, found 5"),
            (
                "{\"skins\": {}}",
                "a: skins: expected a list, found an object",
            ),
            ("{\"nodes\": null}", "a: nodes: expected a list, found null"),
        ] {
            assert_eq!(error(json), expected, "{json}");
        }
        document("{\"meshes\": []}");
    }
}
