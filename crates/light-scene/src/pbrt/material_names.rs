use std::collections::{HashMap, HashSet};

use crate::{Diagnostic, MaterialId};

/// The materials of `MakeNamedMaterial`; a file may use a material before it defines it.
#[derive(Debug, Default)]
pub(super) struct NamedMaterials {
    pub(super) by_name: HashMap<String, MaterialId>,
    /// Used but not yet defined, with the error if that does not change.
    pub(super) awaited: HashMap<String, (MaterialId, Diagnostic)>,
    pub(super) awaited_ids: HashSet<MaterialId>,
    /// Materials that have taken their surface from another one, each with the other.
    pub(super) twins: Vec<(MaterialId, MaterialId)>,
}

impl NamedMaterials {
    /// Whether the material was named and will be described later.
    pub(super) fn awaits(&self, material: MaterialId) -> bool {
        self.awaited_ids.contains(&material)
    }
}
