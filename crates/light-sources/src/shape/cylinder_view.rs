use core::f32::consts::{PI, TAU};

use crate::glam::{Vec2, Vec3};
use light_math::float::{asin, safe_sqrt, sin_cos, sqrt};

/// The visible part of the wall of a cylinder around the axis z, from a point in object space.
///
/// A plane through the point and parallel to the axis cuts a strip out of the near wall and one out
/// of the far wall; from outside of the tube the far one is hidden behind the near one, but for
/// what is seen through the open end. Planes are chosen uniformly by angle, and directions in a
/// plane uniformly by the sine of their elevation over both strips: nearly uniform in solid angle,
/// nothing hidden is chosen, and nothing becomes singular at the silhouette.
#[derive(Clone, Copy, Debug)]
pub(super) struct CylinderView {
    /// The point across the axis, its distance from the axis, and the unit vector from there to the
    /// axis.
    across: Vec2,
    distance: f32,
    inward: Vec2,
    /// The lower and the upper rim, relative to the point.
    rims: [f32; 2],
    radius: f32,
    /// Half the angle between the planes that touch the tube; `None` inside of it, where all planes
    /// cut the wall.
    half_angle: Option<f32>,
}

/// A direction toward the wall.
#[derive(Clone, Copy, Debug)]
pub(super) struct WallSample {
    /// The unit direction, and its density in sr^-1.
    pub(super) wi: Vec3,
    pub(super) pdf: f32,
    /// The outward normal of the wall there, across the axis.
    pub(super) normal: Vec2,
    /// Height above the lower rim.
    pub(super) height: f32,
}

/// A strip of the wall, upright, at a distance; from one height to another, relative to the point.
#[derive(Clone, Copy, Debug)]
struct Strip {
    distance: f32,
    low: f32,
    high: f32,
}

/// The visible strips that a plane cuts out, with the outward normals there.
#[derive(Clone, Copy, Debug)]
struct Column {
    near: Option<(Strip, Vec2)>,
    far: Option<(Strip, Vec2)>,
}

impl CylinderView {
    /// The view from `p` of a tube of the given radius, `half_length` to each side of the origin.
    pub(super) fn new(p: Vec3, radius: f32, half_length: f32) -> Self {
        let across = p.truncate();
        let distance = across.length();
        let is_outside = distance > radius;
        Self {
            across,
            distance,
            inward: (-across).try_normalize().unwrap_or(Vec2::X),
            rims: [-half_length - p.z, half_length - p.z],
            radius,
            half_angle: is_outside.then(|| asin(radius / distance)),
        }
    }

    pub(super) fn sample(&self, u: Vec2) -> Option<WallSample> {
        let angle = self.half_angle.unwrap_or(PI) * (2.0 * u.x - 1.0);
        let (sin, cos) = sin_cos(angle);
        let column = self.column(sin, cos);
        let [near, far] =
            [column.near, column.far].map(|strip| strip.map_or(0.0, |s| s.0.measure()));
        let total = near + far;
        let pdf = self.pdf_of(total);
        if !(pdf > 0.0 && pdf.is_finite()) {
            return None;
        }
        let measure = u.y * total;
        let (strip, normal, measure) = if measure < near || far == 0.0 {
            let (strip, normal) = column.near?;
            (strip, normal, measure.min(near))
        } else {
            let (strip, normal) = column.far?;
            (strip, normal, measure - near)
        };
        let height = strip.height_above_low(measure);
        let along = self.horizontal(sin, cos) * strip.distance;
        let to_wall = along.extend(strip.low + height);
        Some(WallSample {
            // Scaled first, because squares of tiny lengths lose their digits.
            wi: (to_wall / to_wall.abs().max_element()).try_normalize()?,
            pdf,
            normal,
            height: strip.low - self.rims[0] + height,
        })
    }

    /// The density of the direction `wi`, where a ray may start by `moved` beside the point.
    pub(super) fn pdf(&self, wi: Vec3, moved: f32) -> f32 {
        let pdf = || {
            let horizontal = wi.truncate().length();
            let direction = wi.truncate().try_normalize()?;
            let (sin, cos) = (self.inward.perp_dot(direction), self.inward.dot(direction));
            // The wall is enlarged by the rounding error of the direction, and by that of the point.
            let turned = 4.0 * f32::EPSILON / horizontal;
            let aside = turned * self.distance + moved;
            let is_outside = self.half_angle.is_some();
            if is_outside && !(cos > 0.0 && sin.abs() * self.distance <= self.radius + aside) {
                return None;
            }
            let column = self.column(sin, cos);
            let slope = wi.z / horizontal;
            let depth = self.depth_change(sin, aside);
            let is_met = |strip: Option<(Strip, Vec2)>| {
                strip.is_some_and(|(s, _)| {
                    let height = slope * s.distance;
                    let rim = turned * (s.distance + height.abs()) + moved * (1.0 + slope.abs());
                    let slack = rim + slope.abs() * depth;
                    (s.low - slack..=s.high + slack).contains(&height)
                })
            };
            let total = [column.near, column.far].map(|strip| strip.map_or(0.0, |s| s.0.measure()));
            let pdf = self.pdf_of(total[0] + total[1]);
            ((is_met(column.near) || is_met(column.far)) && pdf.is_finite()).then_some(pdf)
        };
        pdf().unwrap_or(0.0)
    }

    /// How far the wall recedes where the plane is moved by the small length `aside`: by much more
    /// at the silhouette than elsewhere.
    fn depth_change(&self, sin: f32, aside: f32) -> f32 {
        let offset = (self.distance * sin).abs();
        aside + self.half_chord((offset - aside).max(0.0)) - self.half_chord(offset + aside)
    }

    /// Half of the chord that a plane at this distance from the axis cuts out of the circle.
    fn half_chord(&self, offset: f32) -> f32 {
        safe_sqrt((self.radius - offset) * (self.radius + offset))
    }

    fn pdf_of(&self, measure: f32) -> f32 {
        1.0 / (self.half_angle.map_or(TAU, |half| 2.0 * half) * measure)
    }

    /// The unit vector across the axis at the given angle from inward.
    fn horizontal(&self, sin: f32, cos: f32) -> Vec2 {
        self.inward * cos + self.inward.perp() * sin
    }

    /// The visible wall in the plane at the given angle from inward.
    fn column(&self, sin: f32, cos: f32) -> Column {
        let [low, high] = self.rims;
        // Half of the chord and its middle, along the plane.
        let offset = self.distance * sin;
        let half = self.half_chord(offset);
        let middle = self.distance * cos;
        let side = self.horizontal(sin, cos);
        let normal = |along: f32| (self.across + side * along).normalize_or(side);
        // The product of both distances, from which the smaller one comes without cancellation.
        let power = (self.distance - self.radius) * (self.distance + self.radius);
        if self.half_angle.is_none() {
            let distance = if middle >= 0.0 {
                middle + half
            } else {
                power / (middle - half)
            };
            let strip = Strip {
                distance,
                low,
                high,
            };
            return Column {
                near: None,
                far: Some((strip, normal(distance))),
            };
        }
        let far_distance = middle + half;
        let near_distance = power / far_distance;
        let near = Strip {
            distance: near_distance,
            low,
            high,
        };
        // Over the rim of the near wall, or under it.
        let ratio = far_distance / near_distance;
        let far = Strip {
            distance: far_distance,
            low: if high < 0.0 {
                low.max(high * ratio)
            } else {
                low
            },
            high: if low > 0.0 {
                high.min(low * ratio)
            } else {
                high
            },
        };
        let is_seen = (high < 0.0 || low > 0.0) && far.low < far.high;
        Column {
            near: Some((near, normal(near_distance))),
            far: is_seen.then(|| (far, normal(far_distance))),
        }
    }
}

impl Strip {
    /// The difference of the sines of elevation of its ends.
    fn measure(&self) -> f32 {
        let (sin_low, cos_low) = self.elevation(self.low);
        let (sin_high, cos_high) = self.elevation(self.high);
        if sin_low * sin_high < 0.0 {
            return sin_high - sin_low;
        }
        // The sine of the angle between them, over twice the squared cosine of its half, times the
        // cosines' sum.
        let sin = (self.high - self.low) / self.distance * cos_low * cos_high;
        let measure = sin * (cos_low + cos_high) / (1.0 + cos_low * cos_high + sin_low * sin_high);
        if measure > 0.0 { measure } else { 0.0 }
    }

    /// The height above the lower end up to which the strip has the given measure.
    fn height_above_low(&self, measure: f32) -> f32 {
        let (sin_low, cos_low) = self.elevation(self.low);
        // The growth of sin^2, and from it the sine of the angle between both ends.
        let grown = measure * (2.0 * sin_low + measure);
        let cos = safe_sqrt(cos_low * cos_low - grown);
        let sin_between = measure * cos_low + sin_low * grown / (cos + cos_low);
        let height = self.distance * sin_between / (cos * cos_low);
        height.min(self.high - self.low).max(0.0)
    }

    /// Sine and cosine of the elevation of a height.
    fn elevation(&self, height: f32) -> (f32, f32) {
        let inverse = 1.0 / sqrt(self.distance * self.distance + height * height);
        (height * inverse, self.distance * inverse)
    }
}
