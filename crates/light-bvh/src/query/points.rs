//! Subtrees that are points in codes of their node: too small for a receiver near them to be told
//! where it is.

use light_math::float::positive_product;
use light_math::glam::Vec3;

use crate::importance::receiver::Receiver;
use crate::node::wide_node::WideNode;
use crate::query::bvh_ref::LightBvhRef;
use crate::query::weights::{LARGEST_WEIGHT, Weights};
use crate::simd::{VectorWork, dispatch};

/// Within how many codes a subtree that is a point is not described well enough by one.
pub(crate) const NEAR_POINT: f32 = 16.0;

impl LightBvhRef<'_> {
    /// Lets each child of `node` that is a subtree, a point and near count by the weights of its
    /// own children for `receiver`.
    #[inline(always)]
    pub(crate) fn resolve_points<R: Receiver>(
        &self,
        node: &WideNode,
        receiver: &R,
        weights: &mut Weights,
    ) {
        if !node.has_points() {
            return;
        }
        // Without an operating system the stack is short.
        if cfg!(target_os = "none") {
            self.resolve_near_points(node, receiver, weights);
        } else {
            // A copy: what a function may change through a reference is in memory.
            let mut resolved = *weights;
            self.resolve_near_points(node, receiver, &mut resolved);
            *weights = resolved;
        }
    }

    /// A function of its own: nodes without points, which are most, pay for one test.
    #[cold]
    #[inline(never)]
    fn resolve_near_points<R: Receiver>(
        &self,
        node: &WideNode,
        receiver: &R,
        weights: &mut Weights,
    ) {
        for k in node.points() {
            let index = node.child_base as usize + k;
            let Some(child) = self.nodes().get(index) else {
                return;
            };
            let is_near = is_near(node, child, receiver.position(), receiver.reach());
            if is_near && weights.lanes[k] > 0.0 {
                let gain = child.gain() / node.gain();
                let own = self.total_weight(index, child, receiver, (weights.inv_unit, gain));
                weights.lanes[k] = own.min(LARGEST_WEIGHT);
            }
        }
        weights.raise_to_least_share();
    }

    /// The sum of the weights of the node `index`, as [`Weights::scale_to`] has them by these
    /// arguments; 0 only if no child can contribute.
    // On a GPU one function for all places that call it keeps the registers of a query few.
    #[cfg_attr(not(target_os = "none"), inline(never))]
    fn total_weight<R: Receiver>(
        &self,
        index: usize,
        node: &WideNode,
        receiver: &R,
        (inv_unit, gain): (f32, f32),
    ) -> f32 {
        let mut weights = dispatch(NodeWeights { node, receiver });
        self.leave_out(index, &mut weights);
        positive_product(weights.total, weights.scale_to(inv_unit, gain))
    }
}

/// Whether the lights of `child`, a point in codes of `node`, are within some codes of a receiver
/// that reaches so far.
fn is_near(node: &WideNode, child: &WideNode, position: Vec3, reach: f32) -> bool {
    let near = NEAR_POINT / node.inv_scale + reach;
    Vec3::from(child.origin).distance_squared(position) < near * near
}

/// [`Weights::new`] by the widest vectors.
struct NodeWeights<'a, R> {
    node: &'a WideNode,
    receiver: &'a R,
}

impl<R: Receiver> VectorWork for NodeWeights<'_, R> {
    type Output = Weights;

    #[inline(always)]
    fn run(self) -> Weights {
        Weights::new(self.node, self.receiver)
    }
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use alloc::vec::Vec;

    use light_bounds::{LightBounds, LightExtent, LightId, LightSampleContext};
    use light_math::Aabb;
    use light_math::fraction::stratum;
    use light_math::glam::Vec3;
    use light_testkit::Rng;

    use crate::LightBvh;

    /// So many lamps in a hall, and after them a sun far away that gives as much light in the middle
    /// as they do together.
    fn hall_and_sun(rng: &mut Rng, lamps: usize) -> LightBvh {
        let lamp = |p: Vec3, phi: f32| {
            LightExtent::Bounded(LightBounds {
                bounds: Aabb::from_point(p),
                w: Vec3::Z,
                phi,
                cos_theta_o: -1.0,
                cos_theta_e: 0.0,
                two_sided: false,
            })
        };
        let sun = 1e5 * Vec3::new(0.6, 0.0, 0.8);
        let at: Vec<_> = (0..lamps).map(|_| 10.0 * rng.direction()).collect();
        let of_lamps: f32 = at.iter().map(|p| 1.0 / p.length_squared()).sum();
        let mut lights: Vec<_> = at.iter().map(|&p| lamp(p, 1.0)).collect();
        lights.push(lamp(sun, of_lamps * sun.length_squared()));
        LightBvh::build(&lights).expect("valid lights")
    }

    #[test]
    fn lamps_about_the_receiver_count_beside_a_light_far_away() {
        let mut rng = Rng::new(3);
        for lamps in [1, 2, 9, 15, 16, 300] {
            let tree = hall_and_sun(&mut rng, lamps);
            let here = LightSampleContext::medium(Vec3::ZERO);
            let pmf = |light: usize| tree.pmf(&here, LightId(u32::try_from(light).expect("few")));
            let of_sun = pmf(lamps);
            assert!((0.2..0.8).contains(&of_sun), "{lamps} lamps: {of_sun}");
            for light in 0..lamps {
                let fair = 0.5 / lamps as f32;
                assert!(pmf(light) > 0.2 * fair, "lamp {light} of {lamps}");
            }
        }
    }

    #[test]
    fn samples_have_the_probability_that_is_queried() {
        let mut rng = Rng::new(4);
        for lamps in [1, 2, 15, 300] {
            let tree = hall_and_sun(&mut rng, lamps);
            for reach in [1.0, 1e3, 1e6] {
                let p = reach * rng.direction();
                let here = LightSampleContext::surface(p, Vec3::Z, Vec3::Z);
                let mut sum = 0.0;
                tree.view().for_each_pmf(&here, |light, pmf| {
                    assert_eq!(tree.pmf(&here, light), pmf, "{light:?}");
                    assert_eq!(tree.view().at(&here).pmf(light), pmf, "{light:?} here");
                    sum += f64::from(pmf);
                });
                assert!(sum < 1.0 + 1e-6, "{sum} at {p}");
                for k in 0..64 {
                    let Some(sampled) = tree.sample(&here, stratum(k, 64, 0)) else {
                        continue;
                    };
                    let pmf = tree.pmf(&here, sampled.light);
                    assert_eq!(sampled.pmf, pmf, "{:?} of {lamps}", sampled.light);
                }
            }
        }
    }
}
