use std::collections::HashMap;

use super::uv_sets::UvSets;
use crate::MaterialId;

/// The materials so far, by their positions in the document.
#[derive(Debug, Default)]
pub(super) struct Materials {
    pub(super) known: HashMap<usize, KnownMaterial>,
    pub(super) default: Option<MaterialId>,
}

/// A material, and what it needs of a mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct KnownMaterial {
    pub(super) id: MaterialId,
    pub(super) uv_sets: UvSets,
    /// Whether it has a normal map.
    pub(super) uses_tangents: bool,
    /// Whether it may let rays pass by its alpha.
    pub(super) uses_alpha: bool,
}
