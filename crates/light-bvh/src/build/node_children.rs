use crate::build::split_group::SplitGroup;
use crate::node::wide_node::{MAX_DEPTH, WIDTH};

/// A smaller part of the size of a node is not split there: it would be 8 codes of the node wide,
/// too few to tell its lights apart. A node of its own describes it in codes of its own size.
const LEAST_SIZE: f32 = 8.0 / 255.0;

/// A part of several places below this size of a node is one point in codes of the node. Its lights
/// do not become children of that node, but for a pair: a receiver among them could not tell them
/// apart.
const POINT_SIZE: f32 = 1.0 / 255.0;

/// A light of less than this share of the power of the root is outshone by the rest but within 8
/// codes, where it could not be told how near it is. A node of its own tells that in a fine unit.
const FAINT: f32 = LEAST_SIZE * LEAST_SIZE;

/// The gain of a group that stays whole.
const NOT_TO_SPLIT: f32 = -1.0;

/// The groups that become the children of a node.
pub(crate) struct NodeChildren<G> {
    /// Neighbours are next to each other.
    groups: [Option<G>; WIDTH],
    /// What splitting each of them may gain; below 0 if it is not to be split.
    gains: [f32; WIDTH],
    count: usize,
    /// Bit `k`: the lights of group `k` become children themselves.
    singles: u16,
}

/// Whether only halving guarantees that this many lights fit into this many levels.
pub(crate) const fn is_depth_limited(lights: usize, levels: usize) -> bool {
    const BITS: usize = WIDTH.ilog2() as usize;
    levels <= 28 / BITS && lights > 1 << (BITS * (levels - 1))
}

impl<G: SplitGroup> NodeChildren<G> {
    /// Divides `whole` among at most [`WIDTH`] children, so that each fits below `levels - 1` more
    /// levels.
    pub(crate) fn new(whole: G, levels: usize) -> Self {
        let depth_limited = is_depth_limited(whole.lights(), levels);
        let mut children = Self {
            groups: [const { None }; WIDTH],
            gains: [0.0; WIDTH],
            count: 1,
            singles: 0,
        };
        let size = whole.size();
        // A few lights are children of one node, unless some are points there: only the root, whose
        // lights nothing has divided before, is searched for these.
        let is_root = levels == MAX_DEPTH;
        let few = if is_root && whole.lights() <= WIDTH {
            1
        } else {
            WIDTH
        };
        let faint = if is_root && size > 0.0 {
            FAINT * whole.power()
        } else {
            0.0
        };
        let gain = |group: &G| gain(group, few, depth_limited, LEAST_SIZE * size);
        children.gains[0] = gain(&whole);
        children.groups[0] = Some(whole);
        while let Some(index) = children.best_to_split() {
            let Some(group) = children.groups[index].take() else {
                break;
            };
            let (left, right) = if depth_limited {
                group.halve()
            } else {
                group.split()
            };
            children.groups[index + 1..=children.count].rotate_right(1);
            children.gains[index + 1..=children.count].rotate_right(1);
            children.gains[index] = gain(&left);
            children.gains[index + 1] = gain(&right);
            children.groups[index] = Some(left);
            children.groups[index + 1] = Some(right);
            children.count += 1;
        }
        children.dissolve(few.min(2), POINT_SIZE * size, faint);
        children
    }

    /// Which group to split next; the last of those with the highest gain.
    fn best_to_split(&self) -> Option<usize> {
        if self.count == WIDTH {
            return None;
        }
        let (mut best, mut most) = (None, 0.0);
        for (k, &gain) in self.gains[..self.count].iter().enumerate() {
            if gain >= most {
                (best, most) = (Some(k), gain);
            }
        }
        best
    }

    /// Puts the lights of small groups into the slots that are free, but those of groups of more than
    /// `few` lights at several places that are smaller than `point_size`, and single lights of less
    /// power than `faint`.
    fn dissolve(&mut self, few: usize, point_size: f32, faint: f32) {
        let mut free = WIDTH - self.count;
        let is_single = |g: &G| g.lights() == 1 && g.power() >= faint;
        for (k, group) in self.groups.iter().enumerate() {
            self.singles |= u16::from(group.as_ref().is_some_and(is_single)) << k;
        }
        while let Some(k) = self.best(|k, group| {
            let fits = (2..=free + 1).contains(&group.lights()) && self.singles >> k & 1 == 0;
            let is_point = group.lights() > few && 0.0 < group.size() && group.size() < point_size;
            (fits && !is_point).then(|| group.cost())
        }) {
            free -= self.groups[k].as_ref().map_or(1, G::lights) - 1;
            self.singles |= 1 << k;
        }
    }

    /// The last of the groups with the highest key.
    fn best(&self, key: impl Fn(usize, &G) -> Option<f32>) -> Option<usize> {
        let mut best = None;
        for (k, group) in self.groups[..self.count].iter().flatten().enumerate() {
            if let Some(key) = key(k, group) {
                best = match best {
                    Some((_, most)) if key < most => best,
                    _ => Some((k, key)),
                };
            }
        }
        best.map(|(k, _)| k)
    }

    /// How many lights become children themselves.
    pub(crate) fn light_count(&self) -> usize {
        self.parts()
            .filter(|(_, single)| *single)
            .map(|(g, _)| g.lights())
            .sum()
    }

    /// Calls `each` with every light that becomes a child itself.
    pub(crate) fn each_light(&self, mut each: impl FnMut(u32)) {
        for (group, single) in self.parts() {
            if single {
                group.each_light(&mut each);
            }
        }
    }

    /// The groups that become nodes.
    pub(crate) fn into_nodes(self) -> impl Iterator<Item = G> {
        let singles = self.singles;
        let groups = self.groups.into_iter().enumerate();
        groups.filter_map(move |(k, group)| group.filter(|_| singles >> k & 1 == 0))
    }

    /// How many groups become nodes.
    pub(crate) fn node_count(&self) -> usize {
        self.count - self.singles.count_ones() as usize
    }

    fn parts(&self) -> impl Iterator<Item = (&G, bool)> {
        let singles = self.singles;
        let groups = self.groups[..self.count].iter().flatten().enumerate();
        groups.map(move |(k, group)| (group, singles >> k & 1 == 1))
    }
}

/// What splitting `group` may gain, at least 0 if it needs a node of its own anyway, and below if
/// it is not to be split.
fn gain<G: SplitGroup>(group: &G, few: usize, depth_limited: bool, least_size: f32) -> f32 {
    if group.lights() <= few || !group.is_divisible() {
        NOT_TO_SPLIT
    } else if depth_limited {
        group.lights() as f32
    } else if group.size() < least_size {
        NOT_TO_SPLIT
    } else {
        group.cost().max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use light_bounds::{LightBounds, LightExtent};
    use light_math::Aabb;
    use light_math::glam::Vec3;

    use crate::{BuildMode, LightBvh, LightBvhOptions};

    /// Two places of points, 1,000 times as far apart as they are wide: in the codes of the root
    /// all of a place is one position.
    #[test]
    fn a_group_too_small_for_the_codes_of_its_node_has_a_node_of_its_own() {
        let places = |apart: f32| {
            let point = move |i: u16| {
                let [x, y, z] = [7, 11, 13].map(|step| f32::from(i * step % 64) / 64.0);
                let p = Vec3::new(x + apart * f32::from(i % 2), y, z);
                LightExtent::Bounded(LightBounds {
                    bounds: Aabb::from_point(p),
                    w: Vec3::Z,
                    phi: 1.0,
                    cos_theta_o: -1.0,
                    cos_theta_e: 0.0,
                    two_sided: false,
                })
            };
            (0..400).map(point).collect::<Vec<_>>()
        };
        for mode in [BuildMode::Binned, BuildMode::Morton] {
            let options = LightBvhOptions {
                mode,
                ..LightBvhOptions::default()
            };
            let root = |apart| {
                let tree = LightBvh::build_with(&places(apart), &options);
                tree.expect("valid lights").nodes[0]
            };
            let [near, far] = [root(4.0), root(1000.0)];
            assert_eq!((near.children(), near.inner), (16, 16), "{mode:?}: near");
            assert_eq!((far.children(), far.inner), (2, 2), "{mode:?}: far");
        }
    }

    /// Three lamps in a room and one 10,000 times as far away as the room is wide.
    #[test]
    fn a_few_lights_that_are_points_beside_another_have_a_node_of_their_own() {
        let point = |x: f32| {
            LightExtent::Bounded(LightBounds {
                bounds: Aabb::from_point(Vec3::new(x, 0.5 * x, 0.0)),
                w: Vec3::Z,
                phi: 1.0,
                cos_theta_o: -1.0,
                cos_theta_e: 0.0,
                two_sided: false,
            })
        };
        let nodes = |places: &[f32]| {
            let lights: Vec<_> = places.iter().map(|&x| point(x)).collect();
            let tree = LightBvh::build(&lights).expect("valid lights");
            let counts = tree.nodes.iter().map(|node| (node.children(), node.inner));
            counts.collect::<Vec<_>>()
        };
        assert_eq!(nodes(&[0.0, 0.4, 1.0, 1e4]), [(2, 1), (3, 0)], "far");
        assert_eq!(nodes(&[0.0, 0.4, 1.0, 10.0]), [(4, 0)], "near");
        assert_eq!(nodes(&[1.0, 1.0, 1.0, 1e4]), [(4, 0)], "one place");
    }

    /// Within how many codes a lamp outshines the other light is told by their powers.
    #[test]
    fn a_faint_light_has_a_node_of_its_own() {
        let nodes = |mode, power_of_other: f32| {
            let point = |x: f32, phi: f32| {
                LightExtent::Bounded(LightBounds {
                    bounds: Aabb::from_point(Vec3::new(x, 0.0, 0.0)),
                    w: Vec3::Z,
                    phi,
                    cos_theta_o: -1.0,
                    cos_theta_e: 0.0,
                    two_sided: false,
                })
            };
            let lights = [point(0.0, 1.0), point(1e4, power_of_other)];
            let options = LightBvhOptions {
                mode,
                ..LightBvhOptions::default()
            };
            let tree = LightBvh::build_with(&lights, &options).expect("valid lights");
            let counts = tree.nodes.iter().map(|node| (node.children(), node.inner));
            counts.collect::<Vec<_>>()
        };
        for mode in [BuildMode::Binned, BuildMode::Morton] {
            assert_eq!(nodes(mode, 1e4), [(2, 1), (1, 0)], "{mode:?}: faint");
            assert_eq!(nodes(mode, 100.0), [(2, 0)], "{mode:?}: strong");
        }
    }
}
