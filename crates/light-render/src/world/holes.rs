use core::ops::Range;

use light_scene::{Alpha, Material};
use lights::bounds::LightId;
use lights::glam::Vec2;

use super::{World, WorldMesh};
use crate::{PrimitiveId, Ray, sobol};

impl World {
    /// Whether `ray` meets a triangle at a place of it, or passes through a hole.
    ///
    /// A surface that is partly there is met by its share of the rays, chosen by a hash of ray and triangle: the same ray always
    /// gets the same answer.
    pub(super) fn is_there(&self, ray: &Ray, triangle: PrimitiveId, barycentric: Vec2) -> bool {
        let (mesh, indices, weights) = self.spot(triangle, barycentric);
        let Some(Alpha { share, cutoff }) = &self.materials[mesh.material].alpha else {
            return true;
        };
        let share = self.color(share, mesh.uv(indices, weights)).x;
        match cutoff {
            Some(cutoff) => share >= *cutoff,
            None => share >= 1.0 || chance(ray, triangle) < share,
        }
    }

    /// Whether the light is a surface with holes: it gives light as if it had none, so that not all of it is found by rays.
    #[inline]
    pub(crate) fn has_holes(&self, LightId(id): LightId) -> bool {
        self.holed_lights.iter().any(|ids| ids.contains(&id))
    }
}

/// The ids of the lights whose surfaces have holes.
pub(super) fn holed_lights(meshes: &[WorldMesh], materials: &[Material]) -> Vec<Range<u32>> {
    let ids = |mesh: &WorldMesh| {
        let LightId(first) = mesh.first_light?;
        materials[mesh.material].alpha?;
        Some(first..first + u32::try_from(mesh.indices.len()).ok()?)
    };
    meshes.iter().filter_map(ids).collect()
}

/// A number in `[0, 1)` that ray and triangle decide.
fn chance(ray: &Ray, triangle: PrimitiveId) -> f32 {
    let parts = [ray.origin, ray.direction].map(|v| v.to_array());
    let bits = parts.as_flattened().iter().map(|x| x.to_bits());
    let placement = triangle.placement().map_or(0, sobol::hash);
    let hash = bits.fold(triangle.number() ^ placement, |hash, bits| {
        sobol::hash(hash.rotate_left(9) ^ bits)
    });
    (hash >> 8) as f32 / (1u32 << 24) as f32
}
