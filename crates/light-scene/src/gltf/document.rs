//! A JSON document that records which members were read.

use core::cell::RefCell;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::Diagnostic;
use crate::text::without_mark;

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
        let root = root.map_err(|error| {
            Diagnostic::file(path, format!("expected a document of JSON: {error}"))
        })?;
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

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(crate) fn document(json: &str) -> Document {
        Document::parse(Path::new("a.gltf"), json.as_bytes()).expect("JSON")
    }

    #[test]
    fn broken_json_says_where() {
        let error = Document::parse(Path::new("a"), b"{\n\"a\":}").expect_err("no value");
        assert!(error.to_string().contains("line 2 column 5"), "{error}");
    }
}
