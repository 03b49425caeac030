//! Subtrees whose own nodes tell more than their codes: those that are small in codes of their node
//! and those of many lights, where a receiver is near them, those of lights along a line, beside it,
//! and those of lights that emit in steps, at their edge.

use light_math::float::positive_product;
use light_math::glam::Vec3;

use crate::importance::receiver::Receiver;
use crate::node::wide_node::{WIDTH, WideNode};
use crate::query::bvh_ref::LightBvhRef;
use crate::query::doubtful::Doubtful;
use crate::query::weights::{LARGEST_WEIGHT, Weights, total};
use crate::simd::{VectorWork, dispatch};

/// Within how many codes a small subtree is not described well enough by them.
pub(crate) const NEAR_SMALL: f32 = 16.0;

/// The least weight of a small subtree of several lights that is near, as a share of the weights of
/// its node.
///
/// One level further down does not tell how much a light beside the receiver gives, where the
/// subtree has itself children that are far smaller than its codes. Chosen by V: see
/// `docs/light-bvh-study.md`.
pub(crate) const NEAR_SHARE: f32 = 0.125;

impl LightBvhRef<'_> {
    /// Lets each child of `node` that it describes coarsely for `receiver` count by the weights of its
    /// own children: a small or a large subtree that is near, lights along a line that the receiver is
    /// beside, and a subtree at whose edge of emission it is.
    #[inline(always)]
    pub(crate) fn look_ahead<R: Receiver>(
        &self,
        node: &WideNode,
        receiver: &R,
        weights: &mut Weights,
    ) {
        if node.has_rough() {
            weights.change(|weights| self.look_into_rough(node, receiver, weights));
        }
    }

    /// A function of its own: nodes without rough subtrees, which are most, pay for one test.
    #[cold]
    #[inline(never)]
    fn look_into_rough<R: Receiver>(&self, node: &WideNode, receiver: &R, weights: &mut Weights) {
        let doubtful = dispatch(Doubtful {
            node,
            position: receiver.position(),
            weights,
        });
        // Bit k: child k is a group of several lights, and near.
        let mut groups = 0u32;
        for k in node.subtrees() {
            let index = node.child_base as usize + k;
            let Some(child) = self.nodes().get(index) else {
                return;
            };
            let is_near =
                node.is_small(k) && is_near(node, child, receiver.position(), receiver.reach());
            let is_doubtful =
                doubtful >> k & 1 == 1 && (node.is_step(k) || child.has_subtrees_only());
            let is_beside = doubtful >> (WIDTH + k) & 1 == 1 && child.is_line();
            if (is_near || is_doubtful || is_beside) && weights.lanes[k] > 0.0 {
                let gain = child.gain() / node.gain();
                let own = self.total_weight(index, child, receiver, (weights.inv_unit, gain));
                weights.lanes[k] = own.min(LARGEST_WEIGHT);
                groups |= u32::from(is_near && child.children() > 1 && own > 0.0) << k;
            }
        }
        let least = (total(&weights.lanes) * NEAR_SHARE).min(LARGEST_WEIGHT);
        for (k, weight) in weights.lanes.iter_mut().enumerate() {
            if groups >> k & 1 == 1 {
                *weight = weight.max(least);
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
        if node.is_line() && node.has_rough() {
            self.look_into_lines(node, receiver, &mut weights);
        }
        positive_product(weights.total, weights.scale_to(inv_unit, gain))
    }

    /// Lets each child of `node` whose lights lie along a line, and that the receiver is beside, count by
    /// the weights of its own children. Of a line the sum of its parts is as far off as it is itself where
    /// they are long.
    #[cold]
    #[inline(never)]
    fn look_into_lines<R: Receiver>(&self, node: &WideNode, receiver: &R, weights: &mut Weights) {
        let doubtful = dispatch(Doubtful {
            node,
            position: receiver.position(),
            weights,
        });
        for k in node.subtrees() {
            let index = node.child_base as usize + k;
            let Some(child) = self.nodes().get(index) else {
                return;
            };
            let is_beside = doubtful >> (WIDTH + k) & 1 == 1 && child.is_line();
            if is_beside && weights.lanes[k] > 0.0 {
                let mut own = dispatch(NodeWeights {
                    node: child,
                    receiver,
                });
                self.leave_out(index, &mut own);
                let scale = own.scale_to(weights.inv_unit, child.gain() / node.gain());
                weights.lanes[k] = positive_product(own.total, scale).min(LARGEST_WEIGHT);
            }
        }
        weights.raise_to_least_share();
    }
}

/// Whether a receiver that reaches so far is within some codes of `node` from `child`.
fn is_near(node: &WideNode, child: &WideNode, position: Vec3, reach: f32) -> bool {
    let width = 255.0 / child.inv_scale;
    let near = NEAR_SMALL / node.inv_scale + width + reach;
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

    fn lamp(p: Vec3, phi: f32) -> LightExtent {
        LightExtent::Bounded(LightBounds {
            bounds: Aabb::from_point(p),
            w: Vec3::Z,
            phi,
            cos_theta_o: -1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        })
    }

    /// So many lamps in a hall, and after them a sun far away that gives as much light in the middle
    /// as they do together.
    fn hall_and_sun(rng: &mut Rng, lamps: usize) -> LightBvh {
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

    /// Houses of three lamps over kilometres and a sun: a house is small in codes of a node above
    /// it, which is small in codes of the root.
    #[test]
    fn a_lamp_beside_the_receiver_counts_in_a_village_under_a_sun() {
        let mut rng = Rng::new(5);
        let houses: Vec<_> = (0..40).map(|_| 1e3 * rng.direction()).collect();
        let mut lights = Vec::new();
        for &house in &houses {
            lights.extend((0..3).map(|_| lamp(house + 3.0 * rng.direction(), 1.0)));
        }
        lights.push(lamp(3e5 * Vec3::Z, 3e5 * 3e5));
        let tree = LightBvh::build(&lights).expect("valid lights");
        for (k, &house) in houses.iter().enumerate() {
            let here = LightSampleContext::medium(house);
            let of_house: f32 = (3 * k..3 * k + 3)
                .map(|light| tree.pmf(&here, LightId(u32::try_from(light).expect("few"))))
                .sum();
            assert!(of_house > 0.01, "house {k}: {of_house}");
        }
    }

    /// A ceiling of lamps that shine straight down in narrow cones, of which one or none lights a place
    /// on the floor.
    fn ceiling(side: u16) -> LightBvh {
        let lamp = |i: u16| {
            let at = Vec3::new(f32::from(i % side), f32::from(i / side), 3.0);
            LightExtent::Bounded(LightBounds {
                bounds: Aabb::from_point(at),
                w: Vec3::NEG_Z,
                phi: 1.0,
                cos_theta_o: 0.99,
                cos_theta_e: 1.0,
                two_sided: false,
            })
        };
        let lights: Vec<_> = (0..side * side).map(lamp).collect();
        LightBvh::build(&lights).expect("valid lights")
    }

    #[test]
    fn the_one_lamp_of_a_ceiling_that_shines_here_is_found() {
        let tree = ceiling(20);
        let mut sum = 0.0;
        for light in (0..400).map(LightId) {
            let at = Vec3::new((light.0 % 20) as f32, (light.0 / 20) as f32, 0.0);
            let below = LightSampleContext::surface(at + 0.2, Vec3::Z, Vec3::Z);
            let pmf = tree.pmf(&below, light);
            assert!(pmf > 0.05, "below {light:?}: {pmf}");
            sum += pmf;
            assert_eq!(tree.view().at(&below).pmf(light), pmf, "{light:?} here");
            let sampled = tree.sample(&below, 1 << 63).expect("a lamp");
            assert_eq!(sampled.pmf, tree.pmf(&below, sampled.light), "{sampled:?}");
        }
        assert!(sum / 400.0 > 0.5, "{}", sum / 400.0);
    }

    /// Small panels that shine straight down from a large ceiling: those about the receiver give nearly
    /// all light.
    #[test]
    fn the_panels_of_a_large_ceiling_that_are_near_are_found() {
        const SIDE: u16 = 150;
        let at = |i: u16| Vec3::new(f32::from(i % SIDE), f32::from(i / SIDE), 3.0);
        let panel = |i| {
            LightExtent::Bounded(LightBounds {
                bounds: Aabb::from_point(at(i)),
                w: Vec3::NEG_Z,
                phi: 1.0,
                cos_theta_o: 1.0,
                cos_theta_e: 0.0,
                two_sided: false,
            })
        };
        let panels: Vec<_> = (0..SIDE * SIDE).map(panel).collect();
        let tree = LightBvh::build(&panels).expect("valid lights");
        let mut rng = Rng::new(6);
        let mut sum = 0.0;
        for _ in 0..20 {
            let p = Vec3::new(15.0 + 120.0 * rng.f32(), 15.0 + 120.0 * rng.f32(), 0.0);
            let here = LightSampleContext::surface(p, Vec3::Z, Vec3::Z);
            let (mut squares, mut total) = (0.0, 0.0);
            tree.view().for_each_pmf(&here, |LightId(i), pmf| {
                let way = at(u16::try_from(i).expect("few")) - p;
                let gives = 9.0 / (way.length_squared() * way.length_squared());
                total += f64::from(gives);
                squares += f64::from(gives * gives / pmf);
            });
            sum += squares / (total * total) - 1.0;
        }
        let variance = sum / 20.0;
        assert!(variance < 0.16, "{variance}");
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
