use core::error::Error;
use core::f32::consts::TAU;
use core::fmt;

use super::{DirectionSample, Shape, ShapeSample, area_to_solid_angle};
use crate::glam::{Vec2, Vec3};
use crate::rigid_transform::RigidTransform;
use crate::surface_point::SurfacePoint;
use light_bounds::LightSampleContext;
use light_math::float::{atan2, sin_cos, sqrt};
use light_math::{Aabb, DirectionCone};

/// An open cylinder, the wall of a tube without its ends; its front is outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    transform: RigidTransform,
    radius: f32,
    length: f32,
}

/// Why there is no such cylinder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CylinderError {
    /// The radius is not positive and finite.
    Radius,
    /// The length is not positive and finite, or the area no positive number.
    Length,
}

impl Cylinder {
    /// The cylinder around the axis z of the transform, half of its length on each side of the origin. Surface
    /// parameters: u runs around the axis, v along it.
    ///
    /// # Errors
    /// When the radius or the length is not positive, or the area not finite.
    pub fn new(transform: RigidTransform, radius: f32, length: f32) -> Result<Self, CylinderError> {
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(CylinderError::Radius);
        }
        let cylinder = Self {
            transform,
            radius,
            length,
        };
        let area = cylinder.area();
        if !(length > 0.0 && area.is_finite() && (1.0 / area).is_finite()) {
            return Err(CylinderError::Length);
        }
        Ok(cylinder)
    }

    /// The point with the given parameters.
    fn at(&self, uv: Vec2) -> SurfacePoint {
        let (sin_phi, cos_phi) = sin_cos(TAU * uv.x);
        let n = Vec3::new(cos_phi, sin_phi, 0.0);
        let z = (uv.y - 0.5) * self.length;
        SurfacePoint {
            p: self.transform.point(n * self.radius + Vec3::Z * z),
            n: self.transform.vector(n),
            uv,
        }
    }

    /// Whether the wall hides its own point at `at` from someone who looks along `wi` from the distance `t`.
    fn hides(&self, at: &SurfacePoint, wi: Vec3, t: f32) -> bool {
        let n = self.transform.inverse_vector(at.n);
        let d = self.transform.inverse_vector(wi);
        let outward = n.dot(d);
        if outward <= 0.0 {
            return false;
        }
        // The inside is seen: the ray has crossed the tube's circle one chord earlier, through the wall or above it.
        let chord = 2.0 * self.radius * outward / d.truncate().length_squared();
        let z = (at.uv.y - 0.5) * self.length - chord * d.z;
        chord < t && z.abs() <= 0.5 * self.length
    }
}

impl Shape for Cylinder {
    fn area(&self) -> f32 {
        TAU * self.radius * self.length
    }

    fn bounds(&self) -> Aabb {
        let axis = self.transform.axis();
        let rim = (Vec3::ONE - axis * axis).max(Vec3::ZERO).map(sqrt) * self.radius;
        let reach = rim + axis.abs() * (0.5 * self.length);
        Aabb {
            min: self.transform.origin() - reach,
            max: self.transform.origin() + reach,
        }
    }

    /// Normals lie in a plane, but the narrowest cone around a great circle is the sphere.
    fn normal_cone(&self) -> DirectionCone {
        DirectionCone::WHOLE_SPHERE
    }

    fn sample(&self, u: Vec2) -> Option<ShapeSample> {
        Some(ShapeSample {
            at: self.at(Vec2::new(u.y, u.x)),
            pdf: 1.0 / self.area(),
        })
    }

    fn pdf(&self, _at: &SurfacePoint) -> f32 {
        1.0 / self.area()
    }

    /// A point by area, unless the wall hides it.
    fn sample_toward(&self, ctx: &LightSampleContext, u: Vec2) -> Option<DirectionSample> {
        let ShapeSample { at, pdf } = self.sample(u)?;
        let to_light = at.p - ctx.p;
        let (wi, pdf) = area_to_solid_angle(pdf, to_light, at.n)?;
        (!self.hides(&at, wi, to_light.length())).then_some(DirectionSample { at, wi, pdf })
    }

    fn pdf_toward(&self, ctx: &LightSampleContext, wi: Vec3) -> f32 {
        let pdf = |at: SurfacePoint| area_to_solid_angle(1.0 / self.area(), at.p - ctx.p, at.n);
        self.hit(ctx.p, wi)
            .and_then(pdf)
            .map_or(0.0, |(_, pdf)| pdf)
    }

    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        let o = self.transform.inverse_point(origin);
        let d = self.transform.inverse_vector(direction);
        let (o_xy, d_xy) = (o.truncate(), d.truncate());
        // Seen from above, the ray passes the axis at a distance; half a chord before and behind is the wall.
        let speed_sq = d_xy.length_squared();
        let offset = o_xy.perp_dot(d_xy);
        let half_sq = self.radius * self.radius * speed_sq - offset * offset;
        if !(half_sq >= 0.0 && speed_sq > 0.0) {
            return None;
        }
        let (nearest, half) = (-o_xy.dot(d_xy) / speed_sq, sqrt(half_sq) / speed_sq);
        let on_wall = |t: f32| {
            let p = o + d * t;
            let slack = 4.0 * f32::EPSILON * (o.length() + t);
            let is_hit = t > 0.0 && p.z.abs() <= 0.5 * self.length + slack;
            let phi = atan2(p.y, p.x);
            let u = if phi < 0.0 { phi + TAU } else { phi } / TAU;
            is_hit.then(|| self.at(Vec2::new(u, (p.z / self.length + 0.5).clamp(0.0, 1.0))))
        };
        on_wall(nearest - half).or_else(|| on_wall(nearest + half))
    }
}

impl fmt::Display for CylinderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Radius => "radius: must be finite and positive",
            Self::Length => "length: must be finite and positive",
        })
    }
}

impl Error for CylinderError {}
