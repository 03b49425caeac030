use light_bounds::{LightBounds, LightExtent};
use light_math::Aabb;
use light_math::glam::Vec3;

use crate::node::covariance::{Covariance, LEAST_AXIS};
use crate::node::light_emission::{Emission, Lobe, Shape};
use crate::node::sheet_code::SheetCode;

/// How much of the squared depth of a group of ramps, over its squared width, counts as squared
/// spread. Chosen by V: see `docs/light-bvh-study.md`.
const RAMP_BY_DEPTH: f32 = 15.0;

/// The least cosine of the edge of opposed beams: wide ones overlap.
const LEAST_OPPOSED: f32 = 0.3;

/// By how much the squared length of the mean along a line exceeds that of the mean axis in a group of
/// opposed beams. Chosen by V: see `docs/light-bvh-study.md`.
const BOTH_WAYS: f32 = 0.5;

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
    /// Of a group of steps the mean of axes turned into one half space: as long as they lie along one
    /// line.
    pub(crate) line: Vec3,
    /// Mean offset.
    pub(crate) offset: f32,
    /// Mean squared deviation of axis and offset.
    pub(crate) spread_sq: f32,
    /// Mean squared deviation of the axis alone.
    pub(crate) axis_var: f32,
    /// The depth: mean squared product of the axis and the position relative to the mean, over the
    /// squared [`width`](Self::width).
    pub(crate) depth_var: f32,
    /// The covariance of positions, over the squared width.
    pub(crate) covariance: Covariance,
    /// How the emission is shaped.
    pub(crate) shape: Shape,
    /// Whether the edge of the emission is that of a mean: of several lights, or of a measured one.
    pub(crate) is_mean: bool,
}

impl Moments {
    /// The moments of no light, or of lights that are off.
    pub(crate) const NOTHING: Self = Self {
        power: 0.0,
        bounds: Aabb::EMPTY,
        mean: Vec3::ZERO,
        axis: Vec3::ZERO,
        line: Vec3::ZERO,
        offset: 0.0,
        spread_sq: 0.0,
        axis_var: 0.0,
        depth_var: 0.0,
        covariance: Covariance::ZERO,
        shape: Shape::Mixed,
        is_mean: false,
    };

    /// The moments of one light; `inv_total` is one over the power of all lights together.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
    pub(crate) fn of_light(extent: &LightExtent, inv_total: f64) -> Self {
        let (light, emission) = match extent {
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
            line: emission.axis,
            offset: emission.offset,
            spread_sq: emission.spread_sq,
            axis_var: 0.0,
            depth_var: 0.0,
            covariance: Covariance::ZERO,
            shape: emission.shape,
            is_mean: matches!(extent, LightExtent::Lobe(..)),
        }
    }

    /// The sum of the half extents of the box about the mean position that holds all lights.
    pub(crate) fn width(&self) -> f32 {
        let Aabb { min, max } = self.bounds;
        (max - self.mean).max(self.mean - min).element_sum()
    }

    /// What counts as squared spread of a group seen from one place.
    ///
    /// Of ramps also their depth: a near receiver is in front of some and behind others. Of steps
    /// that of the offsets and of the directions; of these less where the cones are narrow, for
    /// few of them matter to one receiver.
    pub(crate) fn total_spread_sq(&self) -> f32 {
        match self.shape {
            Shape::Steps => {
                let counted = (3.0 * (1.0 - self.offset)).clamp(0.0, 1.0 / 3.0);
                self.spread_sq + self.deviation_sq() * counted
            }
            Shape::Mixed | Shape::BothSides => self.spread_sq + RAMP_BY_DEPTH * self.depth_var,
        }
    }

    /// The axis of the code: of opposed beams that of their line.
    pub(crate) fn coded_axis(&self) -> Vec3 {
        if self.is_opposed() {
            self.line
        } else {
            self.axis
        }
    }

    /// The mean squared deviation of axes from [that of the code](Self::coded_axis).
    fn deviation_sq(&self) -> f32 {
        let coded = self.coded_axis().length_squared();
        // The mean of squares less the square of the mean, of which `axis_var` is the same.
        (self.axis_var + self.axis.length_squared() - coded).max(0.0)
    }

    /// Whether it is a group of beams that go both ways along a line.
    pub(crate) fn is_opposed(&self) -> bool {
        self.shape == Shape::Steps
            && self.offset > LEAST_OPPOSED
            && self.line.length_squared() - self.axis.length_squared() > BOTH_WAYS
    }

    /// The length of the mean axis of one light: 1 for a flat light, longer for a narrower cone.
    #[inline]
    pub(crate) fn axis_length(light: &LightBounds) -> f32 {
        Lobe::new(light.cos_theta_o, light.cos_theta_e, light.two_sided).slope()
    }

    /// The covariance of positions; that of an evenly filled box for one light.
    #[inline(always)]
    fn own_covariance(&self) -> Covariance {
        if self.is_mean {
            self.covariance
        } else {
            Covariance::of_box(&self.bounds, self.width())
        }
    }

    /// The code of a thin slanted sheet, if the group is one of flat lights that shine to one side.
    pub(crate) fn sheet(&self) -> Option<SheetCode> {
        let is_group = self.is_mean && self.shape == Shape::Mixed;
        if is_group {
            self.covariance.sheet(self.axis)
        } else {
            None
        }
    }

    /// Whether it is a group of many flat lights or points.
    pub(crate) fn is_large(&self) -> bool {
        self.shape != Shape::Steps && self.covariance.is_large()
    }

    /// Whether it is a group of lights along a line.
    pub(crate) fn is_line(&self) -> bool {
        self.covariance.is_line()
    }

    /// Whether the lights of several groups face about the same way, all together.
    pub(crate) fn face_alike(parts: &[Self]) -> bool {
        let power: f32 = parts.iter().map(|p| p.power).sum();
        let axis: Vec3 = parts.iter().map(|p| p.power * p.axis).sum();
        axis.length() >= LEAST_AXIS * power
    }

    /// The moments of several groups together; those that are off do not count.
    pub(crate) fn join(parts: &[Self]) -> Self {
        let parts = || parts.iter().filter(|p| p.power > 0.0);
        let shape = match parts().next() {
            Some(first) if parts().all(|p| p.shape == first.shape) => first.shape,
            Some(_) if parts().any(|p| p.shape == Shape::Steps) => Shape::Steps,
            Some(_) => Shape::Mixed,
            None => return Self::NOTHING,
        };
        let bounds = parts().fold(Aabb::EMPTY, |b, p| b.union(p.bounds));
        let power: f32 = parts().map(|p| p.power).sum();
        let mut joined = Self {
            power,
            bounds,
            mean: Vec3::ZERO,
            axis: Vec3::ZERO,
            line: Vec3::ZERO,
            offset: 0.0,
            spread_sq: 0.0,
            axis_var: 0.0,
            depth_var: 0.0,
            covariance: Covariance::ZERO,
            shape,
            is_mean: true,
        };
        let inv_power = 1.0 / power;
        for part in parts() {
            let share = part.power * inv_power;
            let part = part.in_group(shape, joined.axis);
            // Relative to the lower corner, the mean keeps its precision far from the origin.
            joined.mean += (part.mean - bounds.min) * share;
            joined.axis += part.axis * share;
            if shape == Shape::Steps {
                joined.line += toward(part.line, joined.line) * share;
            }
            joined.offset += part.offset * share;
        }
        joined.mean = (joined.mean + bounds.min).clamp(bounds.min, bounds.max);
        let inv_width = 1.0 / joined.width().max(f32::MIN_POSITIVE);
        for part in parts() {
            let share = part.power * inv_power;
            let part = part.in_group(shape, joined.axis);
            let axis_sq = part.axis.distance_squared(joined.axis);
            let offset = part.offset - joined.offset;
            let relative_width = part.width() * inv_width;
            let from_mean = (part.mean - joined.mean) * inv_width;
            let depth = joined.axis.dot(from_mean);
            let covariance = part.own_covariance();
            joined
                .covariance
                .add(share, &covariance, relative_width, from_mean);
            joined.depth_var +=
                share * (part.depth_var * (relative_width * relative_width) + depth * depth);
            joined.axis_var += share * (part.axis_var + axis_sq);
            let deviation_sq = match shape {
                Shape::Steps => offset * offset,
                Shape::Mixed | Shape::BothSides => axis_sq + offset * offset,
            };
            joined.spread_sq += share * (part.spread_sq + deviation_sq);
        }
        joined
    }

    /// The same lights as a part of a group of the given shape and the axis so far.
    fn in_group(&self, shape: Shape, axis: Vec3) -> Self {
        match (self.shape, shape) {
            (Shape::BothSides, Shape::BothSides) => Self {
                axis: toward(self.axis, axis),
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
            // Half of the lights shine on one place.
            (Shape::BothSides, Shape::Steps) => Self {
                axis: Vec3::ZERO,
                line: Vec3::ZERO,
                offset: 0.0,
                spread_sq: 1.0 / 3.0,
                axis_var: 0.0,
                ..*self
            },
            // A cosine is a step whose offset is evenly spread over [0, 1]; a light that emits
            // alike in all directions is one at -1.
            (Shape::Mixed, Shape::Steps) => {
                let points = (-self.offset).clamp(0.0, 1.0);
                Self {
                    offset: 0.5 - 1.5 * points,
                    spread_sq: (1.0 - points) * (1.0 / 12.0 + 2.25 * points),
                    ..*self
                }
            }
            _ => *self,
        }
    }
}

/// `axis`, or its opposite, in the half space of `line`.
fn toward(axis: Vec3, line: Vec3) -> Vec3 {
    if axis.dot(line) < 0.0 { -axis } else { axis }
}

#[cfg(test)]
mod tests;
