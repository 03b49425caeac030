use lights::bounds::LightId;

/// Maps emissive meshes and quadrics to the ids of their lights.
#[derive(Debug)]
pub(crate) struct EmitterIds {
    /// For each mesh in world space, the id of its first triangle; the others follow in order.
    meshes: Box<[Option<LightId>]>,
    /// For each sphere in world space, its id.
    quadrics: Box<[Option<LightId>]>,
}

impl EmitterIds {
    /// No ids for so many meshes and quadrics.
    pub(crate) fn new(meshes: usize, quadrics: usize) -> Self {
        Self {
            meshes: vec![None; meshes].into(),
            quadrics: vec![None; quadrics].into(),
        }
    }

    /// Sets the id of the first triangle of a mesh.
    pub(crate) fn set_mesh(&mut self, mesh: usize, first: Option<LightId>) {
        self.meshes[mesh] = first;
    }

    /// Sets the id of a quadric.
    pub(crate) fn set_quadric(&mut self, quadric: usize, id: Option<LightId>) {
        self.quadrics[quadric] = id;
    }

    /// The light of triangle `index` of a mesh; `None` if the mesh is not emissive, as those of
    /// prototypes.
    #[inline]
    pub(crate) fn triangle(&self, mesh: u32, index: u32) -> Option<LightId> {
        let LightId(first) = (*self.meshes.get(mesh as usize)?)?;
        Some(LightId(first + index))
    }

    /// The light of a quadric; `None` if it is not emissive, as those of prototypes.
    #[inline]
    pub(crate) fn quadric(&self, quadric: usize) -> Option<LightId> {
        *self.quadrics.get(quadric)?
    }
}
