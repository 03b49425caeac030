use light_sets::BenchSet;
use lights::glam::DVec3;
use lights::math::fraction::to_f64;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Share of the set's box that all spheres together have as volume.
const FILLING: f64 = 0.1;

/// Occluding spheres among the lights of a set, unknown to the samplers.
#[derive(Clone, Debug, Default)]
pub(super) struct Occluders {
    spheres: Vec<DVec3>,
    radius_sq: f64,
}

impl Occluders {
    /// `count` spheres of one size at random positions in the box of the set's lights and points.
    pub(super) fn among(set: &BenchSet, count: usize) -> Self {
        let places = || {
            let lights = set.lights.iter().map(|light| light.position());
            lights.chain(set.points.iter().map(|at| at.p.as_dvec3()))
        };
        let low = places().fold(DVec3::INFINITY, DVec3::min);
        let size = places().fold(DVec3::NEG_INFINITY, DVec3::max) - low;
        let mut rng = Pcg64Mcg::seed_from_u64(0x0CC1);
        let volume = size.x * size.y * size.z * FILLING / count.max(1) as f64;
        let radius = (volume * 0.75 * core::f64::consts::FRAC_1_PI).cbrt();
        Self {
            spheres: (0..count)
                .map(|_| {
                    low + size
                        * DVec3::new(
                            to_f64(rng.next_u64()),
                            to_f64(rng.next_u64()),
                            to_f64(rng.next_u64()),
                        )
                })
                .collect(),
            radius_sq: radius * radius,
        }
    }

    /// Whether a sphere lies between `a` and `b`.
    pub(super) fn block(&self, a: DVec3, b: DVec3) -> bool {
        let way = b - a;
        let inv_length_sq = 1.0 / way.length_squared().max(f64::MIN_POSITIVE);
        self.spheres.iter().any(|&center| {
            let t = ((center - a).dot(way) * inv_length_sq).clamp(0.0, 1.0);
            (a + way * t).distance_squared(center) < self.radius_sq
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_lies_between_blocks() {
        let sphere = Occluders {
            spheres: vec![DVec3::X],
            radius_sq: 0.01,
        };
        assert!(sphere.block(DVec3::ZERO, DVec3::X * 2.0), "between");
        assert!(!sphere.block(DVec3::X * 2.0, DVec3::X * 3.0), "behind");
        assert!(!sphere.block(DVec3::ZERO, DVec3::Y), "aside");
        assert!(!Occluders::default().block(DVec3::ZERO, DVec3::X), "none");
    }
}
