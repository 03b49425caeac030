use alloc::vec;
use alloc::vec::Vec;

use light_bounds::{LightBounds, LightExtent, LightId, LightSampleContext, SampledLight};
use light_math::Aabb;

use super::build::build;
use super::importance::FAR;
use super::moments::Moments;
use super::node::{NOWHERE, WIDTH, WideNode};
use super::prim::Prim;
use super::tree::LightBvhRef;
use crate::{LightBvhError, validate};

/// The default light hierarchy: chooses one of many lights about in proportion to its irradiance.
///
/// Eight children a node, each described by moments of its lights: expected irradiance instead of a bound of it, and zero only where
/// no light can contribute. About 32 bytes a light.
#[derive(Clone, Debug, Default)]
pub struct LightBvh {
    nodes: Vec<WideNode>,
    order: Vec<u32>,
    slots: Vec<u32>,
    power: f64,
}

impl LightBvh {
    /// The hierarchy of the bounded lights of `lights`, in which the index of an entry is its [`LightId`].
    ///
    /// Infinite lights, and lights without power, are not in the tree and have pmf 0.
    ///
    /// # Errors
    /// The first light with invalid bounds or a coordinate beyond ±1e36.
    pub fn build(lights: &[LightExtent]) -> Result<Self, LightBvhError> {
        validate(lights)?;
        let mut total = 0.0;
        let mut count = 0;
        for (light, extent) in (0..).map(LightId).zip(lights) {
            if let Some(light_bounds) = extent.bounded() {
                if is_far(&light_bounds.bounds) {
                    return Err(LightBvhError::TooFar { light });
                }
                total += f64::from(light_bounds.phi);
                count += usize::from(light_bounds.phi > 0.0);
            }
        }
        let mut prims = Vec::with_capacity(count);
        for (light, extent) in (0..).zip(lights) {
            match extent.bounded() {
                Some(bounds) if bounds.phi > 0.0 => prims.push(Prim::new(bounds, light, total)),
                _ => {}
            }
        }
        let (nodes, order) = build(&mut prims, |light| bounds_of(lights, light), 1.0 / total);
        let slots = slots(&nodes, &order, lights.len());
        Ok(Self {
            nodes,
            order,
            slots,
            power: total,
        })
    }

    /// What queries need, borrowed.
    #[inline]
    #[must_use]
    pub fn view(&self) -> LightBvhRef<'_> {
        LightBvhRef::new(&self.nodes, &self.order, &self.slots)
    }

    /// One light that may light `ctx`; `None` if no light in the tree can.
    #[inline]
    #[must_use]
    pub fn sample(&self, ctx: &LightSampleContext, u: f64) -> Option<SampledLight> {
        self.view().sample(ctx, u)
    }

    /// Probability that [`sample`](Self::sample) at `ctx` returns `light`, to the bit.
    #[inline]
    #[must_use]
    pub fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.view().pmf(ctx, light)
    }

    /// About the irradiance at `ctx`, or in a medium the fluence, by all lights of the tree; 0 only if none of them can contribute.
    #[must_use]
    pub fn irradiance(&self, ctx: &LightSampleContext) -> f64 {
        self.view().irradiance(ctx) * self.power
    }

    /// The power of all lights of the tree.
    #[must_use]
    pub const fn power(&self) -> f64 {
        self.power
    }

    /// Bytes that queries may touch.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.order) + size_of_val(&*self.slots)
    }

    /// Levels of nodes, at most [`MAX_DEPTH`](super::tree::MAX_DEPTH).
    #[must_use]
    pub fn depth(&self) -> usize {
        let mut levels = vec![0; self.nodes.len()];
        let mut deepest = 0;
        for (index, node) in self.nodes.iter().enumerate() {
            // Parents come before their children.
            levels[index] = match node.parent {
                NOWHERE => 1,
                parent => levels[parent as usize / WIDTH] + 1,
            };
            deepest = deepest.max(levels[index]);
        }
        deepest
    }
}

fn is_far(bounds: &Aabb) -> bool {
    bounds.min.min_element() < -FAR || bounds.max.max_element() > FAR
}

fn bounds_of(lights: &[LightExtent], light: u32) -> &LightBounds {
    lights[light as usize]
        .bounded()
        .expect("only bounded lights become prims")
}

fn slots(nodes: &[WideNode], order: &[u32], lights: usize) -> Vec<u32> {
    let mut slots = vec![NOWHERE; lights];
    for (index, node) in (0u32..).zip(nodes) {
        for child in u32::from(node.inner)..u32::from(node.count) {
            let entry = node.light_base + child - u32::from(node.inner);
            slots[order[entry as usize] as usize] = index * 8 + child;
        }
    }
    slots
}

impl Prim {
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
    fn new(bounds: &LightBounds, light: u32, total: f64) -> Self {
        Self {
            center: bounds.bounds.center(),
            power: ((f64::from(bounds.phi) / total) as f32).max(f32::MIN_POSITIVE),
            axis: Moments::of_light(bounds, 1.0).axis,
            light,
        }
    }
}
