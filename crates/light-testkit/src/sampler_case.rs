use light_bounds::{LightExtent, LightId, LightSampleContext};
use light_math::{Aabb, glam::Vec3};
use light_sets::{BenchSet, SetKind};

use crate::{Emitter, Rng};

/// Contexts at random places of a case; more are added at its bounds.
pub(crate) const CONTEXTS: usize = 12;

/// Lights, and the contexts at which the laws of samplers are checked on them.
#[derive(Clone, Debug)]
pub struct SamplerCase {
    /// What the case is about.
    pub name: &'static str,
    /// One entry a light; the index is the light's id.
    pub emitters: Vec<Emitter>,
    /// The receivers.
    pub contexts: Vec<LightSampleContext>,
}

impl SamplerCase {
    /// The lights with `count` random contexts in and around their box, and a few more exactly at
    /// their bounds.
    #[must_use]
    pub fn new(name: &'static str, emitters: Vec<Emitter>, count: usize, seed: u64) -> Self {
        let mut rng = Rng::new(seed);
        let mut case = Self {
            name,
            emitters,
            contexts: Vec::new(),
        };
        let (low, high) = case.corners();
        let size = (high - low).max(Vec3::splat(1e-3));
        for i in 0..count {
            let p = low - size * 0.25 + size * 1.5 * rng.vec3();
            case.contexts.push(context(p, i, &mut rng));
        }
        case.add_contexts_at_bounds(&mut rng);
        case
    }

    /// The lights of a measured set, and contexts at points of it.
    #[must_use]
    pub fn generated(kind: SetKind, n: usize, seed: u64) -> Self {
        let set = BenchSet::generate(kind, n, seed);
        let emitters = set.lights.into_iter().map(Emitter::Set).collect();
        let mut case = Self::new(kind.name(), emitters, CONTEXTS, seed);
        // The first two stay where they are: outside of the lights' box, mostly.
        for (ctx, point) in case
            .contexts
            .iter_mut()
            .take(CONTEXTS)
            .skip(2)
            .zip(&set.points)
        {
            ctx.p = point.p;
        }
        case
    }

    /// [`SetKind::Mixed`], with a sky and a sun among its lights.
    #[must_use]
    pub fn mixed(n: usize, seed: u64) -> Self {
        let mut case = Self::generated(SetKind::Mixed, n, seed);
        let infinite = [
            (10, Emitter::Sky { radiance: 0.01 }),
            (
                20,
                Emitter::Sun {
                    wi: Vec3::new(0.6, 0.0, 0.8),
                    irradiance: 2.0,
                },
            ),
        ];
        for (index, light) in infinite {
            if let Some(emitter) = case.emitters.get_mut(index) {
                *emitter = light;
            }
        }
        case
    }

    /// What samplers are built from.
    #[must_use]
    pub fn extents(&self) -> Vec<LightExtent> {
        self.emitters.iter().map(Emitter::extent).collect()
    }

    /// The same with those that have a position in reverse order: what a tree is built of, before a
    /// refit to [`extents`](Self::extents) moves nearly all of its lights.
    #[must_use]
    pub fn exchanged_extents(&self) -> Vec<LightExtent> {
        let extents = self.extents();
        let mut bounded = extents.iter().rev().filter(|e| e.bounded().is_some());
        let other = |e: &LightExtent| match e {
            LightExtent::Infinite(_) => Some(*e),
            LightExtent::Bounded(_) | LightExtent::Lobe(..) => bounded.next().copied(),
        };
        extents.iter().filter_map(other).collect()
    }

    /// The emitted powers, in W.
    #[must_use]
    pub fn powers(&self) -> Vec<f32> {
        self.emitters.iter().map(Emitter::power).collect()
    }

    /// How many lights there are.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.emitters.len() as u32
    }

    /// The ids of all lights.
    pub fn ids(&self) -> impl Iterator<Item = LightId> + use<> {
        (0..self.count()).map(LightId)
    }

    /// The box of all bounded lights.
    pub(crate) fn corners(&self) -> (Vec3, Vec3) {
        let extents = self.extents();
        let boxes = extents.iter().filter_map(|e| e.bounded()).map(|b| b.bounds);
        let all = boxes.fold(Aabb::EMPTY, Aabb::union);
        if all.is_empty() {
            (Vec3::ZERO, Vec3::ONE)
        } else {
            (all.min, all.max)
        }
    }

    /// Adds contexts where distances are 0: box centres and corners of the first lights and of all
    /// lights.
    fn add_contexts_at_bounds(&mut self, rng: &mut Rng) {
        let (low, high) = self.corners();
        let mut points = vec![low * 0.5 + high * 0.5, low, high];
        for extent in self.extents().iter().take(3) {
            if let LightExtent::Bounded(bounds) = extent {
                points.extend([bounds.bounds.center(), bounds.bounds.max]);
            }
        }
        for (i, p) in points.into_iter().enumerate() {
            self.contexts.push(context(p, i, rng));
        }
    }
}

/// Mostly surfaces, some with different normals, every fourth a medium.
fn context(p: Vec3, i: usize, rng: &mut Rng) -> LightSampleContext {
    let n = rng.direction();
    match i % 4 {
        0 => LightSampleContext::surface(p, Vec3::Z, Vec3::Z),
        1 => LightSampleContext::surface(p, n, n),
        2 => LightSampleContext::surface(p, n, (n + 0.3 * rng.direction()).normalize()),
        _ => LightSampleContext::medium(p),
    }
}
