use light_math::glam::Vec3;
use light_math::{Aabb, float};

/// A light as the builder sorts it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Prim {
    pub(crate) center: Vec3,
    pub(crate) power: f32,
    /// The axis of its moments: the narrower the cone, the longer.
    pub(crate) axis: Vec3,
    pub(crate) light: u32,
}

/// Sums over a group of lights, from which the price of keeping them together follows.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sums {
    power: f32,
    position_sq: f32,
    position: Vec3,
    axis_sq: f32,
    axis: Vec3,
}

impl Sums {
    /// The sums of one light; `position` is relative to a point near the group, so that the variance keeps its precision.
    #[inline]
    pub(crate) fn of(prim: &Prim, position: Vec3) -> Self {
        Self {
            power: prim.power,
            position_sq: position.length_squared() * prim.power,
            position: position * prim.power,
            axis_sq: prim.axis.length_squared() * prim.power,
            axis: prim.axis * prim.power,
        }
    }

    #[inline]
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            power: self.power + other.power,
            position_sq: self.position_sq + other.position_sq,
            position: self.position + other.position,
            axis: self.axis + other.axis,
            axis_sq: self.axis_sq + other.axis_sq,
        }
    }

    /// Power times standard deviation of the position, the more the less the axes agree.
    #[inline]
    pub(crate) fn cost(&self) -> f32 {
        let inv = 1.0 / self.power.max(f32::MIN_POSITIVE);
        let mean = self.position * inv;
        let variance = (self.position_sq * inv - mean.length_squared()).max(0.0);
        // To the power of 5/8, which was measured to be best, by square roots.
        let disagreement = 1.0 + self.axis_variance();
        let root = float::sqrt(float::sqrt(disagreement));
        self.power * float::sqrt(variance * disagreement * root)
    }

    /// Variance of the axes.
    #[inline]
    pub(crate) fn axis_variance(&self) -> f32 {
        let inv = 1.0 / self.power.max(f32::MIN_POSITIVE);
        (self.axis_sq * inv - (self.axis * inv).length_squared()).max(0.0)
    }
}

/// A run of lights: a child of a node to be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Run {
    pub(crate) start: usize,
    pub(crate) end: usize,
    /// Box of the centres.
    pub(crate) bounds: Aabb,
    /// What splitting it may gain.
    pub(crate) cost: f32,
}

impl Run {
    pub(crate) const fn len(&self) -> usize {
        self.end - self.start
    }
}
