use std::collections::{HashMap, HashSet};

use super::item::Item;
use crate::Diagnostic;

/// Warnings about parts of a document: the first of each kind, with the number of parts.
#[derive(Debug, Default)]
pub(super) struct Warnings {
    first: Vec<Diagnostic>,
    by_kind: HashMap<String, Kind>,
}

#[derive(Debug)]
struct Kind {
    /// Its place among the warnings.
    place: usize,
    paths: HashSet<String>,
}

impl Warnings {
    /// Adds a warning about a part.
    pub(super) fn add(&mut self, item: &Item<'_>, message: &str) {
        let place = self.first.len();
        let kind = self
            .by_kind
            .entry(format!("{} {message}", item.kind()))
            .or_insert_with(|| Kind {
                place,
                paths: HashSet::new(),
            });
        if kind.place == place {
            self.first.push(item.error(message));
        }
        kind.paths.insert(item.path.clone());
    }

    /// All of them, in the order of their first parts.
    pub(super) fn finish(self) -> Vec<Diagnostic> {
        let mut all = self.first;
        for Kind { place, paths } in self.by_kind.into_values() {
            if paths.len() > 1 {
                let message = &mut all[place].message;
                *message = format!("{message} ({} of this kind)", paths.len());
            }
        }
        all
    }
}
