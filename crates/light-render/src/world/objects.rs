use std::collections::HashSet;

use light_scene::glam::Affine3A;
use light_scene::{Instance, MAX_EMISSIVE_COPIES, Mesh, Prototype, Quadric, Scene};

use super::WorldError;
use crate::InstanceTransform;
use crate::world_object::WorldObject;

/// Objects of at most this many triangles and quadrics are copied: copies take no more memory than
/// instances, and rays find them faster.
const FEW: usize = 2;

/// Columns of the mesh that replaces an emissive ellipsoid or part of a quadric: no light has that
/// shape.
const COLUMNS: u16 = 64;

/// The objects of a scene that are instanced rather than copied.
#[derive(Debug, Default)]
pub(super) struct Objects {
    pub(super) instanced: Vec<WorldObject>,
}

/// Meshes and quadrics of an object.
#[derive(Debug, Default)]
struct Part {
    meshes: Vec<Mesh>,
    quadrics: Vec<Quadric>,
}

impl Objects {
    /// Refuses an object with too many emissive quadrics, which are copied for every instance.
    /// Unlike [`take`](Self::take), which counts what parts and stretched ones become, it takes no
    /// time a copy.
    pub(super) fn refuse_copies(scene: &Scene) -> Result<(), WorldError> {
        let mut counts = vec![0_usize; scene.prototypes.len()];
        for instance in &scene.instances {
            counts[instance.prototype.0 as usize] += 1;
        }
        for (prototype, count) in scene.prototypes.iter().zip(counts) {
            let quadrics = prototype.quadrics.iter();
            let emissive = quadrics.filter(|quadric| scene.is_emissive(quadric.material));
            if emissive.count().saturating_mul(count) > MAX_EMISSIVE_COPIES {
                return Err(too_many_copies(&prototype.name));
            }
        }
        Ok(())
    }

    /// Takes the objects out of `scene`. Emissive quadrics are copied for every instance, because
    /// each is a light of its own that takes no more memory than a transform; objects with a single
    /// instance and small ones are copied too, and emissive meshes as those are.
    pub(super) fn take(scene: &mut Scene) -> Result<Self, WorldError> {
        let mut transforms: Vec<Vec<Affine3A>> = vec![Vec::new(); scene.prototypes.len()];
        for Instance {
            prototype,
            transform,
        } in core::mem::take(&mut scene.instances)
        {
            transforms[prototype.0 as usize].push(transform);
        }
        let prototypes = core::mem::take(&mut scene.prototypes);
        let mut objects = Self::default();
        let mut left = MAX_EMISSIVE_COPIES;
        for (prototype, transforms) in prototypes.into_iter().zip(transforms) {
            let name = prototype.name.clone();
            let (mut copied, mut instanced) = Part::split_emissive(prototype, scene);
            let lamps = copied.take_lamps(&transforms);
            let emissive = transforms
                .iter()
                .map(|transform| copied.count_under(transform))
                .sum();
            left = left
                .checked_sub(emissive)
                .ok_or_else(|| too_many_copies(&name))?;
            // Lights add up where they coincide.
            let all_count = !lamps.is_empty() || instanced.has_fractional_opacity(scene);
            instanced.meshes.extend(lamps);
            let shared_transforms = if all_count {
                transforms.clone()
            } else {
                distinct(&transforms)
            };
            let is_small = shared_transforms.len() < 2 || instanced.count() <= FEW;
            if is_small && instanced.quadrics_stay(&shared_transforms) {
                let small = core::mem::take(&mut instanced);
                if shared_transforms.len() == transforms.len() {
                    copied.meshes.extend(small.meshes);
                    copied.quadrics.extend(small.quadrics);
                } else {
                    for transform in &shared_transforms {
                        small.copy_to(scene, transform);
                    }
                }
            }
            for transform in &transforms {
                copied.copy_to(scene, transform);
            }
            if instanced.count() > 0 {
                let transforms: Option<_> = shared_transforms
                    .into_iter()
                    .map(InstanceTransform::new)
                    .collect();
                let transforms = transforms.ok_or(WorldError::Instance { name })?;
                let Part { meshes, quadrics } = instanced;
                objects
                    .instanced
                    .push(WorldObject::new(meshes, quadrics, transforms)?);
            }
        }
        tessellate_emissive_parts(scene);
        Ok(objects)
    }
}

fn too_many_copies(name: &str) -> WorldError {
    WorldError::Copies {
        name: name.into(),
        most: MAX_EMISSIVE_COPIES,
    }
}

/// Replaces the parts of quadrics that emit by meshes.
fn tessellate_emissive_parts(scene: &mut Scene) {
    let quadrics = core::mem::take(&mut scene.quadrics);
    let is_mesh = |q: &Quadric| q.part.is_some() && scene.is_emissive(q.material);
    let (parts, others): (Vec<_>, Vec<_>) = quadrics.into_iter().partition(is_mesh);
    scene.quadrics = others;
    scene
        .meshes
        .extend(parts.iter().map(|part| part.mesh(COLUMNS)));
}

/// The transforms without duplicates: opaque instances that coincide look like one.
fn distinct(transforms: &[Affine3A]) -> Vec<Affine3A> {
    let mut known = HashSet::new();
    let is_new = |transform: &&Affine3A| known.insert(transform.to_cols_array().map(f32::to_bits));
    transforms.iter().filter(is_new).copied().collect()
}

impl Part {
    /// Whether a material has fractional opacity: coincident copies of such a part hide more than
    /// one copy.
    fn has_fractional_opacity(&self, scene: &Scene) -> bool {
        let meshes = self.meshes.iter().map(|mesh| mesh.material);
        let quadrics = self.quadrics.iter().map(|sphere| sphere.material);
        let mut alphas = meshes.chain(quadrics).map(|id| scene.material(id).alpha);
        alphas.any(|alpha| alpha.is_some_and(|alpha| alpha.cutoff.is_none()))
    }

    fn split_emissive(prototype: Prototype, scene: &Scene) -> (Self, Self) {
        let Prototype {
            meshes, quadrics, ..
        } = prototype;
        let meshes = meshes
            .into_iter()
            .partition(|mesh| scene.is_emissive(mesh.material));
        let quadrics = quadrics
            .into_iter()
            .partition(|sphere| scene.is_emissive(sphere.material));
        let part = |meshes, quadrics| Self { meshes, quadrics };
        (part(meshes.0, quadrics.0), part(meshes.1, quadrics.1))
    }

    /// Takes out the emissive meshes that instances share; none where copies take no more memory,
    /// or a transform makes the object flat.
    fn take_lamps(&mut self, transforms: &[Affine3A]) -> Vec<Mesh> {
        let triangles = self.meshes.iter().map(|mesh| mesh.indices.len());
        let is_small = transforms.len() < 2 || triangles.sum::<usize>() <= FEW;
        let is_solid = |transform: &Affine3A| InstanceTransform::new(*transform).is_some();
        if is_small || !transforms.iter().all(is_solid) {
            return Vec::new();
        }
        core::mem::take(&mut self.meshes)
    }

    /// The number of triangles and quadrics.
    fn count(&self) -> usize {
        let triangles = self.meshes.iter().map(|mesh| mesh.indices.len());
        triangles.sum::<usize>() + self.quadrics.len()
    }

    /// The number of triangles and quadrics of an emissive copy; a part, or one that is stretched,
    /// counts as its mesh.
    fn count_under(&self, transform: &Affine3A) -> usize {
        let tessellated = self
            .quadrics
            .iter()
            .filter(|q| q.part.is_some() || q.transformed(transform).is_none());
        self.count() + tessellated.count() * usize::from(COLUMNS).pow(2)
    }

    /// Whether all quadrics stay quadrics under all transforms.
    fn quadrics_stay(&self, transforms: &[Affine3A]) -> bool {
        let mut quadrics = self.quadrics.iter();
        quadrics.all(|s| {
            transforms
                .iter()
                .all(|transform| s.transformed(transform).is_some())
        })
    }

    /// Adds a copy to the world space geometry of `scene`.
    fn copy_to(&self, scene: &mut Scene, transform: &Affine3A) {
        let meshes = self.meshes.iter().map(|mesh| mesh.transformed(transform));
        scene.meshes.extend(meshes);
        for sphere in &self.quadrics {
            match sphere.transformed(transform) {
                Some(moved) => scene.quadrics.push(moved),
                None => scene
                    .meshes
                    .push(sphere.mesh(COLUMNS).transformed(transform)),
            }
        }
    }
}
