//! Two rooms side by side, with a door in the wall between them, and lamps under the ceiling.

use light_bvh::LightBvh;
use light_bvh::light_bounds::light_math::{Aabb, glam::Vec3};
use light_bvh::light_bounds::{LightExtent, LightId, LightSampleContext};
use light_bvh::visibility::CellKey;
use light_testkit::Rng;

use crate::support::lamp;

/// Length, width and height of a room; the wall is where x is 0.
const SIZE: Vec3 = Vec3::new(8.0, 8.0, 3.0);

/// The edges of the door: along y, and its height.
const DOOR: [f32; 3] = [3.5, 4.5, 2.0];

pub(crate) struct Rooms {
    pub(crate) tree: LightBvh,
    /// Where each is, and its power.
    pub(crate) lamps: Vec<(Vec3, f32)>,
    has_wall: bool,
}

impl Rooms {
    /// With this many lamps in both rooms together.
    pub(crate) fn new(lamps: usize, has_wall: bool) -> Self {
        let mut rng = Rng::new(11);
        let lamps: Vec<_> = (0..lamps)
            .map(|_| {
                let p = rng.vec3() * Vec3::new(2.0, 1.0, 0.1) + Vec3::new(-1.0, 0.0, 0.88);
                let brighter = if p.x < 0.0 { 1.0 } else { 30.0 };
                (p * SIZE, brighter * rng.log_range(1.0, 300.0))
            })
            .collect();
        let extents: Vec<LightExtent> = lamps.iter().map(|&(p, phi)| lamp(p, phi)).collect();
        let tree = LightBvh::build(&extents).expect("valid lights");
        Self {
            tree,
            lamps,
            has_wall,
        }
    }

    /// Whether a point of the floor sees a lamp.
    pub(crate) fn sees(&self, p: Vec3, light: LightId) -> bool {
        let q = self.lamps[light.index()].0;
        if !self.has_wall || (p.x < 0.0) == (q.x < 0.0) {
            return true;
        }
        let at = p.lerp(q, p.x / (p.x - q.x));
        at.y > DOOR[0] && at.y < DOOR[1] && at.z < DOOR[2]
    }

    /// A point of the floor.
    pub(crate) fn floor(p: Vec3) -> LightSampleContext {
        LightSampleContext::surface(p.with_z(0.0), Vec3::Z, Vec3::Z)
    }

    /// This many points of the floor in a cell.
    pub(crate) fn places(key: CellKey, count: usize) -> Vec<LightSampleContext> {
        let Aabb { min, max } = key.bounds();
        let mut rng = Rng::new(key.seed());
        let low = Vec3::new(-SIZE.x, 0.0, 0.0);
        let within = |p: Vec3| p.clamp(low, SIZE);
        let (min, max) = (within(min), within(max));
        let place = |_| Self::floor(min + (max - min) * rng.vec3());
        (0..count).map(place).collect()
    }

    /// Points of the floor of the left room, evenly.
    pub(crate) fn receivers() -> impl Iterator<Item = Vec3> {
        (0..400u16).map(|i| {
            let [x, y] = [i % 20, i / 20].map(|k| (f32::from(k) + 0.5) / 20.0);
            Vec3::new(-8.0 * x, 8.0 * y, 0.0)
        })
    }
}
