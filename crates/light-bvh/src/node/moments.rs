use core::f32::consts::PI;

use light_bounds::{EmissionLobe, LightBounds, LightExtent};
use light_math::glam::Vec3;
use light_math::{Aabb, float};

/// Cosine of `theta_e` below which an emitter counts as diffuse.
const DIFFUSE: f32 = 1e-3;

/// Offset of the widest lobe that counts as a spot: one that ends at a cosine of -1/2, as for
/// bounds.
const WIDEST_SPOT: f32 = -1.0 / 3.0;

/// The largest squared spread of a lobe: a larger one does not change where the light emits.
const MAX_SPREAD_SQ: f32 = 1.0;

/// What a node knows of a group of lights: the sums that estimate its irradiance, weighted by peak
/// intensity.
///
/// Toward a unit vector `w` the group emits about `power * max(0, dot(axis, w) - offset)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moments {
    /// Peak intensity, as a share of the power of all lights; 0 only of lights that are off.
    pub(crate) power: f32,
    /// Box of all emitting points.
    pub(crate) bounds: Aabb,
    /// Mean position.
    pub(crate) mean: Vec3,
    /// Mean axis, as long as the emission is directed.
    pub(crate) axis: Vec3,
    /// Mean offset.
    pub(crate) offset: f32,
    /// Mean squared deviation of axis and offset.
    pub(crate) spread_sq: f32,
    /// How the emission is shaped.
    pub(crate) shape: Shape,
}

/// How a group of lights emits, as far as their moments join differently.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    /// Anything.
    Mixed,
    /// Every light emits alike to both sides; the axis has no sign.
    BothSides,
    /// Every light is a spot.
    Spots,
}

impl Moments {
    /// The moments of no light, or of lights that are off.
    pub(crate) const NOTHING: Self = Self {
        power: 0.0,
        bounds: Aabb::EMPTY,
        mean: Vec3::ZERO,
        axis: Vec3::ZERO,
        offset: 0.0,
        spread_sq: 0.0,
        shape: Shape::Mixed,
    };

    /// The moments of one light; `inv_total` is one over the power of all lights together.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
    pub(crate) fn of_light(light: &LightExtent, inv_total: f64) -> Self {
        let (light, emission) = match light {
            LightExtent::Bounded(light) => (light, Emission::of_bounds(light)),
            LightExtent::Lobe(light, lobe) => (light, Emission::of_lobe(lobe)),
            LightExtent::Infinite(_) => return Self::NOTHING,
        };
        let power = (f64::from(emission.power) * inv_total) as f32 * emission.peak;
        Self {
            power: if emission.power > 0.0 || light.phi > 0.0 {
                power.max(f32::MIN_POSITIVE)
            } else {
                0.0
            },
            bounds: light.bounds,
            mean: light.bounds.center(),
            axis: emission.axis,
            offset: emission.offset,
            spread_sq: emission.spread_sq,
            shape: emission.shape,
        }
    }

    /// The length of the mean axis of one light: 1 for a flat light, longer for a narrower cone.
    #[inline]
    pub(crate) fn axis_length(light: &LightBounds) -> f32 {
        Lobe::new(light.cos_theta_o, light.cos_theta_e, light.two_sided).axis
    }

    /// The moments of several groups together; those that are off do not count.
    pub(crate) fn join(parts: &[Self]) -> Self {
        let parts = || parts.iter().filter(|p| p.power > 0.0);
        let shape = match parts().next() {
            Some(first) if parts().all(|p| p.shape == first.shape) => first.shape,
            Some(_) => Shape::Mixed,
            None => return Self::NOTHING,
        };
        let line = parts().next().and_then(|first| first.common_line(parts()));
        let bounds = parts().fold(Aabb::EMPTY, |b, p| b.union(p.bounds));
        let power: f32 = parts().map(|p| p.power).sum();
        let mut joined = Self {
            power,
            bounds,
            mean: Vec3::ZERO,
            axis: Vec3::ZERO,
            offset: 0.0,
            spread_sq: 0.0,
            shape,
        };
        let inv_power = 1.0 / power;
        for part in parts() {
            let share = part.power * inv_power;
            let part = part.in_group(shape, joined.axis);
            // Relative to the lower corner, the mean keeps its precision far from the origin.
            joined.mean += (part.mean - bounds.min) * share;
            joined.axis += part.axis * share;
            joined.offset += part.offset * share;
        }
        joined.mean = (joined.mean + bounds.min).clamp(bounds.min, bounds.max);
        if let Some((axis, offset)) = line {
            return Self {
                axis,
                offset,
                ..joined
            };
        }
        let along = joined.axis.normalize_or_zero();
        for part in parts() {
            let share = part.power * inv_power;
            let part = part.in_group(shape, joined.axis);
            let axis = part.axis - joined.axis;
            let offset = part.offset - joined.offset;
            let deviation_sq = part.spread_sq + shape.deviation_sq(axis, offset, along);
            joined.spread_sq += share * deviation_sq;
        }
        // Deviations may cancel or underflow, but they are deviations: a spread of 0 makes the
        // emission test a hard one.
        joined.spread_sq = joined.spread_sq.max(f32::MIN_POSITIVE);
        joined
    }

    /// Axis and offset of these lights, if all of `parts` emit within the same cone, to the bit,
    /// and none beyond it.
    ///
    /// Then, and only then, the line of the group is as exact as that of each light: no light of it
    /// emits where the line says that nothing is emitted.
    fn common_line<'a>(&self, mut parts: impl Iterator<Item = &'a Self>) -> Option<(Vec3, f32)> {
        let is_alike = |p: &Self| {
            p.spread_sq == 0.0
                && p.axis == self.axis
                && p.offset == self.offset
                && (p.shape == Shape::BothSides) == (self.shape == Shape::BothSides)
        };
        parts.all(is_alike).then_some((self.axis, self.offset))
    }

    /// The same lights as a part of a group of the given shape and the axis so far.
    fn in_group(&self, shape: Shape, axis: Vec3) -> Self {
        match (self.shape, shape) {
            (Shape::BothSides, Shape::BothSides) if self.axis.dot(axis) < 0.0 => Self {
                axis: -self.axis,
                ..*self
            },
            // The axis has no sign and cannot be averaged: mean and variance of |cos| over the
            // sphere.
            (Shape::BothSides, Shape::Mixed) => Self {
                axis: Vec3::ZERO,
                offset: -0.5,
                spread_sq: 1.0 / 3.0 - 0.25,
                ..*self
            },
            _ => *self,
        }
    }
}

impl Shape {
    /// How much a part that deviates by `axis` and `offset` from the mean adds to the squared
    /// spread.
    fn deviation_sq(self, axis: Vec3, offset: f32, along: Vec3) -> f32 {
        if self == Self::Spots {
            // Only directions near the common axis matter, where deviations of axis and offset
            // cancel.
            let forward = axis.dot(along);
            let aside_sq = (axis.length_squared() - forward * forward).max(0.0);
            aside_sq + (forward - offset) * (forward - offset)
        } else {
            axis.length_squared() + offset * offset
        }
    }
}

/// How one light emits, whose peak intensity is `peak * power`.
struct Emission {
    power: f32,
    peak: f32,
    axis: Vec3,
    offset: f32,
    spread_sq: f32,
    shape: Shape,
}

impl Emission {
    /// As a light within the given bounds may emit.
    #[inline(always)]
    fn of_bounds(light: &LightBounds) -> Self {
        let lobe = Lobe::new(light.cos_theta_o, light.cos_theta_e, light.two_sided);
        Self {
            power: light.phi,
            peak: lobe.peak,
            axis: light.w * lobe.axis,
            offset: lobe.offset,
            spread_sq: lobe.spread_sq,
            shape: lobe.shape,
        }
    }

    /// As a light in one point with a lobe emits. However small the spread, it keeps what is
    /// emitted beyond the line alive.
    #[inline(always)]
    fn of_lobe(lobe: &EmissionLobe) -> Self {
        let line = lobe.line();
        Self {
            power: line.peak,
            peak: 1.0,
            axis: line.axis,
            offset: line.offset,
            spread_sq: (lobe.spread * lobe.spread).clamp(f32::MIN_POSITIVE, MAX_SPREAD_SQ),
            shape: if line.offset > WIDEST_SPOT {
                Shape::Spots
            } else {
                Shape::Mixed
            },
        }
    }
}

/// How one light emits: `peak * phi * max(0, axis * cos - offset)`, at most `peak * phi`.
struct Lobe {
    peak: f32,
    axis: f32,
    offset: f32,
    spread_sq: f32,
    shape: Shape,
}

impl Lobe {
    #[inline]
    fn new(cos_o: f32, cos_e: f32, two_sided: bool) -> Self {
        if cos_e.abs() < DIFFUSE {
            return Self::diffuse(cos_o, cos_e, two_sided);
        }
        // The sum of the angles is pi or more where `cos(o) <= cos(pi - e)`; the sign of the sum of
        // two floats is exact.
        let is_everywhere = cos_o + cos_e <= 0.0;
        let sin = |cos: f32| float::sqrt((1.0 - cos) * (1.0 + cos));
        let cos_total = cos_o * cos_e - sin(cos_o) * sin(cos_e);
        if is_everywhere || cos_total <= -0.5 || two_sided {
            return Self::diffuse(-1.0, 0.0, false);
        }
        // A line in the cosine, from 1 on the axis to 0 at the edge of the cone.
        let slope = 1.0 / (1.0 - cos_total).max(1e-4);
        Self {
            peak: 1.0 / (4.0 * PI),
            axis: slope,
            offset: slope - 1.0,
            spread_sq: 0.0,
            shape: Shape::Spots,
        }
    }

    /// A diffuse surface whose normals fill a cone of half angle `theta_o`; a point or a sphere
    /// fills all directions. What it emits beyond a right angle, if `theta_e` is a little more, is
    /// not given up.
    fn diffuse(cos_theta_o: f32, cos_theta_e: f32, two_sided: bool) -> Self {
        let mean_cos = 0.5 + 0.5 * cos_theta_o;
        let rest = 1.0 - mean_cos;
        if two_sided {
            return Self {
                peak: 1.0 / PI,
                axis: mean_cos,
                offset: 0.0,
                spread_sq: rest * (1.0 + mean_cos),
                shape: Shape::BothSides,
            };
        }
        Self {
            peak: (1.0 - 0.75 * rest) / PI,
            axis: mean_cos,
            offset: cos_theta_e.min(0.0) - rest,
            spread_sq: rest * mean_cos,
            shape: Shape::Mixed,
        }
    }
}

#[cfg(test)]
mod tests;
