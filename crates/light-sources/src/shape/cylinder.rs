use core::error::Error;
use core::f32::consts::TAU;
use core::fmt;

use super::azimuth::azimuth;
use super::cylinder_view::CylinderView;
use super::rounding::HIT_ERROR;
use super::solid_angle::area_to_solid_angle;
use super::sphere::{OWN_ERROR, SPHERE_ERROR};
use super::{Shape, ShapeDirectionSample, ShapeSample};
use crate::glam::{Vec2, Vec3};
use crate::rigid_transform::RigidTransform;
use crate::surface_point::SurfacePoint;
use light_bounds::LightSampleContext;
use light_math::float::{sin_cos, sqrt};
use light_math::{Aabb, DirectionCone};

/// An open cylinder, the wall of a tube without its ends; its front is outside.
///
/// Directions toward it are sampled nearly uniformly in solid angle, from inside too; those from
/// its own wall by area.
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

    /// From the cylinder's space to the scene.
    #[must_use]
    pub const fn transform(&self) -> &RigidTransform {
        &self.transform
    }

    /// The radius, in scene units.
    #[must_use]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// The length, in scene units.
    #[must_use]
    pub const fn length(&self) -> f32 {
        self.length
    }

    /// The point with the surface parameters `uv`, each in `[0, 1]`.
    #[must_use]
    pub fn at_uv(&self, uv: Vec2) -> SurfacePoint {
        let (sin_phi, cos_phi) = sin_cos(TAU * uv.x);
        let n = Vec3::new(cos_phi, sin_phi, 0.0);
        let z = (uv.y - 0.5) * self.length;
        SurfacePoint {
            p: self.transform.point(n * self.radius + Vec3::Z * z),
            n: self.transform.vector(n),
            uv,
        }
    }

    /// Whether the receiver may be a point of the cylinder, wherever rounding has put it: by its
    /// place and its normal. Another surface that close is on the side where it is.
    fn is_own(&self, ctx: &LightSampleContext) -> bool {
        let across = self.transform.inverse_point(ctx.p).truncate();
        let size = self.transform.origin().abs().max_element() + self.radius + self.length;
        let error = 2.0 * ctx.p_error.length() + OWN_ERROR * size;
        ctx.n().is_some_and(|n| {
            let own = self.transform.inverse_vector(n).truncate() * self.radius;
            [own, -own]
                .into_iter()
                .any(|own| (own - across).abs().max_element() <= error)
        })
    }

    /// The point, moved by more than its rounding error to the side that `wi` comes from, so that
    /// the cylinder does not occlude its own light.
    fn before(&self, at: SurfacePoint, wi: Vec3) -> SurfacePoint {
        let size = self.transform.origin().abs().max_element() + self.radius + self.length;
        let error = SPHERE_ERROR * size;
        let p = at.p - at.n * error.copysign(at.n.dot(wi));
        SurfacePoint { p, ..at }
    }

    /// Density per solid angle of directions from a point of the cylinder toward points chosen by
    /// area, where the way out of the tube counts.
    fn pdf_of_own(&self, p: Vec3, wi: Vec3) -> Option<f32> {
        let o = self.transform.inverse_point(p);
        let d = self.transform.inverse_vector(wi);
        let [_, t] = self.chord(o, d)?;
        let slack = HIT_ERROR * (o.length() + t);
        let is_on_wall = t > 0.0 && (o.z + d.z * t).abs() <= 0.5 * self.length + slack;
        let n = (o + d * t).with_z(0.0).try_normalize()?;
        let (_, pdf) = area_to_solid_angle(1.0 / self.area(), d * t, n)?;
        is_on_wall.then_some(pdf)
    }

    /// Distances along a ray of object space to where it enters the endless tube and where it
    /// leaves it.
    fn chord(&self, o: Vec3, d: Vec3) -> Option<[f32; 2]> {
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
        Some([nearest - half, nearest + half])
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
        let rim = self.transform.circle_reach() * self.radius;
        let reach = rim + self.transform.axis().abs() * (0.5 * self.length);
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
            at: self.at_uv(Vec2::new(u.y, u.x)),
            pdf: 1.0 / self.area(),
        })
    }

    fn pdf(&self, _at: &SurfacePoint) -> f32 {
        1.0 / self.area()
    }

    fn sample_toward(&self, ctx: &LightSampleContext, u: Vec2) -> Option<ShapeDirectionSample> {
        if self.is_own(ctx) {
            let ShapeSample { at, pdf } = self.sample(u)?;
            let (wi, pdf) = area_to_solid_angle(pdf, at.p - ctx.p, at.n)?;
            // From outside, where rounding has put an own point, a line first enters.
            return (at.n.dot(wi) > 0.0).then(|| ShapeDirectionSample {
                at: self.before(at, wi),
                wi,
                pdf,
            });
        }
        let sample = self.view(ctx.p).sample(u)?;
        let n = sample.normal.extend(0.0);
        let z = sample.height - 0.5 * self.length;
        let wi = self.transform.vector(sample.wi);
        let at = SurfacePoint {
            p: self.transform.point(n * self.radius + Vec3::Z * z),
            n: self.transform.vector(n),
            uv: Vec2::new(azimuth(n), (sample.height / self.length).clamp(0.0, 1.0)),
        };
        Some(ShapeDirectionSample {
            at: self.before(at, wi),
            wi,
            pdf: sample.pdf,
        })
    }

    fn pdf_toward(&self, ctx: &LightSampleContext, wi: Vec3) -> f32 {
        if self.is_own(ctx) {
            return self.pdf_of_own(ctx.p, wi).unwrap_or(0.0);
        }
        let wi = self.transform.inverse_vector(wi);
        self.view(ctx.p).pdf(wi, ctx.p_error.length())
    }

    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        let o = self.transform.inverse_point(origin);
        let d = self.transform.inverse_vector(direction);
        let [enters, leaves] = self.chord(o, d)?;
        let on_wall = |t: f32| {
            let p = o + d * t;
            let slack = 4.0 * f32::EPSILON * (o.length() + t);
            let is_hit = t > 0.0 && p.z.abs() <= 0.5 * self.length + slack;
            let v = (p.z / self.length + 0.5).clamp(0.0, 1.0);
            is_hit.then(|| self.at_uv(Vec2::new(azimuth(p), v)))
        };
        on_wall(enters).or_else(|| on_wall(leaves))
    }
}

impl fmt::Display for CylinderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Radius => "radius: must be finite and positive",
            Self::Length => "length: must be positive, with an area that is a number",
        })
    }
}

impl Error for CylinderError {}

#[cfg(test)]
mod tests;
