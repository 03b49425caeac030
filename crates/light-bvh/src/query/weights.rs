use light_bounds::LightGroups;
use light_math::glam::Vec4;

use crate::importance::child_view::{ChildView, NodeFrame};
use crate::importance::receiver::Receiver;
use crate::lane_math::{LaneMask, larger, reduce};
use crate::node::child_codes::READS_WORDS;
use crate::node::wide_node::{WIDTH, WideNode};
use crate::simd::{VectorWork, dispatch};

/// The least sum of weights in codes that is trusted from any distance: a weight 10^18 times
/// smaller than the largest, and its factors 10^27 times smaller, are still normal floats.
pub(crate) const LEAST_TOTAL: f32 = 1e-10;

/// The same where no weight vanishes: choices divide by the sum.
const LEAST_TOTAL_NEAR: f32 = 1e-30;

/// The least weight of a child that can contribute, as a share of the weights of its node.
///
/// An estimate has no limit to its error; this bounds what a light costs that was estimated too
/// low. Chosen by V: see `docs/light-bvh-study.md`.
pub(crate) const LEAST_SHARE: f32 = 1.0 / 1024.0;

/// The share of the weights of its node from which on a child is capped, if it is uncertain.
pub(crate) const MOST: f32 = 0.9375;

/// The largest weight of a child that is a sum of other weights: the sum of all is finite.
pub(crate) const LARGEST_WEIGHT: f32 = f32::MAX / WIDTH as f32;

/// How much more a nearer node may count per unit of its weight: where distances differ by more
/// than 2^30, weights lose their proportion and keep their sign.
pub(crate) const MAX_ZOOM: f32 = 1_073_741_824.0;

/// The importance of each child of a node to a receiver.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weights {
    /// One number a child: 0 only if it cannot contribute.
    pub(crate) lanes: [f32; WIDTH],
    /// Their sum, always added up in the same order.
    pub(crate) total: f32,
    /// One over the unit of length that the weights are in.
    pub(crate) inv_unit: f32,
    /// Whether one child, or four together, have more than [`MOST`] of the sum.
    pub(crate) lopsided: bool,
}

impl Weights {
    /// Of a tree without lights.
    pub(crate) const NONE: Self = Self {
        lanes: [0.0; WIDTH],
        total: 0.0,
        inv_unit: 1.0,
        lopsided: false,
    };

    /// The weights of the children of `node` for `receiver`.
    // Without an operating system memory for code is short: all queries call one function.
    #[cfg_attr(any(target_os = "none", target_arch = "nvptx64"), inline(never))]
    #[cfg_attr(not(any(target_os = "none", target_arch = "nvptx64")), inline(always))]
    pub(crate) fn new<R: Receiver>(node: &WideNode, receiver: &R) -> Self {
        let frame = NodeFrame::in_codes(node, receiver.position());
        let weights = Self::in_frame(node, receiver, &frame, false, note_nothing);
        if is_trusted(weights.total, &frame, receiver) && !node.has_rare() {
            weights
        } else {
            Self::in_rare_cases(node, receiver)
        }
    }

    /// The same, and for each child the square of its angular size: squared width over squared
    /// distance.
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    pub(crate) fn with_angular_size<R: Receiver>(
        node: &WideNode,
        receiver: &R,
    ) -> (Self, [f32; WIDTH]) {
        let mut angular_size_sq = [0.0; WIDTH];
        let frame = NodeFrame::in_codes(node, receiver.position());
        let note = |k: usize, child: &ChildView| {
            angular_size_sq[k] = child.width_sq() * (1.0 / child.dist_sq);
        };
        let weights = Self::in_frame(node, receiver, &frame, false, note);
        if !is_trusted(weights.total, &frame, receiver) {
            // So far away, all are points.
            (Self::in_rare_cases(node, receiver), [0.0; WIDTH])
        } else if node.has_rare() {
            (Self::in_rare_cases(node, receiver), angular_size_sq)
        } else {
            (weights, angular_size_sq)
        }
    }

    /// The factor that makes weights, of a node whose largest power is `gain`, those of one where it
    /// is 1 and one over the unit of length is `inv_unit`; above 0.
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    pub(crate) fn scale_to(&self, inv_unit: f32, gain: f32) -> f32 {
        let zoom = (self.inv_unit / inv_unit).min(MAX_ZOOM);
        (gain * zoom * zoom).max(f32::MIN_POSITIVE)
    }

    /// Gives each child that can contribute its least share of the sum of all.
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    pub(crate) fn raise_to_least_share(&mut self) {
        let least = total(&self.lanes) * LEAST_SHARE;
        for weight in &mut self.lanes {
            *weight = LaneMask::when(*weight > 0.0).keep(larger(*weight, least));
        }
        self.sum_up();
    }

    /// Sets the weights of children without a light in a `wanted` group to 0.
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    pub(crate) fn keep(&mut self, groups: &[LightGroups; WIDTH], wanted: LightGroups) {
        for (weight, groups) in self.lanes.iter_mut().zip(groups) {
            *weight = LaneMask::when(groups.is_wanted(wanted)).keep(*weight);
        }
        self.sum_up();
    }

    /// Lets a function that is not inlined change the weights.
    #[inline(always)]
    pub(crate) fn change(&mut self, by: impl FnOnce(&mut Self)) {
        // Where lanes are in registers a copy, for what a function may change through a reference is in
        // memory. A GPU copies by bytes, and without an operating system the stack is short.
        if cfg!(any(target_os = "none", target_arch = "nvptx64")) {
            by(self);
        } else {
            let mut changed = *self;
            by(&mut changed);
            *self = changed;
        }
    }

    /// Sets the sum of all lanes, and whether one of them, or four together, has most of it.
    #[cfg_attr(soft_floats, inline(never))]
    #[cfg_attr(not(soft_floats), inline(always))]
    pub(crate) fn sum_up(&mut self) {
        self.total = total(&self.lanes);
        if !cfg!(soft_floats) {
            let most = Vec4::splat(MOST * self.total);
            self.lopsided = sums(&self.lanes).cmpgt(most).any();
        }
    }

    /// About the irradiance by the lights of `node`, of which these are the weights, where all
    /// lights of the tree have power 1.
    #[inline(always)]
    pub(crate) fn irradiance(&self, node: &WideNode) -> f32 {
        irradiance(self.total, self.inv_unit, node.gain())
    }

    /// The weights where a child is rare, or where those in codes are not trusted.
    ///
    /// A function of its own, which computes all of them again: nodes without rare children, which
    /// are most, pay for one test.
    #[cold]
    #[inline(never)]
    fn in_rare_cases<R: Receiver>(node: &WideNode, receiver: &R) -> Self {
        if node.has_rare() {
            dispatch(WithRare { node, receiver })
        } else {
            Self::from_afar(node, receiver, false)
        }
    }

    /// The weights in a unit near the distance, for lights so far away, or nodes so large, that
    /// weights in codes underflow.
    #[cold]
    fn from_afar<R: Receiver>(node: &WideNode, receiver: &R, rare: bool) -> Self {
        let frame = NodeFrame::from_afar(node, receiver.position(), receiver.reach());
        Self::in_frame(node, receiver, &frame, rare, note_nothing)
    }

    /// Written so that the compiler computes all children together: no branches, and nothing that
    /// depends on another child.
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    fn in_frame<R: Receiver>(
        node: &WideNode,
        receiver: &R,
        frame: &NodeFrame,
        rare: bool,
        mut note: impl FnMut(usize, &ChildView),
    ) -> Self {
        let mut lanes = [0.0; WIDTH];
        if READS_WORDS {
            for (quarter, lanes) in lanes.chunks_exact_mut(4).enumerate() {
                let four = node.four_children(quarter);
                for (j, weight) in lanes.iter_mut().enumerate() {
                    let child = frame.child(&four.child_codes(j), rare);
                    *weight = receiver.weigh(&child, frame.inv_unit);
                    note(4 * quarter + j, &child);
                }
            }
        } else {
            for (k, weight) in lanes.iter_mut().enumerate() {
                let child = frame.child_at(node, k, rare);
                *weight = receiver.weigh(&child, frame.inv_unit);
                note(k, &child);
            }
        }
        let mut weights = Self {
            lanes,
            total: 0.0,
            inv_unit: frame.inv_unit,
            lopsided: false,
        };
        weights.raise_to_least_share();
        weights
    }
}

/// The weights of the children of a node of which some are rare.
struct WithRare<'a, R> {
    node: &'a WideNode,
    receiver: &'a R,
}

impl<R: Receiver> VectorWork for WithRare<'_, R> {
    type Output = Weights;

    #[inline(always)]
    fn run(self) -> Weights {
        let Self { node, receiver } = self;
        let frame = NodeFrame::in_codes(node, receiver.position());
        let weights = Weights::in_frame(node, receiver, &frame, true, note_nothing);
        if is_trusted(weights.total, &frame, receiver) {
            weights
        } else {
            Weights::from_afar(node, receiver, true)
        }
    }
}

#[inline(always)]
const fn note_nothing(_: usize, _: &ChildView) {}

/// The irradiance that a sum of weights means, in whose unit of length `inv_unit` is one, times
/// `gain`: a normal number, or 0 where the sum is.
pub(crate) fn irradiance(total: f32, inv_unit: f32, gain: f32) -> f32 {
    if !(total > 0.0) {
        return 0.0;
    }
    // Intensities are counted twice.
    let irradiance = (0.5 * total * inv_unit) * (gain * inv_unit);
    irradiance.clamp(f32::MIN_POSITIVE, f32::MAX)
}

/// Whether a sum of weights in codes is neither so small that parts of it may have vanished, nor
/// infinite, nor not a number. Near a node nothing vanishes: there a sum of 0 is right.
#[cfg_attr(target_os = "none", inline(never))]
#[cfg_attr(not(target_os = "none"), inline(always))]
fn is_trusted<R: Receiver>(total: f32, frame: &NodeFrame, receiver: &R) -> bool {
    let is_trusted_near = total == 0.0 || total >= LEAST_TOTAL_NEAR;
    (LEAST_TOTAL..=f32::MAX).contains(&total)
        || (is_trusted_near && frame.is_near(receiver.reach()))
}

/// The sum of all lanes, in pairs.
#[cfg_attr(target_os = "none", inline(never))]
#[cfg_attr(not(target_os = "none"), inline(always))]
pub(crate) fn total(lanes: &[f32; WIDTH]) -> f32 {
    if cfg!(soft_floats) {
        // The same sums in a loop: less code.
        return reduce(*lanes, |a, b| a + b);
    }
    let sums = sums(lanes);
    (sums.x + sums.z) + (sums.y + sums.w)
}

/// The sum of all lanes in four parts.
#[inline(always)]
fn sums(lanes: &[f32; WIDTH]) -> Vec4 {
    let four = |first: usize| Vec4::from_slice(&lanes[first..]);
    (four(0) + four(8)) + (four(4) + four(12))
}

#[cfg(test)]
mod tests;
