use core::f64::consts::PI;

use light_bounds::{InfiniteBounds, LightBounds, LightExtent, LightSampleContext};
use light_math::{Aabb, glam::Vec3};

use crate::real3::{Real3, cross, dot, length, normalize, real3, sub, vec3};

/// A light so simple that its contribution is a line of code: the truth that samplers are held to.
#[derive(Clone, Copy, Debug)]
pub enum Emitter {
    /// A triangle that emits `radiance` on its counter-clockwise side, or on both.
    Triangle {
        /// The corners.
        corners: [Vec3; 3],
        /// Radiance, in W·m⁻²·sr⁻¹.
        radiance: f32,
        /// Whether the clockwise side emits too.
        two_sided: bool,
    },
    /// A point that emits `intensity` alike in all directions.
    Point {
        /// Where it is.
        position: Vec3,
        /// Radiant intensity, in W·sr⁻¹.
        intensity: f32,
    },
    /// A spot light with a smooth falloff between two cones.
    Spot {
        /// Where it is.
        position: Vec3,
        /// Where it shines, a unit vector.
        axis: Vec3,
        /// Radiant intensity inside of the inner cone, in W·sr⁻¹.
        intensity: f32,
        /// Cosine of the inner cone's half angle.
        cos_start: f32,
        /// Cosine of the outer cone's half angle, at most `cos_start`.
        cos_end: f32,
    },
    /// The same radiance from everywhere.
    Sky {
        /// Radiance, in W·m⁻²·sr⁻¹.
        radiance: f32,
    },
    /// Light from a single direction.
    Sun {
        /// The unit vector toward it.
        wi: Vec3,
        /// Irradiance on a plane that faces it, in W·m⁻².
        irradiance: f32,
    },
}

impl Emitter {
    /// Cosines below this are not held against a sampler: bounds in `f32` cannot tell them from zero.
    pub const GRAZING: f64 = 1e-5;

    /// What a sampler gets to know.
    #[must_use]
    pub fn extent(&self) -> LightExtent {
        let point = |position, w, intensity, cos_theta_o, cos_theta_e| {
            LightExtent::Bounded(LightBounds {
                bounds: Aabb::from_point(position),
                w,
                phi: (4.0 * PI) as f32 * intensity,
                cos_theta_o,
                cos_theta_e,
                two_sided: false,
            })
        };
        match *self {
            Self::Triangle {
                corners,
                radiance,
                two_sided,
            } => LightExtent::Bounded(LightBounds {
                bounds: Aabb::from_points(corners),
                w: vec3(self.normal()).normalize_or(Vec3::Z),
                phi: (PI * self.area() * f64::from(radiance)) as f32,
                cos_theta_o: 1.0,
                cos_theta_e: 0.0,
                two_sided,
            }),
            Self::Point {
                position,
                intensity,
            } => point(position, Vec3::Z, intensity, -1.0, 0.0),
            Self::Spot {
                position,
                axis,
                intensity,
                cos_start,
                cos_end,
            } => {
                let band = f64::from(cos_end).acos() - f64::from(cos_start).acos();
                point(position, axis, intensity, cos_start, band.cos() as f32)
            }
            Self::Sky { radiance } => LightExtent::Infinite(InfiniteBounds::uniform(radiance)),
            Self::Sun { wi, irradiance } => {
                LightExtent::Infinite(InfiniteBounds::distant(irradiance, wi))
            }
        }
    }

    /// Emitted power in W; of a light at infinity the power that passes a disk of radius one.
    #[must_use]
    pub fn power(&self) -> f32 {
        match (self.extent(), self) {
            (LightExtent::Infinite(bounds), _) => PI as f32 * bounds.fluence,
            (
                LightExtent::Bounded(bounds),
                Self::Triangle {
                    two_sided: true, ..
                },
            ) => 2.0 * bounds.phi,
            (LightExtent::Bounded(bounds), _) => bounds.phi,
        }
    }

    /// Irradiance at the context without occluders (fluence in a medium), of a triangle by a few of its points; 0
    /// where all cosines are below [`GRAZING`](Self::GRAZING), and for a light whose power vanishes in `f32`.
    #[must_use]
    pub fn contribution(&self, ctx: &LightSampleContext) -> f64 {
        if !(self.power() > 0.0) {
            return 0.0;
        }
        match *self {
            Self::Triangle {
                corners,
                radiance,
                two_sided,
            } => {
                let normal = self.normal();
                let emitted = |wi: Real3| {
                    let cos = -dot(wi, normal);
                    above_grazing(if two_sided { cos.abs() } else { cos })
                };
                // Corners pulled a little inside, and the centroid.
                let middle = corners.iter().fold(Vec3::ZERO, |sum, &p| sum + p / 3.0);
                let points = corners.map(|p| p + (middle - p) * 0.05);
                let received = points.iter().chain([&middle]);
                let mean = received
                    .map(|&p| received_from(ctx, p, emitted))
                    .sum::<f64>()
                    / 4.0;
                f64::from(radiance) * self.area() * mean
            }
            Self::Point {
                position,
                intensity,
            } => received_from(ctx, position, |_| f64::from(intensity)),
            Self::Spot {
                position,
                axis,
                intensity,
                cos_start,
                cos_end,
            } => received_from(ctx, position, |wi| {
                let [start, end] = [cos_start, cos_end].map(f64::from);
                let beyond = above_grazing(-dot(wi, real3(axis)) - end);
                let rise = if end + beyond >= start {
                    1.0
                } else {
                    beyond / (start - end)
                };
                f64::from(intensity)
                    * if beyond > 0.0 {
                        rise * rise * (3.0 - 2.0 * rise)
                    } else {
                        0.0
                    }
            }),
            Self::Sky { radiance } => {
                f64::from(radiance) * if ctx.is_medium() { 4.0 * PI } else { PI }
            }
            Self::Sun { wi, irradiance } => f64::from(irradiance) * cosine(ctx, real3(wi)),
        }
    }

    /// The unit normal of a triangle; zero for one without area and for other lights.
    fn normal(&self) -> Real3 {
        normalize(self.doubled_area())
    }

    fn area(&self) -> f64 {
        0.5 * length(self.doubled_area())
    }

    fn doubled_area(&self) -> Real3 {
        match *self {
            Self::Triangle { corners, .. } => {
                let [a, b, c] = corners.map(real3);
                cross(sub(b, a), sub(c, a))
            }
            _ => [0.0; 3],
        }
    }
}

/// What arrives from `p`, which emits `emitted(wi)` per solid angle against the direction `wi` toward it.
fn received_from(ctx: &LightSampleContext, p: Vec3, emitted: impl Fn(Real3) -> f64) -> f64 {
    let to_light = sub(real3(p), real3(ctx.p));
    let dist_sq = dot(to_light, to_light);
    if dist_sq == 0.0 {
        return 0.0;
    }
    let wi = normalize(to_light);
    emitted(wi) * cosine(ctx, wi) / dist_sq
}

/// The cosine at a one-sided receiver; 1 in a medium.
fn cosine(ctx: &LightSampleContext, wi: Real3) -> f64 {
    if ctx.is_medium() {
        1.0
    } else {
        above_grazing(dot(real3(ctx.ns), wi))
    }
}

fn above_grazing(cos: f64) -> f64 {
    if cos > Emitter::GRAZING { cos } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contributions_of_each_kind() {
        let up = LightSampleContext::surface(Vec3::ZERO, Vec3::Z, Vec3::Z);
        let point = Emitter::Point {
            position: Vec3::new(0.0, 0.0, 2.0),
            intensity: 8.0,
        };
        assert_eq!(point.contribution(&up), 2.0, "I / d^2");
        let spot = |axis| Emitter::Spot {
            position: Vec3::new(0.0, 0.0, 2.0),
            axis,
            intensity: 8.0,
            cos_start: 0.9,
            cos_end: 0.9,
        };
        assert_eq!(spot(Vec3::NEG_Z).contribution(&up), 2.0, "on the axis");
        assert_eq!(spot(Vec3::Z).contribution(&up), 0.0, "behind it");
        let sun = |wi| Emitter::Sun {
            wi,
            irradiance: 3.0,
        };
        assert_eq!(sun(Vec3::Z).contribution(&up), 3.0, "noon");
        assert_eq!(sun(Vec3::NEG_Z).contribution(&up), 0.0, "night");
        assert_eq!(sun(Vec3::X).contribution(&up), 0.0, "grazing");
        let fog = LightSampleContext::medium(Vec3::ZERO);
        assert_eq!(
            sun(Vec3::NEG_Z).contribution(&fog),
            3.0,
            "no cosine in a medium"
        );
    }

    #[test]
    fn a_small_triangle_is_a_point_with_a_cosine() {
        let triangle = |two_sided| Emitter::Triangle {
            corners: [
                Vec3::new(0.0, 0.0, 2.0),
                Vec3::new(1e-3, 0.0, 2.0),
                Vec3::new(0.0, 1e-3, 2.0),
            ],
            radiance: 8e6,
            two_sided,
        };
        let below = LightSampleContext::surface(Vec3::ZERO, Vec3::Z, Vec3::Z);
        assert_eq!(
            triangle(false).contribution(&below),
            0.0,
            "seen from behind"
        );
        let value = triangle(true).contribution(&below);
        assert!((value - 1.0).abs() < 1e-5, "L A / d^2 = 4 / 4, not {value}");
    }
}
