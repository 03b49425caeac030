use std::collections::HashMap;

use crate::MaterialId;

/// The materials so far, by their positions in the document, and which texture coordinates each
/// uses.
#[derive(Debug, Default)]
pub(super) struct Materials {
    pub(super) known: HashMap<usize, (MaterialId, usize)>,
    pub(super) default: Option<MaterialId>,
}
