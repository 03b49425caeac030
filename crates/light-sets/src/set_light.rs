use core::f64::consts::PI;

use glam::{DVec3, Quat, Vec3};
use light_bounds::LightBounds;
use light_math::Aabb;

use crate::set_point::SetPoint;

/// A light of a light set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SetLight {
    /// A diffuse triangle.
    Triangle {
        /// The vertices, counter-clockwise as seen from the emitting side.
        vertices: [Vec3; 3],
        /// Emitted radiance.
        radiance: f32,
        /// Whether the other side emits as well.
        two_sided: bool,
    },
    /// An isotropic point light.
    Point {
        /// Position.
        p: Vec3,
        /// Radiant intensity.
        intensity: f32,
    },
    /// A spot light with a soft edge.
    Spot {
        /// Position.
        p: Vec3,
        /// A point on the axis.
        target: Vec3,
        /// Radiant intensity along the axis.
        intensity: f32,
        /// Half angle of the cone, in degrees.
        cone_deg: f32,
        /// Width of the soft edge inside the cone, in degrees.
        delta_deg: f32,
    },
}

impl SetLight {
    /// The light's position; the centroid of a triangle.
    #[must_use]
    pub fn position(&self) -> DVec3 {
        match self {
            Self::Triangle {
                vertices: [a, b, c],
                ..
            } => (a.as_dvec3() + b.as_dvec3() + c.as_dvec3()) / 3.0,
            Self::Point { p, .. } | Self::Spot { p, .. } => p.as_dvec3(),
        }
    }

    /// The same light, displaced by a vector in scene units.
    #[must_use]
    pub fn moved(&self, by: Vec3) -> Self {
        self.mapped(|p| p + by)
    }

    /// The same light turned about the origin.
    #[must_use]
    pub(crate) fn turned(&self, by: Quat) -> Self {
        self.mapped(|p| by * p)
    }

    /// The same light with other points.
    fn mapped(&self, map: impl Fn(Vec3) -> Vec3) -> Self {
        let mut light = *self;
        match &mut light {
            Self::Triangle { vertices, .. } => *vertices = vertices.map(map),
            Self::Point { p, .. } => *p = map(*p),
            Self::Spot { p, target, .. } => {
                *p = map(*p);
                *target = map(*target);
            }
        }
        light
    }

    /// The irradiance at `at` without occlusion, with the whole light at its position.
    #[must_use]
    pub fn contribution(&self, at: &SetPoint) -> f64 {
        let n = at.n.as_dvec3();
        self.contribution_from(self.position(), at.p, 0.0, |wi| n.dot(wi).max(0.0))
    }

    /// The irradiance at `at` with the whole light at `position`, times `response` to the unit
    /// vector toward it. Directions whose cosine at the light is less than `grazing` inside of
    /// where emission ends count as outside.
    #[must_use]
    pub fn contribution_from(
        &self,
        position: DVec3,
        at: Vec3,
        grazing: f64,
        response: impl FnOnce(DVec3) -> f64,
    ) -> f64 {
        let to_light = position - at.as_dvec3();
        let dist_sq = to_light.length_squared();
        if dist_sq == 0.0 {
            return 0.0;
        }
        let intensity = self.intensity_toward(-to_light, grazing);
        if intensity > 0.0 {
            intensity * response(to_light / dist_sq.sqrt()) / dist_sq
        } else {
            0.0
        }
    }

    /// The point of a triangle with the barycentric coordinates `s` and `t` of its second and third
    /// vertex; of other lights the only one.
    #[must_use]
    pub fn point(&self, s: f64, t: f64) -> DVec3 {
        match self {
            Self::Triangle { vertices, .. } => {
                let [a, b, c] = vertices.map(Vec3::as_dvec3);
                a + (b - a) * s + (c - a) * t
            }
            Self::Point { p, .. } | Self::Spot { p, .. } => p.as_dvec3(),
        }
    }

    /// The emitted power: that of both sides of a two-sided triangle, and of a spot that in its
    /// cone. The `phi` of the [`bounds`](Self::bounds) is another number, for importances.
    #[must_use]
    pub fn power(&self) -> f64 {
        match *self {
            Self::Triangle {
                vertices,
                radiance,
                two_sided,
            } => {
                let [a, b, c] = vertices.map(Vec3::as_dvec3);
                let sides = if two_sided { 2.0 } else { 1.0 };
                sides * PI * f64::from(radiance) * 0.5 * (b - a).cross(c - a).length()
            }
            Self::Point { intensity, .. } => 4.0 * PI * f64::from(intensity),
            Self::Spot {
                intensity,
                cone_deg,
                delta_deg,
                ..
            } => {
                // The falloff is 1/2 in the mean over its cosines. From squares of sines, which
                // narrow cones keep the digits of.
                let sin_sq = |angle: f64| (0.5 * angle).sin().powi(2);
                let [start, end] = cone(cone_deg, delta_deg).map(sin_sq);
                2.0 * PI * f64::from(intensity) * (start + end)
            }
        }
    }

    /// The bounds of the light, for light samplers.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
    pub fn bounds(&self) -> LightBounds {
        match *self {
            Self::Triangle {
                vertices: [a, b, c],
                radiance,
                two_sided,
            } => {
                // In doubles: squares of tiny lengths vanish in floats.
                let edge = |to: Vec3| to.as_dvec3() - a.as_dvec3();
                let cross = edge(b).cross(edge(c));
                LightBounds {
                    bounds: Aabb::from_points([a, b, c]),
                    w: cross.normalize_or(DVec3::Z).as_vec3(),
                    phi: (PI * f64::from(radiance) * 0.5 * cross.length()) as f32,
                    cos_theta_o: 1.0,
                    cos_theta_e: 0.0,
                    two_sided,
                }
            }
            Self::Point { p, intensity } => LightBounds {
                bounds: Aabb::from_point(p),
                w: Vec3::Z,
                phi: 4.0 * core::f32::consts::PI * intensity,
                cos_theta_o: -1.0,
                cos_theta_e: 0.0,
                two_sided: false,
            },
            Self::Spot {
                p,
                target,
                intensity,
                cone_deg,
                delta_deg,
            } => {
                // Rounded so that both angles together are no less than the cone.
                let [start, end] = cone(cone_deg, delta_deg);
                let cos_theta_o = rounded_down(start.cos());
                let beyond = (end - f64::from(cos_theta_o).acos()).max(0.0);
                LightBounds {
                    bounds: Aabb::from_point(p),
                    w: spot_axis(p, target).as_vec3(),
                    phi: 4.0 * core::f32::consts::PI * intensity,
                    cos_theta_o,
                    cos_theta_e: rounded_down(beyond.cos()),
                    two_sided: false,
                }
            }
        }
    }

    /// Radiant intensity along `direction`, of any length; 0 where its cosine is less than
    /// `grazing` inside of where emission ends.
    fn intensity_toward(&self, direction: DVec3, grazing: f64) -> f64 {
        match *self {
            Self::Triangle {
                vertices,
                radiance,
                two_sided,
            } => {
                let [a, b, c] = vertices.map(Vec3::as_dvec3);
                let cross = (b - a).cross(c - a);
                let projected = 0.5 * cross.dot(direction.normalize_or_zero());
                let seen = if two_sided {
                    projected.abs()
                } else {
                    projected
                };
                if seen > 0.5 * grazing * cross.length() {
                    f64::from(radiance) * seen
                } else {
                    0.0
                }
            }
            Self::Point { intensity, .. } => f64::from(intensity),
            Self::Spot {
                p,
                target,
                intensity,
                cone_deg,
                delta_deg,
            } => {
                let cos = spot_axis(p, target).dot(direction.normalize_or_zero());
                let [cos_start, cos_end] = cone(cone_deg, delta_deg).map(f64::cos);
                if cos > cos_end + grazing {
                    f64::from(intensity) * falloff(cos, cos_start, cos_end)
                } else {
                    0.0
                }
            }
        }
    }
}

/// The axis of a spot at `p`. In doubles, so that squares of tiny lengths do not vanish; +z
/// if the target is where the spot is.
fn spot_axis(p: Vec3, target: Vec3) -> DVec3 {
    (target.as_dvec3() - p.as_dvec3()).normalize_or(DVec3::Z)
}

/// The half angles of full and of any emission of a spot, in radians.
fn cone(cone_deg: f32, delta_deg: f32) -> [f64; 2] {
    let end = f64::from(cone_deg);
    [end - f64::from(delta_deg), end].map(f64::to_radians)
}

/// The largest float that is not above the cosine `x`.
#[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
fn rounded_down(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) > x {
        (nearest - 0.5 * f32::EPSILON * nearest.abs().max(f32::MIN_POSITIVE)).max(-1.0)
    } else {
        nearest
    }
}

/// Smooth step from 0 at `cos_end` to 1 at `cos_start`.
fn falloff(cos: f64, cos_start: f64, cos_end: f64) -> f64 {
    if cos >= cos_start {
        return 1.0;
    }
    if cos <= cos_end {
        return 0.0;
    }
    let s = (cos - cos_end) / (cos_start - cos_end);
    s * s * (3.0 - 2.0 * s)
}

#[cfg(test)]
mod tests;
