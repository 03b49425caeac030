use light_math::float;
use light_math::glam::Vec3;

use crate::build::light_primitive::LightPrimitive;

/// A light, or a few neighbours on the curve, as the builder splits them.
///
/// Aligned as three vectors of four floats, which move in three instructions.
#[derive(Clone, Copy, Debug)]
#[repr(align(16))]
pub(crate) struct Cluster {
    /// Mean position.
    pub(crate) center: Vec3,
    pub(crate) power: f32,
    /// Mean axis of their moments: the narrower a cone, the longer.
    pub(crate) axis: Vec3,
    /// Mean squared length of the axes.
    pub(crate) axis_sq: f32,
    /// Variance of the positions.
    pub(crate) variance: f32,
    /// The place of the first of the lights along the curve.
    pub(crate) first: u32,
    pub(crate) lights: u32,
}

impl Cluster {
    /// No lights.
    pub(crate) const NOTHING: Self = Self {
        center: Vec3::ZERO,
        power: 0.0,
        axis: Vec3::ZERO,
        axis_sq: 0.0,
        variance: 0.0,
        first: 0,
        lights: 0,
    };

    /// One light; `place` is its place along the curve.
    #[inline]
    pub(crate) fn of_primitive(primitive: &LightPrimitive, place: u32) -> Self {
        Self {
            center: primitive.center,
            power: primitive.power,
            axis: primitive.axis,
            axis_sq: primitive.axis.length_squared(),
            variance: 0.0,
            first: place,
            lights: 1,
        }
    }

    /// Neighbours together, that follow each other along the curve.
    pub(crate) fn join(parts: impl IntoIterator<Item = Self>) -> Self {
        let mut all = parts.into_iter();
        let Some(first) = all.next() else {
            return Self::NOTHING;
        };
        let mut sums = Sums::of(&first, Vec3::ZERO);
        let mut lights = first.lights;
        for part in all {
            sums = sums.plus(&Sums::of(&part, part.center - first.center));
            lights += part.lights;
        }
        let inv = 1.0 / sums.power().max(f32::MIN_POSITIVE);
        let mean = sums.position() * inv;
        Self {
            center: first.center + mean,
            power: sums.power(),
            axis: sums.axis() * inv,
            axis_sq: sums.0[8] * inv,
            variance: (sums.0[7] * inv - mean.length_squared()).max(0.0),
            first: first.first,
            lights,
        }
    }
}

/// Sums over a group of lights, from which the cost of keeping them together follows.
///
/// Position, power, axis, squared position, squared axis: all but the second are times power. An
/// array, so that the compiler adds several at once.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sums(pub(crate) [f32; 9]);

impl Sums {
    /// The sums of some lights; `position` is relative to a point near the group, so that the
    /// variance keeps its precision.
    #[inline]
    pub(crate) fn of(cluster: &Cluster, position: Vec3) -> Self {
        let p = position * cluster.power;
        let w = cluster.axis * cluster.power;
        let position_sq = (position.length_squared() + cluster.variance) * cluster.power;
        let axis_sq = cluster.axis_sq * cluster.power;
        Self([
            p.x,
            p.y,
            p.z,
            cluster.power,
            w.x,
            w.y,
            w.z,
            position_sq,
            axis_sq,
        ])
    }

    #[inline]
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self(core::array::from_fn(|i| self.0[i] + other.0[i]))
    }

    /// 0 for no lights.
    #[inline]
    pub(crate) const fn power(&self) -> f32 {
        self.0[3]
    }

    fn position(&self) -> Vec3 {
        Vec3::new(self.0[0], self.0[1], self.0[2])
    }

    fn axis(&self) -> Vec3 {
        Vec3::new(self.0[4], self.0[5], self.0[6])
    }

    /// Power times standard deviation of the position, the more the less the axes agree.
    #[inline(always)]
    pub(crate) fn cost(&self) -> f32 {
        let [px, py, pz, power, _, _, _, position_sq, _] = self.0;
        let inv = 1.0 / power.max(f32::MIN_POSITIVE);
        let variance = position_sq * inv - (px * px + py * py + pz * pz) * (inv * inv);
        // To the power of 5/8, which was measured to be best, by square roots.
        let disagreement = 1.0 + self.axis_variance();
        let root = float::sqrt(float::sqrt(disagreement));
        power * float::sqrt(variance.max(0.0) * disagreement * root)
    }

    /// Variance of the axes.
    #[inline(always)]
    fn axis_variance(&self) -> f32 {
        let [_, _, _, power, wx, wy, wz, _, axis_sq] = self.0;
        let inv = 1.0 / power.max(f32::MIN_POSITIVE);
        (axis_sq * inv - (wx * wx + wy * wy + wz * wz) * (inv * inv)).max(0.0)
    }
}
