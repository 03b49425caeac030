//! Trees of lamps on rows that rise, seen from the rows, from around and from afar.

use alloc::vec::Vec;

use light_bounds::{Gloss, LightBounds, LightExtent, LightId, LightSampleContext};
use light_math::Aabb;
use light_math::fraction::stratum;
use light_math::glam::{Quat, Vec3};
use light_testkit::Rng;

use crate::LightBvh;
use crate::node::wide_node::{HAS_RARE, WIDTH};

/// Rows of lamps that face forward, turned as a whole.
struct Rows {
    turn: Quat,
    lamps: Vec<Vec3>,
    power: Vec<f32>,
}

impl Rows {
    fn new(rng: &mut Rng, turn: Quat, scale: f32) -> Self {
        let at = |rng: &mut Rng| {
            let row = (20.0 * rng.f32()).floor();
            scale * Vec3::new(20.0 * rng.f32(), 0.8 * row, 0.4 * row + 0.1)
        };
        Self {
            turn,
            lamps: (0..400).map(|_| turn * at(rng)).collect(),
            power: (0..400).map(|_| rng.log_range(0.5, 1.5)).collect(),
        }
    }

    /// Where the lamps face.
    fn forward(&self) -> Vec3 {
        self.turn * Vec3::NEG_Y
    }

    /// The tree, which has sheets.
    fn tree(&self) -> LightBvh {
        let lamp = |(&at, &phi): (&Vec3, &f32)| {
            LightExtent::Bounded(LightBounds {
                bounds: Aabb::from_point(at),
                w: self.forward(),
                phi,
                cos_theta_o: 1.0,
                cos_theta_e: 0.0,
                two_sided: false,
            })
        };
        let lamps: Vec<_> = self.lamps.iter().zip(&self.power).map(lamp).collect();
        let tree = LightBvh::build(&lamps).expect("valid lights");
        let sheets = tree.nodes.iter().filter(|node| node.has_rare()).count();
        assert!(sheets > 0, "the rows are sheets");
        tree
    }

    /// What lamp `k` gives a matt surface, but for a factor; 0 or below if nothing.
    fn received(&self, k: usize, p: Vec3, n: Vec3) -> f64 {
        let [p, n, at, forward] = [p, n, self.lamps[k], self.forward()].map(double);
        let way = [0, 1, 2].map(|i| at[i] - p[i]);
        let (height, front, dist_sq) = (dot(n, way), -dot(forward, way), dot(way, way));
        f64::from(self.power[k]) * height.max(0.0) * front.max(0.0) / (dist_sq * dist_sq)
    }
}

fn double(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// The tree as if it had no sheet.
fn without_sheets(tree: &LightBvh) -> LightBvh {
    let mut tree = tree.clone();
    for node in &mut tree.nodes {
        for k in (0..WIDTH).filter(|&k| node.is_sheet(k)).collect::<Vec<_>>() {
            node.offset[k] = 0;
        }
        node.gain &= !HAS_RARE;
    }
    tree
}

#[test]
fn no_light_of_a_slanted_sheet_is_lost() {
    let mut rng = Rng::new(5);
    let mut found = 0;
    for scale in [1.0, 1e-4, 1e4].repeat(5) {
        let turn = Quat::from_rotation_arc(Vec3::Z, rng.direction());
        let rows = Rows::new(&mut rng, turn, scale);
        let tree = rows.tree();
        for i in 0..50 {
            let lamp = rows.lamps[i];
            let away = scale * [1e-3, 0.1, 1.0, 10.0, 1e5][i % 5];
            let (p, n) = (lamp + away * rng.direction(), rng.direction());
            let matt = LightSampleContext::surface(p, n, n);
            let gloss = Gloss {
                wo: n,
                alpha: 0.2,
                diffuse: 0.1,
            };
            for ctx in [matt, matt.with_gloss(gloss)] {
                let pmf = |k: usize| tree.pmf(&ctx, LightId(u32::try_from(k).expect("few")));
                let pmfs: Vec<_> = (0..rows.lamps.len()).map(pmf).collect();
                for (k, &pmf) in pmfs.iter().enumerate() {
                    if rows.received(k, p, n) > 0.0 {
                        assert!(pmf > 0.0, "lamp {k} at {p}, {n}, scale {scale}");
                        found += 1;
                    }
                }
                let total: f64 = pmfs.iter().map(|&pmf| f64::from(pmf)).sum();
                assert!(total < 1.0 + 1e-5, "{total} at {p}, {n}");
                for u in (0..8).map(|j| stratum(j, 8, 1 << 63)) {
                    if let Some(sample) = tree.sample(&ctx, u) {
                        let pmf = pmfs[sample.light.0 as usize];
                        assert_eq!(sample.pmf, pmf, "at {p}, {n}");
                    }
                }
            }
        }
    }
    assert!(found > 40_000, "{found} pairs");
}

#[test]
fn receivers_below_a_sheet_find_what_is_above_them() {
    let mut rng = Rng::new(6);
    let rows = Rows::new(&mut rng, Quat::IDENTITY, 1.0);
    let with = rows.tree();
    let without = without_sheets(&with);
    // On the floor before a row.
    let mut variance = [0.0; 2];
    for _ in 0..400 {
        let row = (20.0 * rng.f32()).floor();
        let p = Vec3::new(20.0 * rng.f32(), 0.8 * (row - rng.f32()), 0.4 * (row - 1.0));
        let received: Vec<_> = (0..rows.lamps.len())
            .map(|k| rows.received(k, p, Vec3::Z))
            .collect();
        let sum: f64 = received.iter().sum();
        let ctx = LightSampleContext::surface(p, Vec3::Z, Vec3::Z);
        for (variance, tree) in variance.iter_mut().zip([&with, &without]) {
            let second = received.iter().enumerate().filter(|&(_, &f)| f > 0.0);
            let second = second.map(|(k, f)| {
                f * f / f64::from(tree.pmf(&ctx, LightId(u32::try_from(k).expect("few"))))
            });
            *variance += (second.sum::<f64>() / (sum * sum) - 1.0) / 400.0;
        }
    }
    let [with, without] = variance;
    assert!(with < 0.75 * without, "{with} instead of {without}");
}
