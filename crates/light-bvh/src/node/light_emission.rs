use core::f32::consts::PI;

use light_bounds::{EmissionLobe, LightBounds};
use light_math::float;
use light_math::glam::Vec3;

/// Cosine of `theta_e` below which an emitter counts as diffuse.
const DIFFUSE: f32 = 1e-3;

/// Offset of the widest lobe that counts as a spot: one that ends at a cosine of -1/2, as for
/// bounds.
const WIDEST_SPOT: f32 = -1.0 / 3.0;

/// The largest squared spread of a lobe: a larger one does not change where the light emits.
const MAX_SPREAD_SQ: f32 = 1.0;

/// How a group of lights emits, as far as their moments join differently.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    /// Anything.
    Mixed,
    /// Every light emits alike to both sides; the axis has no sign.
    BothSides,
    /// Some light is a spot: the group emits in steps. Axes are unit vectors of single lights,
    /// offsets are cosines beyond which a light emits, and the spread is that of the offsets alone.
    Steps,
}

/// How one light emits, whose peak intensity is `peak * power`.
pub(crate) struct Emission {
    pub(crate) power: f32,
    pub(crate) peak: f32,
    pub(crate) axis: Vec3,
    pub(crate) offset: f32,
    pub(crate) spread_sq: f32,
    pub(crate) shape: Shape,
}

impl Emission {
    /// As a light within the given bounds may emit.
    #[inline(always)]
    pub(crate) fn of_bounds(light: &LightBounds) -> Self {
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

    /// As a light in one point with a lobe emits. The spread is above 0, so that the weight is
    /// above 0 beyond the line, too.
    #[inline(always)]
    pub(crate) fn of_lobe(lobe: &EmissionLobe) -> Self {
        let line = lobe.line();
        let spread_sq = (lobe.spread * lobe.spread).clamp(f32::MIN_POSITIVE, MAX_SPREAD_SQ);
        let emission = Self {
            power: line.peak,
            peak: 1.0,
            axis: line.axis,
            offset: line.offset,
            spread_sq,
            shape: Shape::Mixed,
        };
        if line.offset <= WIDEST_SPOT {
            return emission;
        }
        // A line in the cosine is a step whose offset is evenly spread between its zero and 1.
        let inv_length = 1.0 / line.axis.length();
        let zero = line.offset * inv_length;
        Self {
            axis: line.axis * inv_length,
            offset: 0.5 * (1.0 + zero),
            spread_sq: (1.0 - zero) * (1.0 - zero) * (1.0 / 12.0)
                + spread_sq * (inv_length * inv_length),
            shape: Shape::Steps,
            ..emission
        }
    }
}

/// How one light emits: `peak * phi * max(0, axis * cos - offset)`, at most `peak * phi`.
pub(crate) struct Lobe {
    pub(crate) peak: f32,
    pub(crate) axis: f32,
    pub(crate) offset: f32,
    pub(crate) spread_sq: f32,
    pub(crate) shape: Shape,
}

impl Lobe {
    #[inline]
    pub(crate) fn new(cos_o: f32, cos_e: f32, two_sided: bool) -> Self {
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
        // A smooth step is one whose offset has a Beta(2, 2) distribution over the rim.
        let rim = cos_o - cos_total;
        Self {
            peak: 1.0 / (4.0 * PI),
            axis: 1.0,
            offset: 0.5 * (cos_o + cos_total),
            spread_sq: rim * rim * 0.05,
            shape: Shape::Steps,
        }
    }

    /// The slope of a line in the cosine that is 1 on the axis and 0 at the edge of the cone.
    pub(crate) fn slope(&self) -> f32 {
        match self.shape {
            Shape::Steps => {
                let half_rim = float::sqrt(5.0 * self.spread_sq);
                1.0 / (1.0 - (self.offset - half_rim)).max(1e-4)
            }
            Shape::Mixed | Shape::BothSides => self.axis,
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
