use std::collections::HashMap;

use super::at::At;
use crate::shining_copies::ShiningCopies;
use crate::text::shown;
use crate::{Diagnostic, Prototype, PrototypeId};

/// What `ObjectBegin` describes and `ObjectInstance` places; files may place an object before they
/// describe it.
#[derive(Debug, Default)]
pub(super) struct Objects {
    pub(super) by_name: HashMap<String, PrototypeId>,
    pub(super) slots: Vec<ObjectSlot>,
    pub(super) copies: ShiningCopies,
    /// The one that is being described.
    pub(super) open: Option<OpenObject>,
}

#[derive(Debug)]
pub(super) struct ObjectSlot {
    /// What to say if nobody describes it.
    pub(super) unknown: Diagnostic,
    pub(super) prototype: Option<Prototype>,
    /// How many triangles and spheres of it shine, once it is described.
    pub(super) shining: usize,
    /// How often it was placed before that.
    pub(super) places: usize,
}

/// An object between `ObjectBegin` and `ObjectEnd`.
#[derive(Debug)]
pub(super) struct OpenObject {
    pub(super) id: PrototypeId,
    pub(super) prototype: Prototype,
    /// How many states are saved, its own included.
    pub(super) depth: usize,
}

impl Objects {
    /// The id of the object with this name, described or not.
    pub(super) fn id(&mut self, at: At<'_>, name: &str) -> PrototypeId {
        if let Some(&id) = self.by_name.get(name) {
            return id;
        }
        let id = u32::try_from(self.slots.len()).expect("fewer than 2^32 objects");
        self.by_name.insert(name.to_owned(), PrototypeId(id));
        let message = format!("expected an object's name, found \"{}\"", shown(name));
        self.slots.push(ObjectSlot {
            unknown: at.diagnostic(message),
            prototype: None,
            shining: 0,
            places: 0,
        });
        PrototypeId(id)
    }
}
