use light_scene::Material;
use lights::bounds::LightId;
use lights::sources::{LightSet, LightSetBuilder, Rgb, SourceId};

use crate::SceneLightsError;
use crate::emitter_ids::EmitterIds;
use crate::surface_emission::{AlphaMaskedLights, DescribedSurface, Textures};
use crate::world_mesh::WorldMesh;
use crate::world_quadric::WorldQuadric;

/// The lights of emissive meshes and quadrics in world space.
#[derive(Debug, Default)]
pub(crate) struct SurfaceLights {
    pub(crate) meshes: Vec<EmissiveSurface>,
    pub(crate) quadrics: Vec<EmissiveSurface>,
}

/// A mesh or a quadric that emits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EmissiveSurface {
    /// Its place among all meshes, or all quadrics.
    pub(crate) index: usize,
    source: SourceId,
    is_masked: bool,
}

impl SurfaceLights {
    /// Adds the lights of all emissive meshes to a set, then those of all emissive quadrics.
    pub(crate) fn add(
        builder: &mut LightSetBuilder<Rgb>,
        (meshes, quadrics): (&[WorldMesh], &[WorldQuadric]),
        materials: &[Material],
        textures: &mut Textures<'_>,
    ) -> Result<Self, SceneLightsError> {
        let mut this = Self::default();
        for (index, mesh) in meshes.iter().enumerate() {
            let material = &materials[mesh.material];
            if let Some(described) = textures.mesh_light(mesh, material) {
                let surface = EmissiveSurface::add(builder, index, described, material)?;
                this.meshes.push(surface);
            }
        }
        for (index, quadric) in quadrics.iter().enumerate() {
            let material = &materials[quadric.material()];
            if let Some(described) = textures.quadric_light(quadric, material) {
                let surface = EmissiveSurface::add(builder, index, described, material)?;
                this.quadrics.push(surface);
            }
        }
        Ok(this)
    }

    /// Sets the ids in `lights`, the set that was built, of all emissive meshes and quadrics, and
    /// adds those with an alpha mask to `masked`.
    pub(crate) fn set_ids(
        &self,
        lights: &LightSet<Rgb>,
        (meshes, quadrics): (&[WorldMesh], &[WorldQuadric]),
        emitters: &mut EmitterIds,
        masked: &mut Vec<AlphaMaskedLights>,
    ) {
        for surface in &self.meshes {
            let mesh = &meshes[surface.index];
            let first = lights.first_id(surface.source);
            emitters.set_mesh(surface.index, first);
            let count = u32::try_from(mesh.indices.len()).unwrap_or(u32::MAX);
            masked.extend(surface.masked(first, count, mesh.material));
        }
        for surface in &self.quadrics {
            let id = lights.first_id(surface.source);
            emitters.set_quadric(surface.index, id);
            masked.extend(surface.masked(id, 1, quadrics[surface.index].material()));
        }
    }
}

impl EmissiveSurface {
    /// Adds the light of the surface at `index`, of this `material`, to a set.
    fn add(
        builder: &mut LightSetBuilder<Rgb>,
        index: usize,
        (desc, is_masked): DescribedSurface,
        material: &Material,
    ) -> Result<Self, SceneLightsError> {
        let source = builder.add(desc);
        let source = source.map_err(|e| SceneLightsError::light(&material.name, e))?;
        Ok(Self {
            index,
            source,
            is_masked,
        })
    }

    /// Its lights, so many from `first` on, if they have an alpha mask.
    fn masked(
        &self,
        first: Option<LightId>,
        count: u32,
        material: usize,
    ) -> Option<AlphaMaskedLights> {
        let LightId(first) = first.filter(|_| self.is_masked)?;
        let ids = first..first + count;
        Some(AlphaMaskedLights { ids, material })
    }
}
