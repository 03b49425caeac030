use lights::bounds::LightId;
use lights::sources::{Light, LightDesc, LightSet, LightSetBuilder, LightType, Rgb, SourceId};

use crate::SceneLightsError;
use crate::emitter_ids::EmitterIds;
use crate::world_mesh::WorldMesh;

/// The lights of a scene's list.
#[derive(Debug, Default)]
pub(crate) struct ListedLights {
    /// How many there are.
    pub(crate) count: usize,
    /// Mesh lights that rays hit, with their surfaces.
    meshes: Vec<(SourceId, WorldMesh)>,
    /// All others.
    others: Vec<SourceId>,
}

impl ListedLights {
    /// Adds all of them to a set; the surfaces of mesh lights have the material with the number
    /// `material`.
    pub(crate) fn add(
        builder: &mut LightSetBuilder<Rgb>,
        lights: Vec<LightDesc<Rgb>>,
        material: usize,
    ) -> Result<Self, SceneLightsError> {
        let mut this = Self::default();
        for (number, light) in lights.into_iter().enumerate() {
            let mesh = WorldMesh::of_light(&light, material);
            let source = builder.add(light);
            let source = source.map_err(|e| SceneLightsError::light(&numbered(number), e))?;
            match mesh {
                Some(mesh) => this.meshes.push((source, mesh)),
                None => this.others.push(source),
            }
            this.count += 1;
        }
        Ok(this)
    }

    /// The number of mesh lights that rays hit.
    pub(crate) fn mesh_count(&self) -> usize {
        self.meshes.len()
    }

    /// Sets the ids in `lights`, the set that was built, of the mesh lights; their surfaces have
    /// the numbers from `first_mesh` on.
    pub(crate) fn set_ids(
        &self,
        lights: &LightSet<Rgb>,
        first_mesh: usize,
        emitters: &mut EmitterIds,
    ) {
        for (index, (source, _)) in (first_mesh..).zip(&self.meshes) {
            emitters.set_mesh(index, lights.first_id(*source));
        }
    }

    /// The ids in `lights`, the set that was built, of those that rays hit and that are no meshes.
    pub(crate) fn hit_ids(&self, lights: &LightSet<Rgb>) -> Vec<LightId> {
        let ids = self.others.iter().filter_map(|&s| lights.first_id(s));
        let is_area = |id: &LightId| {
            let light = lights.get(*id);
            light.is_some_and(|light| light.light_type() == LightType::Area)
        };
        ids.filter(is_area).collect()
    }

    /// The surfaces of the mesh lights.
    pub(crate) fn into_meshes(self) -> Vec<WorldMesh> {
        self.meshes.into_iter().map(|(_, mesh)| mesh).collect()
    }
}

/// The name of a light of the scene's list that has no name of its own.
pub(crate) fn numbered(light: usize) -> String {
    format!("light {light}")
}
