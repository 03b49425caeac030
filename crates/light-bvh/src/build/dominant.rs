use light_math::glam::Vec3;

use crate::build::cluster::{Cluster, Sums};

/// The share of a group's power from which on a light or a cluster may be split from the rest.
/// Chosen by V: see `docs/light-bvh-study.md`.
const SHARE: f32 = 0.4;

/// What outshines the rest of its group. The moments of the group are about its own, with the box
/// of all: whether it is above a horizon, and which way it faces, is then told wrong.
#[derive(Debug)]
pub(crate) struct Dominant {
    /// Its place among the clusters of the group.
    pub(crate) place: usize,
    /// The cost of the rest.
    pub(crate) rest_cost: f32,
}

impl Dominant {
    /// Whether a part of so much power may be split from the rest of `power` in all.
    pub(crate) fn is_share(part: f32, power: f32) -> bool {
        part >= SHARE * power
    }

    /// The brightest of `clusters` if it outshines the rest; `near` is a point near them.
    pub(crate) fn of(clusters: &[Cluster], near: Vec3) -> Option<Self> {
        let (mut place, mut most, mut power) = (0, 0.0, 0.0);
        for (k, cluster) in clusters.iter().enumerate() {
            power += cluster.power;
            if cluster.power > most {
                (place, most) = (k, cluster.power);
            }
        }
        if !Self::is_share(most, power) || clusters.len() < 2 {
            return None;
        }
        // Added up again: of a difference of sums nothing would be left.
        let (before, after) = (&clusters[..place], &clusters[place + 1..]);
        let rest = before.iter().chain(after);
        let sums = rest.fold(Sums::default(), |sums, cluster| {
            sums.plus(&Sums::of(cluster, cluster.center - near))
        });
        Some(Self {
            place,
            rest_cost: sums.cost(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LightBvh;
    use crate::node::wide_node::WIDTH;
    use alloc::vec::Vec;
    use light_bounds::{LightBounds, LightExtent};
    use light_math::Aabb;

    fn cluster(x: f32, power: f32) -> Cluster {
        Cluster {
            center: Vec3::X * x,
            power,
            ..Cluster::NOTHING
        }
    }

    #[test]
    fn the_brightest_is_found_and_left_out_of_the_cost() {
        let clusters = [cluster(3.0, 1.0), cluster(7.0, 1e9), cluster(5.0, 1.0)];
        let dominant = Dominant::of(&clusters, Vec3::ZERO).expect("one outshines the rest");
        assert_eq!(dominant.place, 1, "the brightest");
        // Two of power 1, one length from their mean.
        assert!((dominant.rest_cost - 2.0).abs() < 1e-5, "{dominant:?}");
    }

    #[test]
    fn among_equals_none_is_dominant() {
        let equals = [1.0, 2.0, 3.0].map(|x| cluster(x, 1.0));
        assert!(Dominant::of(&equals, Vec3::ZERO).is_none(), "a third each");
        assert!(
            Dominant::of(&equals[..1], Vec3::ZERO).is_none(),
            "one has no rest"
        );
    }

    /// Points in a cube, `bright` of which has as much power as all others together.
    fn with_one_bright(count: u16, bright: u16) -> Vec<LightExtent> {
        let light = |i: u16| {
            let along = |prime: u16| f32::from(i.wrapping_mul(prime) % 101);
            LightExtent::Bounded(LightBounds {
                bounds: Aabb::from_point(Vec3::new(along(37), along(59), along(83))),
                w: Vec3::Z,
                phi: if i == bright { f32::from(count) } else { 1.0 },
                cos_theta_o: -1.0,
                cos_theta_e: 0.0,
                two_sided: false,
            })
        };
        (0..count).map(light).collect()
    }

    /// The moments of no group of others are then about the bright one.
    #[test]
    fn a_bright_light_is_a_child_of_the_root() {
        for count in [100, 2000, 5000] {
            for bright in [0, 17, count - 1] {
                let tree = LightBvh::build(&with_one_bright(count, bright)).expect("valid lights");
                let (mut slot, mut above) = (tree.slots[usize::from(bright)], 0);
                while slot != u32::MAX {
                    slot = tree.nodes[slot as usize / WIDTH].parent;
                    above += 1;
                }
                assert_eq!(above, 1, "levels of light {bright} of {count}");
            }
        }
    }
}
