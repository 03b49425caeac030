use core::ops::Range;

use lights::bounds::{InfiniteBounds, LightExtent, LightId};
use lights::bvh::{InstancedLightBvh, LightPrototype, Placement};
use lights::glam::{Affine3A, Vec3};
use lights::samplers::InstancedBvhLightSampler;
use lights::sources::{Light, LightSet, MeshPrototypeId, Rgb};

use crate::sampler_memory::check_memory;
use crate::source_ids::source_ids;
use crate::{AnyLightSamplerError, SamplerKind};

/// The least number of placed lights whose hierarchy is a tree of placed trees: a flat one of fewer
/// takes up to 30 MB, answers in up to a quarter less time, and chooses better where instances lie
/// among each other.
const MANY: usize = 1 << 20;

/// Powers of lights below this may vanish in the coordinates of a prototype, and not where it is
/// placed.
const FAINT: f32 = 1e-30;

/// Whether the lights of a set are so many, and so few of them stored, that a tree of placed trees
/// serves them.
pub(crate) fn is_mostly_placed(lights: &LightSet<Rgb>) -> bool {
    let counts = lights.placed_counts();
    counts.lights >= MANY && counts.lights / 4 >= counts.stored_lights
}

/// The tree of placed trees over all lights of a set. Where a transform is not a rotation, a
/// uniform scale and a translation, the instance has a tree of its own, as all lights have that are
/// not placed.
pub(crate) fn placed_tree(
    lights: &LightSet<Rgb>,
) -> Result<InstancedBvhLightSampler, AnyLightSamplerError> {
    let mut parts = Parts::default();
    let mut rest = 0..0u32;
    for (source, ids) in source_ids(lights) {
        match lights.placement(source) {
            None => rest.end = ids.end,
            Some((prototype, to_scene)) => {
                parts.add_alone(lights, rest.clone())?;
                rest = ids.end..ids.end;
                parts.place(lights, prototype, to_scene, ids)?;
            }
        }
    }
    parts.add_alone(lights, rest)?;
    let tree = InstancedLightBvh::build(parts.prototypes, &parts.placements)?;
    Ok(InstancedBvhLightSampler::with_infinite_among(
        tree,
        &parts.infinite,
    )?)
}

/// Prototypes and placements in the order of ids.
#[derive(Default)]
struct Parts {
    prototypes: Vec<LightPrototype>,
    placements: Vec<Placement>,
    infinite: Vec<(LightId, InfiniteBounds)>,
    /// Of each prototype of the set, once it is needed.
    known: Vec<Option<Known>>,
}

/// A prototype of the set as one of the tree.
#[derive(Clone, Copy)]
struct Known {
    index: u32,
    /// Whether a light is so faint that its power may have vanished.
    is_faint: bool,
}

impl Parts {
    /// Adds lights that are where they are, with a tree of their own.
    fn add_alone(
        &mut self,
        lights: &LightSet<Rgb>,
        ids: Range<u32>,
    ) -> Result<(), AnyLightSamplerError> {
        if ids.is_empty() {
            return Ok(());
        }
        check_memory(SamplerKind::Bvh, ids.len())?;
        let all = ids.clone().filter_map(|id| lights.get(LightId(id)));
        let extents: Vec<LightExtent> = all.map(|light| light.extent()).collect();
        let at_infinity = ids.map(LightId).zip(&extents);
        let at_infinity = at_infinity.filter_map(|(id, extent)| Some((id, *extent.infinite()?)));
        self.infinite.extend(at_infinity);
        let prototype = self.push(LightPrototype::new(&extents)?);
        self.placements.push(Placement::at(prototype, Vec3::ZERO));
        Ok(())
    }

    /// Adds the lights of a placed mesh.
    fn place(
        &mut self,
        lights: &LightSet<Rgb>,
        prototype: MeshPrototypeId,
        to_scene: &Affine3A,
        ids: Range<u32>,
    ) -> Result<(), AnyLightSamplerError> {
        if ids.is_empty() {
            return Ok(());
        }
        let at = prototype.0 as usize;
        if self.known.len() <= at {
            self.known.resize(at + 1, None);
        }
        let known = match self.known[at] {
            Some(known) => known,
            None => {
                let extents = lights.prototype_extents(prototype);
                let mut powers = extents
                    .iter()
                    .filter_map(|extent| Some(extent.bounded()?.phi));
                let is_faint = powers.any(|phi| !(phi >= FAINT));
                let index = self.push(LightPrototype::new(&extents)?);
                *self.known[at].insert(Known { index, is_faint })
            }
        };
        match Placement::from_matrix(known.index, to_scene) {
            Ok(placement) if !known.is_faint => self.placements.push(placement),
            _ => self.add_alone(lights, ids)?,
        }
        Ok(())
    }

    fn push(&mut self, prototype: LightPrototype) -> u32 {
        let index = u32::try_from(self.prototypes.len()).expect("no more than placements");
        self.prototypes.push(prototype);
        index
    }
}
