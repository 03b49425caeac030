//! A JSON document that remembers what was asked for.

use alloc::collections::BTreeSet;
use core::cell::RefCell;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::item::{Item, joined};
use crate::Diagnostic;

/// Members that say nothing about light: nobody has to ask for them. Filters are those of rasterisers.
const SAYS_NOTHING: [&str; 8] = [
    "name",
    "extras",
    "generator",
    "copyright",
    "minVersion",
    "min",
    "max",
    "minFilter",
];

/// A document.
#[derive(Debug)]
pub(super) struct Document {
    path: PathBuf,
    root: Value,
    /// The addresses of what was asked for.
    asked: RefCell<HashSet<*const Value>>,
}

impl Document {
    pub(super) fn parse(path: &Path, json: &[u8]) -> Result<Self, Diagnostic> {
        let root = serde_json::from_slice(json);
        let root = root.map_err(|error| {
            Diagnostic::file(path, format!("expected a document of JSON: {error}"))
        })?;
        Ok(Self {
            path: path.to_path_buf(),
            root,
            asked: RefCell::default(),
        })
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn root(&self) -> Item<'_> {
        Item {
            document: self,
            value: &self.root,
            path: String::new(),
        }
    }

    /// What nobody asked for: the first of each kind, places in lists aside.
    pub(super) fn unasked(&self) -> Vec<Item<'_>> {
        let mut unasked = Unasked {
            asked: &self.asked.borrow(),
            kinds: BTreeSet::new(),
            found: Vec::new(),
        };
        unasked.walk(self.root());
        unasked.found
    }

    /// A part that somebody asks for.
    pub(super) fn ask<'a>(&'a self, value: &'a Value, path: String) -> Item<'a> {
        self.asked.borrow_mut().insert(core::ptr::from_ref(value));
        Item {
            document: self,
            value,
            path,
        }
    }
}

struct Unasked<'a, 'b> {
    asked: &'b HashSet<*const Value>,
    kinds: BTreeSet<String>,
    found: Vec<Item<'a>>,
}

impl<'a> Unasked<'a, '_> {
    fn walk(&mut self, item: Item<'a>) {
        match item.value {
            Value::Object(members) => {
                for (name, value) in members {
                    if !SAYS_NOTHING.contains(&name.as_str()) {
                        self.look(&item, value, joined(&item.path, name));
                    }
                }
            }
            Value::Array(elements) => {
                for (index, value) in elements.iter().enumerate() {
                    // Numbers were read with their list.
                    if value.is_object() {
                        self.look(&item, value, format!("{}[{index}]", item.path));
                    }
                }
            }
            _ => {}
        }
    }

    fn look(&mut self, parent: &Item<'a>, value: &'a Value, path: String) {
        let item = Item {
            document: parent.document,
            value,
            path,
        };
        // Who does not know an extension does not ask for its list either.
        let is_list_of_extensions = item.path.ends_with("extensions");
        if is_list_of_extensions || self.asked.contains(&core::ptr::from_ref(value)) {
            self.walk(item);
        } else if self.kinds.insert(item.kind()) {
            self.found.push(item);
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(crate) fn document(json: &str) -> Document {
        Document::parse(Path::new("a.gltf"), json.as_bytes()).expect("JSON")
    }

    #[test]
    fn what_nobody_asked_for_is_named_once_a_kind() {
        let document = document(
            r#"{"a": [{"x": 1, "y": 2}, {"x": 1, "y": {"z": 0}}], "b": 0, "extras": 1, "c": {"d": 1},
            "extensions": {"E": {"f": 1}}}"#,
        );
        for item in document.root().list("a").expect("a list") {
            item.number_or("x", 0.0).expect("a number");
        }
        let unasked = document.unasked();
        let paths: Vec<_> = unasked.iter().map(|item| item.path.as_str()).collect();
        let expected = ["a[0].y", "b", "c", "extensions.E"];
        assert_eq!(paths, expected, "the first of each kind");
    }

    #[test]
    fn broken_json_says_where() {
        let error = Document::parse(Path::new("a"), b"{\n\"a\":}").expect_err("no value");
        assert!(error.to_string().contains("line 2 column 5"), "{error}");
    }
}
