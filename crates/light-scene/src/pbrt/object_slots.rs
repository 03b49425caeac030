use std::collections::HashMap;

use super::file_loc::FileLoc;
use crate::emissive_copies::{EmissiveCopies, EmissiveCount};
use crate::text::shown;
use crate::{Diagnostic, Prototype, PrototypeId};

/// Objects of `ObjectBegin`, by the names that `ObjectInstance` uses; a file may use an object
/// before it defines it.
#[derive(Debug, Default)]
pub(super) struct Objects {
    pub(super) by_name: HashMap<String, PrototypeId>,
    pub(super) slots: Vec<ObjectSlot>,
    pub(super) copies: EmissiveCopies,
    /// The one that is being defined.
    pub(super) open: Option<OpenObject>,
}

#[derive(Debug)]
pub(super) struct ObjectSlot {
    /// The error if it is never defined.
    pub(super) unknown: Diagnostic,
    pub(super) prototype: Option<Prototype>,
    /// Its emissive triangles and quadrics, once it is defined.
    pub(super) emissive: EmissiveCount,
    /// The number of its instances so far.
    pub(super) instances: usize,
}

/// An object between `ObjectBegin` and `ObjectEnd`.
#[derive(Debug)]
pub(super) struct OpenObject {
    pub(super) id: PrototypeId,
    pub(super) prototype: Prototype,
    /// The number of saved states, its own included.
    pub(super) depth: usize,
}

impl Objects {
    /// The id of the object with this name, defined or not.
    pub(super) fn id(&mut self, at: FileLoc<'_>, name: &str) -> PrototypeId {
        if let Some(&id) = self.by_name.get(name) {
            return id;
        }
        let id = self.add(at, name, None);
        self.by_name.insert(name.to_owned(), id);
        id
    }

    /// Adds an object to be defined, or one that is.
    pub(super) fn add(
        &mut self,
        at: FileLoc<'_>,
        name: &str,
        prototype: Option<Prototype>,
    ) -> PrototypeId {
        let id = u32::try_from(self.slots.len()).expect("fewer than 2^32 objects");
        let message = format!("expected an object's name, found \"{}\"", shown(name));
        self.slots.push(ObjectSlot {
            unknown: at.diagnostic(message),
            prototype,
            emissive: EmissiveCount::default(),
            instances: 0,
        });
        PrototypeId(id)
    }
}
