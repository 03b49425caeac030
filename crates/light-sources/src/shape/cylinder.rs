use core::error::Error;
use core::f32::consts::TAU;
use core::fmt;

use super::azimuth::azimuth;
use super::cylinder_view::CylinderView;
use super::{DirectionSample, Shape, ShapeSample};
use crate::glam::{Vec2, Vec3};
use crate::rigid_transform::RigidTransform;
use crate::surface_point::SurfacePoint;
use light_bounds::LightSampleContext;
use light_math::float::{sin_cos, sqrt};
use light_math::{Aabb, DirectionCone};

/// An open cylinder, the wall of a tube without its ends; its front is outside.
///
/// Directions toward it are sampled nearly uniformly in solid angle, from inside too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    transform: RigidTransform,
    radius: f32,
    length: f32,
}

/// Why a cylinder is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CylinderError {
    /// The radius is not positive and finite.
    Radius,
    /// The length is not positive and finite, or the area no positive number.
    Length,
}

impl Cylinder {
    /// The cylinder around the axis z of the transform, half of its length on each side of the
    /// origin. Surface parameters: u runs around the axis, v along it.
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

    fn view(&self, p: Vec3) -> CylinderView {
        let p = self.transform.inverse_point(p);
        CylinderView::new(p, self.radius, 0.5 * self.length)
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

    fn sample_toward(&self, ctx: &LightSampleContext, u: Vec2) -> Option<DirectionSample> {
        let sample = self.view(ctx.p).sample(u)?;
        let n = sample.normal.extend(0.0);
        let z = sample.height - 0.5 * self.length;
        Some(DirectionSample {
            at: SurfacePoint {
                p: self.transform.point(n * self.radius + Vec3::Z * z),
                n: self.transform.vector(n),
                uv: Vec2::new(azimuth(n), (sample.height / self.length).clamp(0.0, 1.0)),
            },
            wi: self.transform.vector(sample.wi),
            pdf: sample.pdf,
        })
    }

    fn pdf_toward(&self, ctx: &LightSampleContext, wi: Vec3) -> f32 {
        self.view(ctx.p).pdf(self.transform.inverse_vector(wi))
    }

    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        let o = self.transform.inverse_point(origin);
        let d = self.transform.inverse_vector(direction);
        let (o_xy, d_xy) = (o.truncate(), d.truncate());
        // Seen from above, the ray passes the axis at a distance; half a chord before and behind is
        // the wall.
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
            let v = (p.z / self.length + 0.5).clamp(0.0, 1.0);
            is_hit.then(|| self.at(Vec2::new(azimuth(p), v)))
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
