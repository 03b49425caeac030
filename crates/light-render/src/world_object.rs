use light_scene::{Mesh, Quadric};

use crate::world_mesh::WorldMesh;
use crate::world_quadric::WorldQuadric;
use crate::{InstanceTransform, WorldError};

/// An object that is stored once in coordinates of its own, with the transforms of its instances.
#[derive(Debug)]
pub(crate) struct WorldObject {
    pub(crate) meshes: Vec<WorldMesh>,
    pub(crate) quadrics: Vec<WorldQuadric>,
    pub(crate) transforms: Vec<InstanceTransform>,
}

impl WorldObject {
    /// The object of these parts.
    ///
    /// # Errors
    /// When a quadric is none.
    pub(crate) fn new(
        meshes: Vec<Mesh>,
        quadrics: Vec<Quadric>,
        transforms: Vec<InstanceTransform>,
    ) -> Result<Self, WorldError> {
        let quadrics = quadrics.into_iter().map(WorldQuadric::try_from);
        Ok(Self {
            meshes: meshes.into_iter().map(WorldMesh::from).collect(),
            quadrics: quadrics.collect::<Result<_, _>>()?,
            transforms,
        })
    }
}
