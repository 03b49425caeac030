use std::collections::HashMap;

use super::uv_sets::UvSets;
use crate::{MaterialId, UvSet};

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
    /// The texture coordinates of its normal map, if it has one.
    pub(super) normal_map_uvs: Option<UvSet>,
    /// Whether it may let rays pass by its alpha.
    pub(super) uses_alpha: bool,
}
