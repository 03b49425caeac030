use core::f32::consts::PI;

use light_bounds::{LightBounds, LightExtent};

use crate::node::moments::Moments;
use crate::simd::prefetch;

/// What the leaves of a tree are described by: lights, or groups of lights.
pub(crate) trait LeafMoments: Sync {
    /// The moments of the leaf with this id.
    fn moments(&self, id: u32) -> Moments;

    /// Prefetches a leaf that is read soon.
    fn prefetch(&self, id: u32);
}

/// The lights of a tree in the making.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lights<'a> {
    extents: &'a [LightExtent],
    /// One over the power of all of them, 0 if they have none.
    inv_power: f64,
}

impl<'a> Lights<'a> {
    pub(crate) fn new(extents: &'a [LightExtent], power: f64) -> Self {
        Self {
            extents,
            inv_power: if power > 0.0 { 1.0 / power } else { 0.0 },
        }
    }

    /// The bounds of a light that is in the tree.
    #[inline]
    pub(crate) fn bounds(&self, light: u32) -> &'a LightBounds {
        self.extents[light as usize]
            .bounded()
            .expect("only bounded lights get into a tree")
    }

    #[inline]
    pub(crate) const fn extent(&self, light: u32) -> &'a LightExtent {
        &self.extents[light as usize]
    }

    #[inline(always)]
    pub(crate) fn moments_of(&self, extent: &LightExtent) -> Moments {
        Moments::of_light(extent, self.inv_power)
    }

    /// Power of a light as a share of that of all lights; above 0, so that lights that are off
    /// split somehow.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
    pub(crate) fn share(&self, extent: &LightExtent) -> f32 {
        ((f64::from(phi(extent)) * self.inv_power) as f32).max(f32::MIN_POSITIVE)
    }
}

impl LeafMoments for Lights<'_> {
    #[inline(always)]
    fn moments(&self, light: u32) -> Moments {
        self.moments_of(self.extent(light))
    }

    #[inline]
    fn prefetch(&self, light: u32) {
        prefetch::<1, _>(self.extents, light);
    }
}

/// The power of a light in the builder: that of a beam as if it emitted alike in all directions; 0
/// for lights that are off or infinite.
#[inline]
pub(crate) fn phi(extent: &LightExtent) -> f32 {
    match extent {
        LightExtent::Bounded(bounds) => bounds.phi,
        LightExtent::Lobe(bounds, lobe) => {
            (4.0 * PI * lobe.line().peak).clamp(bounds.phi, f32::MAX)
        }
        LightExtent::Infinite(_) => 0.0,
    }
}
