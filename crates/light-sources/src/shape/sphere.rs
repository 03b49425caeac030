use core::error::Error;
use core::f32::consts::{FRAC_1_PI, PI, TAU};
use core::fmt;

use super::azimuth::azimuth;
use super::solid_angle::area_to_solid_angle;
use super::{Shape, ShapeDirectionSample, ShapeSample, UvArea, UvDensity};
use crate::glam::{Vec2, Vec3};
use crate::rigid_transform::RigidTransform;
use crate::surface_point::SurfacePoint;
use light_bounds::LightSampleContext;
use light_math::float::{atan2, safe_sqrt, sin_cos};
use light_math::warp::{uniform_cone, uniform_sphere};
use light_math::{Aabb, DirectionCone, Frame};

/// A sphere; its front is outside.
///
/// Seen from outside, directions are chosen uniformly in the cone that the sphere fills; seen from
/// inside or from the sphere itself, points are chosen by area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    pub(super) transform: RigidTransform,
    pub(super) radius: f32,
}

/// Why a sphere is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SphereError {
    /// The radius is not positive, or so small or large that the area is no positive number.
    Radius,
}

/// The sine of the rounding error of a direction in single precision.
pub(super) const DIRECTION_ERROR: f32 = 4.0 * f32::EPSILON;

/// How far rounding moves a point of the sphere, and one that a ray has met, as parts of its
/// coordinates.
pub(super) const SPHERE_ERROR: f32 = 4.0 * f32::EPSILON;
pub(super) const OWN_ERROR: f32 = 8.0 * f32::EPSILON;

impl Sphere {
    /// The sphere around the origin of the transform. Its axis +z only matters for the surface
    /// parameters: u runs around it, v from the lower pole to the upper.
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

    /// The radius in scene units.
    #[must_use]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// From the sphere's space to the scene.
    #[must_use]
    pub const fn transform(&self) -> &RigidTransform {
        &self.transform
    }

    /// The point of the surface with unit normal `n`.
    #[must_use]
    pub fn at(&self, n: Vec3) -> SurfacePoint {
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

    /// The cone in which the sphere is seen from outside; `None` from inside and from its own
    /// surface.
    fn cone(&self, ctx: &LightSampleContext) -> Option<Cone> {
        let to_center = self.center() - ctx.p;
        let distance = to_center.length();
        if !(distance > self.radius) || self.is_own(ctx) {
            return None;
        }
        let axis = to_center / distance;
        let sin_max = self.radius / distance;
        let sin_sq_max = sin_max * sin_max;
        Some(Cone {
            axis,
            sin_max,
            one_minus_cos_max: sin_sq_max / (1.0 + safe_sqrt(1.0 - sin_sq_max)),
        })
    }

    /// Whether the receiver may be a point of the sphere, wherever rounding has put it: by its
    /// place and its normal. Another surface that close is on the side where it is.
    fn is_own(&self, ctx: &LightSampleContext) -> bool {
        let size = self.center().abs().max_element() + self.radius;
        let error = 2.0 * ctx.p_error + OWN_ERROR * size;
        ctx.n().is_some_and(|n| {
            [n, -n].into_iter().any(|n| {
                let own = self.center() + n * self.radius;
                (own - ctx.p).abs().cmple(error).all()
            })
        })
    }

    /// The point, moved by more than its rounding error to the side from which it is seen, so that
    /// the sphere does not occlude its own light.
    fn before(&self, at: SurfacePoint, side: f32) -> SurfacePoint {
        let p = at.p + at.n * (side * self.error());
        SurfacePoint { p, ..at }
    }

    /// More than the distance by which rounding moves a point of the surface.
    fn error(&self) -> f32 {
        SPHERE_ERROR * (self.center().abs().max_element() + self.radius)
    }

    /// Where the line through `origin` enters the sphere and where it leaves it: distances along
    /// the unit direction, and normals.
    fn crossings(&self, origin: Vec3, direction: Vec3) -> Option<[(f32, Vec3); 2]> {
        let to_center = self.center() - origin;
        let nearest = to_center.dot(direction);
        let offset = direction * nearest - to_center;
        let half_chord_sq = self.radius * self.radius - offset.length_squared();
        if !(half_chord_sq >= 0.0) {
            return None;
        }
        let half_chord = safe_sqrt(half_chord_sq);
        let crossing = |side: f32| {
            let n = (offset + direction * side).try_normalize()?;
            Some((nearest + side, n))
        };
        Some([crossing(-half_chord)?, crossing(half_chord)?])
    }

    /// Density per solid angle of directions toward points chosen by area, where the way out of the
    /// sphere counts.
    fn pdf_from_inside(&self, p: Vec3, wi: Vec3) -> Option<f32> {
        let [_, (t, n)] = self.crossings(p, wi)?;
        let (_, pdf) = area_to_solid_angle(1.0 / self.area(), wi * t, n)?;
        (t > 0.0).then_some(pdf)
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

    fn uv_area(&self) -> UvArea {
        UvArea::Square(UvDensity::Sine)
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

    fn sample_toward(&self, ctx: &LightSampleContext, u: Vec2) -> Option<ShapeDirectionSample> {
        let Some(cone) = self.cone(ctx) else {
            let ShapeSample { at, pdf } = self.sample(u)?;
            let (wi, pdf) = area_to_solid_angle(pdf, at.p - ctx.p, at.n)?;
            // From outside, where rounding has put an own point, a line first enters.
            if !(at.n.dot(wi) > 0.0) {
                return None;
            }
            let at = self.before(at, -1.0);
            return Some(ShapeDirectionSample { at, wi, pdf });
        };
        let pdf = uniform_cone::pdf(cone.one_minus_cos_max);
        if !(pdf > 0.0 && pdf.is_finite()) {
            return None;
        }

        // The angle at the receiver, and from it the one at the centre: their sum has the sine of
        // the angle at the rim.
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
        Some(ShapeDirectionSample {
            at: self.before(self.at(n), 1.0),
            wi: wi.normalize(),
            pdf,
        })
    }

    fn pdf_toward(&self, ctx: &LightSampleContext, wi: Vec3) -> f32 {
        let Some(cone) = self.cone(ctx) else {
            return self.pdf_from_inside(ctx.p, wi).unwrap_or(0.0);
        };
        let sin = cone.axis.cross(wi).length();
        // A ray may start by the error of the point beside it.
        let moved = ctx.p_error.length() / self.radius * cone.sin_max;
        if cone.axis.dot(wi) > 0.0 && sin <= cone.sin_max + DIRECTION_ERROR + moved {
            uniform_cone::pdf(cone.one_minus_cos_max)
        } else {
            0.0
        }
    }

    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        let [enters, leaves] = self.crossings(origin, direction)?;
        let to_center = self.center() - origin;
        let power = to_center.length_squared() - self.radius * self.radius;
        // Rounding decides where a ray enters that starts on the sphere; whether it goes inward is
        // certain.
        let slack = 2.0 * self.radius * self.error();
        let (t, n) = if power > slack { enters } else { leaves };
        let leads_away = power >= -slack && to_center.dot(direction) <= 0.0;
        (t > 0.0 && !leads_away).then(|| self.at(n))
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

#[cfg(test)]
mod tests;
