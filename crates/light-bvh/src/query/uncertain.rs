//! A child that has most of the weights of its node, and whose lights may not reach the receiver.

use light_math::float;

use crate::importance::child_view::NodeFrame;
use crate::importance::receiver::Receiver;
use crate::node::wide_node::WideNode;
use crate::query::bvh_ref::LightBvhRef;
use crate::query::weights::{MOST, Weights, total};

/// How many times the best odds a child may have at most. Chosen by V: see `docs/light-bvh-study.md`.
pub(crate) const ODDS: f32 = 8.0;

/// How many times that of a group: where its mean does not reach the receiver, some of its lights may.
/// The same where lights emit in steps, for the rim of a spot gives some light. Chosen by V.
pub(crate) const MORE_ODDS: f32 = 4.0;

/// By how many of both a child is.
const ODDS_OF: [f32; 3] = [ODDS, ODDS * MORE_ODDS, ODDS * MORE_ODDS * MORE_ODDS];

impl LightBvhRef<'_> {
    /// Leaves some of the choices to the other children of `node` where one has most of the weights and
    /// its lights may not reach the receiver.
    #[inline(always)]
    pub(crate) fn cap_uncertain<R: Receiver>(
        &self,
        node: &WideNode,
        receiver: &R,
        weights: &mut Weights,
    ) {
        // Where floats are routines the sum does not tell.
        if cfg!(soft_floats) || weights.lopsided {
            weights.change(|weights| self.cap_largest(node, receiver, weights));
        }
    }

    /// Lets the child that has most of the weights, if one has, count for no more than its largest odds
    /// allow. A function of its own: other nodes pay for one test.
    #[cold]
    #[inline(never)]
    fn cap_largest<R: Receiver>(&self, node: &WideNode, receiver: &R, weights: &mut Weights) {
        let most = MOST * weights.total;
        let Some(k) = weights.lanes.iter().position(|&weight| weight > most) else {
            return;
        };
        let weight = core::mem::take(&mut weights.lanes[k]);
        let rest = total(&weights.lanes);
        weights.lanes[k] = self.capped(node, receiver, k, (weight, rest));
        weights.sum_up();
    }

    /// What child `k` of `node`, of this `weight`, counts for where those of all others are `rest`
    /// together: no more than its largest odds allow.
    // On a GPU one function for both places that call it.
    #[cfg_attr(target_arch = "nvptx64", inline(never))]
    #[cfg_attr(not(target_arch = "nvptx64"), inline(always))]
    pub(crate) fn capped<R: Receiver>(
        &self,
        node: &WideNode,
        receiver: &R,
        k: usize,
        (weight, rest): (f32, f32),
    ) -> f32 {
        let odds = self.most_odds(node, receiver, k);
        match odds.map(|odds| rest * odds) {
            Some(cap) if is_between_zero_and(weight, cap) => cap,
            _ => weight,
        }
    }

    /// The largest odds of child `k`; `None` of a group of subtrees.
    ///
    /// If a child gives all light with a probability of `f`, and otherwise none, variance is least
    /// where it is chosen with odds of `sqrt(f / (1 - f))`. As the weights have it, it would be chosen
    /// nearly always, however small `f` is, where it is far nearer than the others.
    #[inline(always)]
    fn most_odds<R: Receiver>(&self, node: &WideNode, receiver: &R, k: usize) -> Option<f32> {
        let below = self.nodes().get(node.child_base as usize + k);
        if k < usize::from(node.inner) && below.is_none_or(WideNode::has_subtrees_only) {
            return None;
        }
        let frame = NodeFrame::in_codes(node, receiver.position());
        let child = frame.child_at(node, k, node.has_rare());
        let likelihood = receiver.likelihood(&child);
        let odds = ODDS_OF[usize::from(child.soft.is_set()) + usize::from(child.step.is_set())];
        Some(odds * float::sqrt(likelihood / (1.0 - likelihood)))
    }
}

/// Whether `x` is above 0 and below `limit`, both not negative: a test of integers, for the bits of
/// such floats have their order, and those of what is not a number come after them.
#[inline(always)]
const fn is_between_zero_and(limit: f32, x: f32) -> bool {
    0 < x.to_bits() && x.to_bits() < limit.to_bits()
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use alloc::vec::Vec;

    use light_bounds::{LightBounds, LightExtent, LightId, LightSampleContext};
    use light_math::Aabb;
    use light_math::glam::Vec3;
    use light_testkit::Rng;

    use crate::LightBvh;

    /// A lamp that shines along x, a little downward, within 15 degrees.
    fn head_lamp(at: Vec3) -> LightExtent {
        LightExtent::Bounded(LightBounds {
            bounds: Aabb::from_point(at),
            w: Vec3::new(1.0, 0.0, -0.02).normalize(),
            phi: 1.0,
            cos_theta_o: 0.97,
            cos_theta_e: 0.996,
            two_sided: false,
        })
    }

    /// Panels of `side`, the first one above the origin, the others far away.
    fn panels(side: f32, rng: &mut Rng) -> Vec<LightExtent> {
        let panel = |at: Vec3| {
            let half = Vec3::new(side, side, 0.0);
            LightExtent::Bounded(LightBounds {
                bounds: Aabb::new(at - half, at + half),
                w: Vec3::NEG_Z,
                phi: 1.0,
                cos_theta_o: 1.0,
                cos_theta_e: 0.0,
                two_sided: false,
            })
        };
        let mut all: Vec<_> = (0..12)
            .map(|_| panel(Vec3::new(60.0 + 40.0 * rng.f32(), 40.0 * rng.f32(), 20.0)))
            .collect();
        all.push(panel(2.0 * Vec3::Z));
        all
    }

    #[test]
    fn a_lamp_nearby_that_shines_elsewhere_leaves_some_to_the_one_that_lights_the_place() {
        let place = |i: u16| Vec3::new(40.0 * f32::from(i), 0.0, 0.7);
        let lights: Vec<_> = (0..12).map(|i| head_lamp(place(i))).collect();
        let tree = LightBvh::build(&lights).expect("valid lights");
        for i in 1..11 {
            let beside = place(i) + Vec3::new(0.4, 1.2, -0.7);
            let here = LightSampleContext::surface(beside, Vec3::Z, Vec3::Z);
            let pmf = tree.pmf(&here, LightId(u32::from(i - 1)));
            assert!(pmf > 0.03, "before lamp {i}: {pmf}");
        }
    }

    #[test]
    fn a_light_nearby_that_certainly_shines_here_keeps_its_share() {
        let mut rng = Rng::new(8);
        let lights = panels(0.2, &mut rng);
        let tree = LightBvh::build(&lights).expect("valid lights");
        let here = LightSampleContext::surface(Vec3::ZERO, Vec3::Z, Vec3::Z);
        let pmf = tree.pmf(&here, LightId(12));
        assert!(pmf > 0.98, "{pmf}");
    }
}
