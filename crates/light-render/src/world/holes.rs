use core::ops::Range;

use light_scene::{Alpha, Material};
use lights::bounds::LightId;
use lights::glam::Vec2;

use super::{World, WorldMesh, WorldSphere};
use crate::{PrimitiveId, Ray, sobol};

impl World {
    /// Whether `ray` meets a primitive at a place of it, or passes through a hole.
    ///
    /// A surface that is partly there is met by its share of the rays, chosen by a hash of ray and primitive: the same ray always
    /// gets the same answer. A sphere, which it may meet twice, is asked about each place for itself.
    pub(super) fn is_there(&self, ray: &Ray, primitive: PrimitiveId, place: Vec2) -> bool {
        let (_, material) = self.material(primitive);
        let Some(Alpha { share, cutoff }) = &material.alpha else {
            return true;
        };
        let share = self.color(share, self.uv(primitive, place)).x;
        let place = if self.is_sphere(primitive) {
            place
        } else {
            Vec2::ZERO
        };
        match cutoff {
            Some(cutoff) => share >= *cutoff,
            None => share >= 1.0 || chance(ray, primitive, place) < share,
        }
    }

    /// Whether the light is a surface with holes: it gives light as if it had none, so that not all of it is found by rays.
    #[inline]
    pub(crate) fn has_holes(&self, LightId(id): LightId) -> bool {
        self.holed_lights.iter().any(|ids| ids.contains(&id))
    }
}

/// The ids of the lights whose surfaces have holes.
pub(super) fn holed_lights(
    meshes: &[WorldMesh],
    spheres: &[WorldSphere],
    materials: &[Material],
) -> Vec<Range<u32>> {
    let ids = |mesh: &WorldMesh| {
        let LightId(first) = mesh.first_light?;
        materials[mesh.material].alpha?;
        Some(first..first + u32::try_from(mesh.indices.len()).ok()?)
    };
    let id = |sphere: &WorldSphere| {
        let LightId(id) = sphere.light?;
        materials[sphere.material].alpha?;
        Some(id..id + 1)
    };
    let spheres = spheres.iter().filter_map(id);
    meshes.iter().filter_map(ids).chain(spheres).collect()
}

/// A number in `[0, 1)` that ray, primitive and place decide.
fn chance(ray: &Ray, primitive: PrimitiveId, place: Vec2) -> f32 {
    let parts = [ray.origin, ray.direction].map(|v| v.to_array());
    let bits = parts.as_flattened().iter().map(|x| x.to_bits());
    let placement = primitive.placement().map_or(0, sobol::hash);
    let start = primitive.number() ^ placement ^ place_bits(place);
    let hash = bits.fold(start, |hash, bits| sobol::hash(hash.rotate_left(9) ^ bits));
    (hash >> 8) as f32 / (1u32 << 24) as f32
}

/// Bits of a place; those of the origin are 0.
fn place_bits(Vec2 { x, y }: Vec2) -> u32 {
    x.to_bits().rotate_left(16) ^ y.to_bits()
}
