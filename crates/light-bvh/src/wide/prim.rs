use light_math::Aabb;
use light_math::glam::Vec3;

/// A light as the builder sorts it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Prim {
    pub(crate) center: Vec3,
    pub(crate) power: f32,
    pub(crate) axis: Vec3,
    pub(crate) light: u32,
}

/// Sums over a group of lights, from which the price of keeping them together follows.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sums {
    power: f32,
    position_sq: f32,
    position: Vec3,
    axis: Vec3,
}

impl Sums {
    /// Adds a light; `low` is any point near the group, so that the variance keeps its precision.
    #[inline]
    pub(crate) fn add(&mut self, prim: &Prim, low: Vec3) {
        let p = prim.center - low;
        self.power += prim.power;
        self.position += p * prim.power;
        self.position_sq += p.length_squared() * prim.power;
        self.axis += prim.axis * prim.power;
    }

    #[inline]
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            power: self.power + other.power,
            position_sq: self.position_sq + other.position_sq,
            position: self.position + other.position,
            axis: self.axis + other.axis,
        }
    }

    /// Power times standard deviation, the more the less the axes agree.
    #[inline]
    pub(crate) fn cost(&self) -> f32 {
        let inv = 1.0 / self.power.max(f32::MIN_POSITIVE);
        let mean = self.position * inv;
        let variance = (self.position_sq * inv - mean.length_squared()).max(0.0);
        let aligned = (self.axis * inv).length_squared();
        self.power * light_math::float::sqrt(variance) * (2.0 - aligned)
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
