use core::f64::consts::PI;

use light_bounds::LightSampleContext;
use light_math::glam::Vec3;
use light_sets::{SetLight, glam::DVec3};

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
            Self::Set(light) => {
                let points = points(&light);
                let received = points.iter().map(|&from| {
                    light.contribution_from(from, ctx.p, Self::GRAZING, |wi| {
                        cosine(ctx, wi.to_array())
                    })
                });
                received.sum::<f64>() / points.len() as f64
            }
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
            Self::Sky { radiance } => f64::from(radiance) * ctx.ns().map_or(4.0 * PI, |_| PI),
            Self::Sun { wi, irradiance } => f64::from(irradiance) * cosine(ctx, real3(wi)),
        }
    }
}

/// Where a light emits: of a triangle its corners, pulled a little inside, and its centroid.
fn points(light: &SetLight) -> Vec<DVec3> {
    match light {
        SetLight::Triangle { vertices, .. } => {
            let middle = light.position();
            let inside = vertices.map(|v| v.as_dvec3().lerp(middle, 0.05));
            [&inside[..], &[middle]].concat()
        }
        SetLight::Point { .. } | SetLight::Spot { .. } => vec![light.position()],
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
    ctx.ns().map_or(1.0, |ns| above_grazing(dot(real3(ns), wi)))
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
        let point = Emitter::Set(SetLight::Point {
            p: Vec3::new(0.0, 0.0, 2.0),
            intensity: 8.0,
        });
        assert_eq!(point.contribution(&up), 2.0, "I / d^2");
        let spot = |axis: Vec3| {
            Emitter::Set(SetLight::Spot {
                p: Vec3::new(0.0, 0.0, 2.0),
                target: Vec3::new(0.0, 0.0, 2.0) + axis,
                intensity: 8.0,
                cone_deg: 25.0,
                delta_deg: 0.0,
            })
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
        let triangle = |two_sided| {
            Emitter::Set(SetLight::Triangle {
                vertices: [
                    Vec3::new(0.0, 0.0, 2.0),
                    Vec3::new(1e-3, 0.0, 2.0),
                    Vec3::new(0.0, 1e-3, 2.0),
                ],
                radiance: 8e6,
                two_sided,
            })
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
