use light_scene::glam::Affine3A;
use light_scene::{Mesh, Placement, Prototype, Scene};

use super::WorldError;
use crate::Place;

/// Objects of no more triangles are copied: those take no more memory than a placement does, and rays find them sooner.
const FEW: usize = 2;

/// Triangles of shining objects that may be copied, about 8 GB of them.
const MOST_COPIES: usize = 1 << 25;

/// A scene's objects, sorted into what has to be copied and what need not be.
#[derive(Debug, Default)]
pub(super) struct Objects {
    /// What stands where it is stored.
    pub(super) copies: Vec<Mesh>,
    /// What stands in several places.
    pub(super) placed: Vec<PlacedObject>,
}

/// Meshes of an object that are stored once, and where it stands.
#[derive(Debug)]
pub(super) struct PlacedObject {
    pub(super) meshes: Vec<Mesh>,
    pub(super) places: Vec<Place>,
}

impl Objects {
    /// Takes the objects out of `scene`. Each triangle that shines is a light of its own, so that shining meshes are copied; so is what
    /// stands in one place only, or is small.
    pub(super) fn take(scene: &mut Scene) -> Result<Self, WorldError> {
        let mut places: Vec<Vec<Affine3A>> = vec![Vec::new(); scene.prototypes.len()];
        for Placement { prototype, place } in core::mem::take(&mut scene.placements) {
            places[prototype.0 as usize].push(place);
        }
        let prototypes = core::mem::take(&mut scene.prototypes);
        let mut objects = Self::default();
        let mut left = MOST_COPIES;
        for (Prototype { name, meshes }, places) in prototypes.into_iter().zip(places) {
            let (mut copied, mut placed): (Vec<Mesh>, Vec<Mesh>) =
                meshes.into_iter().partition(|mesh| scene.shines(mesh));
            let shining = places.len().saturating_mul(triangle_count(&copied));
            left = left
                .checked_sub(shining)
                .ok_or_else(|| WorldError::Copies {
                    name: name.clone(),
                    most: MOST_COPIES,
                })?;
            if places.len() < 2 || triangle_count(&placed) <= FEW {
                copied.append(&mut placed);
            }
            let copies = places
                .iter()
                .flat_map(|place| copied.iter().map(|mesh| mesh.transformed(place)));
            objects.copies.extend(copies);
            if !placed.is_empty() {
                let places: Option<_> = places.into_iter().map(Place::new).collect();
                let places = places.ok_or(WorldError::Place { name })?;
                objects.placed.push(PlacedObject {
                    meshes: placed,
                    places,
                });
            }
        }
        Ok(objects)
    }
}

fn triangle_count(meshes: &[Mesh]) -> usize {
    meshes.iter().map(|mesh| mesh.indices.len()).sum()
}
