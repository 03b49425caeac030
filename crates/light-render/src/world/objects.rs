use std::collections::HashSet;

use light_scene::glam::Affine3A;
use light_scene::{MOST_SHINING_COPIES, Mesh, Placement, Prototype, Scene, Sphere};

use super::WorldError;
use crate::Place;

/// Objects of no more triangles and spheres are copied: those take no more memory than a placement
/// does, and rays find them sooner.
const FEW: usize = 2;

/// Columns around a sphere that shines and that a place stretches, which no light is.
const COLUMNS: u16 = 64;

/// A scene's objects that need not be copied.
#[derive(Debug, Default)]
pub(super) struct Objects {
    pub(super) placed: Vec<PlacedObject>,
}

/// What an object consists of and is stored once, and where it stands.
#[derive(Debug)]
pub(super) struct PlacedObject {
    pub(super) meshes: Vec<Mesh>,
    pub(super) spheres: Vec<Sphere>,
    pub(super) places: Vec<Place>,
}

/// A part of an object.
#[derive(Debug, Default)]
struct Part {
    meshes: Vec<Mesh>,
    spheres: Vec<Sphere>,
}

impl Objects {
    /// Takes the objects out of `scene`. What shines is a light of its own in every place, so that
    /// it is copied there; so is what stands in one place only, or is small.
    pub(super) fn take(scene: &mut Scene) -> Result<Self, WorldError> {
        let mut places: Vec<Vec<Affine3A>> = vec![Vec::new(); scene.prototypes.len()];
        for Placement { prototype, place } in core::mem::take(&mut scene.placements) {
            places[prototype.0 as usize].push(place);
        }
        let prototypes = core::mem::take(&mut scene.prototypes);
        let mut objects = Self::default();
        let mut left = MOST_SHINING_COPIES;
        for (prototype, places) in prototypes.into_iter().zip(places) {
            let name = prototype.name.clone();
            let (mut copied, mut placed) = Part::shining_and_dark(prototype, scene);
            let shining = places.iter().map(|place| copied.count_at(place)).sum();
            left = left
                .checked_sub(shining)
                .ok_or_else(|| WorldError::Copies {
                    name: name.clone(),
                    most: MOST_SHINING_COPIES,
                })?;
            let dark_places = if placed.is_sparse(scene) {
                places.clone()
            } else {
                distinct(&places)
            };
            let is_small = dark_places.len() < 2 || placed.count() <= FEW;
            if is_small && placed.stays_round(&dark_places) {
                let small = core::mem::take(&mut placed);
                if dark_places.len() == places.len() {
                    copied.meshes.extend(small.meshes);
                    copied.spheres.extend(small.spheres);
                } else {
                    for place in &dark_places {
                        small.copy_to(scene, place);
                    }
                }
            }
            for place in &places {
                copied.copy_to(scene, place);
            }
            if placed.count() > 0 {
                let places: Option<_> = dark_places.into_iter().map(Place::new).collect();
                let places = places.ok_or(WorldError::Place { name })?;
                objects.placed.push(PlacedObject {
                    meshes: placed.meshes,
                    spheres: placed.spheres,
                    places,
                });
            }
        }
        Ok(objects)
    }
}

/// The places, each once: what stands twice in exactly the same place looks as if it stood there
/// once.
fn distinct(places: &[Affine3A]) -> Vec<Affine3A> {
    let mut known = HashSet::new();
    let is_new = |place: &&Affine3A| known.insert(place.to_cols_array().map(f32::to_bits));
    places.iter().filter(is_new).copied().collect()
}

impl Part {
    /// Whether some of it is there for a share of the rays only, so that two of it hide more than
    /// one.
    fn is_sparse(&self, scene: &Scene) -> bool {
        let meshes = self.meshes.iter().map(|mesh| mesh.material);
        let spheres = self.spheres.iter().map(|sphere| sphere.material);
        let mut alphas = meshes.chain(spheres).map(|id| scene.material(id).alpha);
        alphas.any(|alpha| alpha.is_some_and(|alpha| alpha.cutoff.is_none()))
    }

    fn shining_and_dark(prototype: Prototype, scene: &Scene) -> (Self, Self) {
        let Prototype {
            meshes, spheres, ..
        } = prototype;
        let meshes = meshes
            .into_iter()
            .partition(|mesh| scene.shines(mesh.material));
        let spheres = spheres
            .into_iter()
            .partition(|sphere| scene.shines(sphere.material));
        let part = |meshes, spheres| Self { meshes, spheres };
        (part(meshes.0, spheres.0), part(meshes.1, spheres.1))
    }

    /// How many triangles and spheres there are.
    fn count(&self) -> usize {
        let triangles = self.meshes.iter().map(|mesh| mesh.indices.len());
        triangles.sum::<usize>() + self.spheres.len()
    }

    /// How many there are in a place that may stretch spheres.
    fn count_at(&self, place: &Affine3A) -> usize {
        let stretched = self
            .spheres
            .iter()
            .filter(|s| s.transformed(place).is_none());
        self.count() + stretched.count() * usize::from(COLUMNS).pow(2)
    }

    /// Whether all spheres are spheres in all places.
    fn stays_round(&self, places: &[Affine3A]) -> bool {
        let mut spheres = self.spheres.iter();
        spheres.all(|s| places.iter().all(|place| s.transformed(place).is_some()))
    }

    /// Adds a copy of it to what stands in `scene` where it is stored.
    fn copy_to(&self, scene: &mut Scene, place: &Affine3A) {
        let meshes = self.meshes.iter().map(|mesh| mesh.transformed(place));
        scene.meshes.extend(meshes);
        for sphere in &self.spheres {
            match sphere.transformed(place) {
                Some(moved) => scene.spheres.push(moved),
                None => scene.meshes.push(sphere.mesh(COLUMNS).transformed(place)),
            }
        }
    }
}
