use core::error::Error;
use core::f32::consts::{FRAC_1_PI, PI, TAU};
use core::fmt;

use super::{DirectionSample, Shape, ShapeSample, area_to_solid_angle, azimuth};
use crate::glam::{Vec2, Vec3};
use crate::rigid_transform::RigidTransform;
use crate::surface_point::SurfacePoint;
use light_bounds::LightSampleContext;
use light_math::float::{atan2, safe_sqrt, sin_cos};
use light_math::warp::{uniform_cone, uniform_sphere};
use light_math::{Aabb, DirectionCone, Frame};

/// A sphere; its front is outside.
///
/// Seen from outside, directions are chosen uniformly in the cone that the sphere fills; seen from inside, points are
/// chosen by area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    transform: RigidTransform,
    radius: f32,
}

/// Why there is no such sphere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SphereError {
    /// The radius is not positive, or so small or large that the area is no positive number.
    Radius,
}

/// How far a direction in single precision may lie from where it was meant to: the sine of that angle.
const DIRECTION_ERROR: f32 = 4.0 * f32::EPSILON;

impl Sphere {
    /// The sphere around the origin of the transform. Its axis +z only matters for the surface parameters: u runs
    /// around it, v from the lower pole to the upper.
    ///
    /// # Errors
    /// When the radius is not positive or the area not finite.
    pub fn new(transform: RigidTransform, radius: f32) -> Result<Self, SphereError> {
        let sphere = Self { transform, radius };
        let area = sphere.area();
        if !(radius > 0.0 && area > 0.0 && area.is_finite()) {
            return Err(SphereError::Radius);
        }
        Ok(sphere)
    }

    /// The centre.
    #[must_use]
    pub const fn center(&self) -> Vec3 {
        self.transform.origin()
    }

    /// The point of the surface with unit normal `n`.
    fn at(&self, n: Vec3) -> SurfacePoint {
        let local = self.transform.inverse_vector(n);
        let u = azimuth(local);
        SurfacePoint {
            p: self.center() + n * self.radius,
            n,
            uv: Vec2::new(
                u,
                1.0 - atan2(local.truncate().length(), local.z) * FRAC_1_PI,
            ),
        }
    }

    /// The cone in which the sphere is seen from `p`; `None` from inside.
    fn cone(&self, p: Vec3) -> Option<Cone> {
        let to_center = self.center() - p;
        let dist_sq = to_center.length_squared();
        if !(dist_sq > self.radius * self.radius) {
            return None;
        }
        // Twice squared would lose small spheres far away.
        let distance = to_center.length();
        let sin_max = self.radius / distance;
        let sin_sq_max = sin_max * sin_max;
        Some(Cone {
            axis: to_center / distance,
            sin_max,
            one_minus_cos_max: sin_sq_max / (1.0 + safe_sqrt(1.0 - sin_sq_max)),
        })
    }
}

/// The directions toward a sphere.
struct Cone {
    axis: Vec3,
    sin_max: f32,
    one_minus_cos_max: f32,
}

impl Shape for Sphere {
    fn area(&self) -> f32 {
        4.0 * PI * self.radius * self.radius
    }

    fn bounds(&self) -> Aabb {
        Aabb {
            min: self.center() - self.radius,
            max: self.center() + self.radius,
        }
    }

    fn normal_cone(&self) -> DirectionCone {
        DirectionCone::WHOLE_SPHERE
    }

    fn sample(&self, u: Vec2) -> Option<ShapeSample> {
        let n = self.transform.vector(uniform_sphere::sample(u));
        Some(ShapeSample {
            at: self.at(n),
            pdf: 1.0 / self.area(),
        })
    }

    fn pdf(&self, _at: &SurfacePoint) -> f32 {
        1.0 / self.area()
    }

    fn sample_toward(&self, ctx: &LightSampleContext, u: Vec2) -> Option<DirectionSample> {
        let Some(cone) = self.cone(ctx.p) else {
            let ShapeSample { at, pdf } = self.sample(u)?;
            let (wi, pdf) = area_to_solid_angle(pdf, at.p - ctx.p, at.n)?;
            return Some(DirectionSample { at, wi, pdf });
        };
        let pdf = uniform_cone::pdf(cone.one_minus_cos_max);
        if !(pdf > 0.0 && pdf.is_finite()) {
            return None;
        }

        // The angle at the receiver, and from it the one at the centre: their sum has the sine of the angle at the rim.
        let one_minus_cos = cone.one_minus_cos_max * u.x;
        let (sin, cos) = (
            safe_sqrt(one_minus_cos * (2.0 - one_minus_cos)),
            1.0 - one_minus_cos,
        );
        let sin_sum = (sin / cone.sin_max).min(1.0);
        let cos_sum = safe_sqrt(1.0 - sin_sum * sin_sum);
        let sin_alpha = sin_sum * cos - cos_sum * sin;
        let cos_alpha = cos_sum * cos + sin_sum * sin;
        let (sin_phi, cos_phi) = sin_cos(TAU * u.y);

        let frame = Frame::from_z(cone.axis);
        let around = Vec3::new(cos_phi, sin_phi, 0.0);
        let n = frame
            .from_local(-(around * sin_alpha + Vec3::Z * cos_alpha))
            .normalize();
        let wi = frame.from_local(Vec3::Z * cos - around * sin);
        Some(DirectionSample {
            at: self.at(n),
            wi: wi.normalize(),
            pdf,
        })
    }

    fn pdf_toward(&self, ctx: &LightSampleContext, wi: Vec3) -> f32 {
        let Some(cone) = self.cone(ctx.p) else {
            let pdf = |at: SurfacePoint| area_to_solid_angle(1.0 / self.area(), at.p - ctx.p, at.n);
            return self
                .hit(ctx.p, wi)
                .and_then(pdf)
                .map_or(0.0, |(_, pdf)| pdf);
        };
        let sin = cone.axis.cross(wi).length();
        if cone.axis.dot(wi) > 0.0 && sin <= cone.sin_max + DIRECTION_ERROR {
            uniform_cone::pdf(cone.one_minus_cos_max)
        } else {
            0.0
        }
    }

    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        let to_center = self.center() - origin;
        let nearest = to_center.dot(direction);
        let offset = direction * nearest - to_center;
        let half_chord_sq = self.radius * self.radius - offset.length_squared();
        if !(half_chord_sq >= 0.0) {
            return None;
        }
        let half_chord = safe_sqrt(half_chord_sq);
        let outside = to_center.length_squared() > self.radius * self.radius;
        let (t, side) = if outside {
            (nearest - half_chord, -half_chord)
        } else {
            (nearest + half_chord, half_chord)
        };
        let n = (offset + direction * side).try_normalize()?;
        (t > 0.0).then(|| self.at(n))
    }
}

impl fmt::Display for SphereError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Radius => "radius: must be positive, with an area that is a number",
        })
    }
}

impl Error for SphereError {}
