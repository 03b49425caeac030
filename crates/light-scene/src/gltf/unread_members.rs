//! The members of a document that were not read.

use std::collections::HashSet;

use serde_json::Value;

use super::document::Document;
use super::item::{Item, joined};

/// Members without effect on light, which need not be read. Filters are those of rasterisers.
const SAYS_NOTHING: [&str; 9] = [
    "name",
    "extras",
    "generator",
    "copyright",
    "minVersion",
    "min",
    "max",
    "minFilter",
    "target",
];

impl Document {
    /// The members that were not read.
    pub(super) fn unvisited(&self) -> Vec<Item<'_>> {
        let mut unvisited = Unvisited {
            visited: &self.visited.borrow(),
            found: Vec::new(),
        };
        unvisited.walk(self.root());
        unvisited.found
    }
}

struct Unvisited<'a, 'b> {
    visited: &'b HashSet<*const Value>,
    found: Vec<Item<'a>>,
}

impl<'a> Unvisited<'a, '_> {
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
        // A list of extensions is not a member of its own.
        let is_list_of_extensions = item.path.ends_with("extensions");
        if is_list_of_extensions || self.visited.contains(&core::ptr::from_ref(value)) {
            self.walk(item);
        } else {
            self.found.push(item);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::gltf::document::tests::document;

    #[test]
    fn what_nobody_asked_for_is_named() {
        let document = document(
            r#"{"a": [{"x": 1, "y": 2}, {"x": 1, "y": {"z": 0}}], "b": 0, "extras": 1,
            "c": {"d": 1},
            "extensions": {"E": {"f": 1}}}"#,
        );
        for item in document.root().list("a").expect("a list") {
            item.number_or("x", 0.0).expect("a number");
        }
        let unvisited = document.unvisited();
        let paths: Vec<_> = unvisited.iter().map(|item| item.path.as_str()).collect();
        let expected = ["a[0].y", "a[1].y", "b", "c", "extensions.E"];
        assert_eq!(paths, expected, "each of them, and nothing below");
    }
}
