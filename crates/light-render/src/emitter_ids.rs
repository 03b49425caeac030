use lights::bounds::LightId;

/// Maps emissive meshes and quadrics to the ids of their lights.
#[derive(Debug)]
pub(crate) struct EmitterIds {
    /// For each mesh the id of its first triangle; the others follow in order. For a mesh of an
    /// object how many ids it lies behind the first of an instance.
    meshes: Box<[Option<LightId>]>,
    /// For each instance of the objects the id of its first triangle, by the position of the
    /// instance; dark instances behind the last have no entry.
    instances: Box<[Option<LightId>]>,
    /// For each sphere in world space, its id.
    quadrics: Box<[Option<LightId>]>,
}

impl EmitterIds {
    /// No ids for so many meshes and quadrics.
    pub(crate) fn new(meshes: usize, quadrics: usize) -> Self {
        Self {
            meshes: vec![None; meshes].into(),
            instances: Box::default(),
            quadrics: vec![None; quadrics].into(),
        }
    }

    /// Sets the id of the first triangle of a mesh.
    pub(crate) fn set_mesh(&mut self, mesh: usize, first: Option<LightId>) {
        self.meshes[mesh] = first;
    }

    /// Sets how many triangles of an instance come before those of a mesh of its object.
    pub(crate) fn set_mesh_of_object(&mut self, mesh: usize, before: u32) {
        self.meshes[mesh] = Some(LightId(before));
    }

    /// Sets the id of the first triangle of each instance.
    pub(crate) fn set_instances(&mut self, first: Box<[Option<LightId>]>) {
        self.instances = first;
    }

    /// Sets the id of a quadric.
    pub(crate) fn set_quadric(&mut self, quadric: usize, id: Option<LightId>) {
        self.quadrics[quadric] = id;
    }

    /// The light of triangle `index` of a mesh in world space; `None` if the mesh is not emissive.
    #[inline]
    pub(crate) fn triangle(&self, mesh: u32, index: u32) -> Option<LightId> {
        let LightId(first) = (*self.meshes.get(mesh as usize)?)?;
        Some(LightId(first + index))
    }

    /// The light of triangle `index` of a mesh of an object, in the instance at `position`; `None`
    /// if the mesh is not emissive.
    #[inline]
    pub(crate) fn triangle_in(&self, position: u32, mesh: u32, index: u32) -> Option<LightId> {
        let LightId(before) = (*self.meshes.get(mesh as usize)?)?;
        let LightId(first) = self.instance(position)?;
        Some(LightId(first + before + index))
    }

    /// The first light of the instance at `position`; `None` if it is dark.
    #[inline]
    pub(crate) fn instance(&self, position: u32) -> Option<LightId> {
        *self.instances.get(position as usize)?
    }

    /// The light of a quadric; `None` if it is not emissive, as those of prototypes.
    #[inline]
    pub(crate) fn quadric(&self, quadric: usize) -> Option<LightId> {
        *self.quadrics.get(quadric)?
    }
}
