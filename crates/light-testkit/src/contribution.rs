use core::f64::consts::PI;

use light_bounds::LightSampleContext;
use light_math::glam::Vec3;

use crate::Emitter;
use crate::real3::{Real3, dot, normalize, real3, sub};

impl Emitter {
    /// Irradiance at the context without occluders (fluence in a medium), of a triangle by a few of
    /// its points; 0 where all cosines are below [`GRAZING`](Self::GRAZING), and for a light whose
    /// power vanishes in `f32`.
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
            Self::Lantern {
                position,
                axis,
                beam,
                stray,
                cos_beam,
            } => received_from(ctx, position, |wi| {
                let in_beam = -dot(wi, real3(axis)) > f64::from(cos_beam);
                f64::from(if in_beam { beam } else { stray })
            }),
            Self::Sky { radiance } => {
                f64::from(radiance) * if ctx.is_medium() { 4.0 * PI } else { PI }
            }
            Self::Sun { wi, irradiance } => f64::from(irradiance) * cosine(ctx, real3(wi)),
        }
    }
}

/// What arrives from `p`, which emits `emitted(wi)` per solid angle against the direction `wi`
/// toward it.
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
