use core::error::Error;
use core::f32::consts::{PI, TAU};
use core::fmt;

use super::azimuth::azimuth;
use super::rounding::{hit_slack, is_in_plane, with_density_of_ray};
use super::solid_angle::area_to_solid_angle;
use super::{Shape, ShapeDirectionSample, ShapeSample, UvArea, UvDensity};
use crate::glam::{Vec2, Vec3};
use crate::rigid_transform::RigidTransform;
use crate::surface_point::SurfacePoint;
use light_bounds::LightSampleContext;
use light_math::float::{sin_cos, sqrt};
use light_math::warp::concentric_disk;
use light_math::{Aabb, DirectionCone};

/// A disk, or an annulus when it has an inner radius; its front is the side of +z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disk {
    transform: RigidTransform,
    radius: f32,
    inner_radius: f32,
}

/// Why a disk is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DiskError {
    /// The radius is not positive, or so small or large that the area of the whole disk is none.
    Radius,
    /// The inner radius is negative, not below the radius, or so near to it that the area rounds to
    /// zero.
    InnerRadius,
}

impl Disk {
    /// The disk in the xy-plane of the transform, around its origin. Surface parameters: u runs
    /// around the axis, v from the rim to the inner radius.
    ///
    /// # Errors
    /// When a radius is invalid, or no area is left.
    pub fn new(
        transform: RigidTransform,
        radius: f32,
        inner_radius: f32,
    ) -> Result<Self, DiskError> {
        let whole = PI * radius * radius;
        if !(radius > 0.0 && whole.is_finite() && (1.0 / whole).is_finite()) {
            return Err(DiskError::Radius);
        }
        let disk = Self {
            transform,
            radius,
            inner_radius,
        };
        if !(inner_radius >= 0.0 && disk.area() > 0.0 && (1.0 / disk.area()).is_finite()) {
            return Err(DiskError::InnerRadius);
        }
        Ok(disk)
    }

    /// From the disk's space to the scene.
    #[must_use]
    pub const fn transform(&self) -> &RigidTransform {
        &self.transform
    }

    /// The radius, in scene units.
    #[must_use]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// The radius of the hole, in scene units; 0 for none.
    #[must_use]
    pub const fn inner_radius(&self) -> f32 {
        self.inner_radius
    }

    /// The point with the surface parameters `uv`, each in `[0, 1]`.
    #[must_use]
    pub fn at_uv(&self, uv: Vec2) -> SurfacePoint {
        let (sin_phi, cos_phi) = sin_cos(TAU * uv.x);
        let r = self.radius + (self.inner_radius - self.radius) * uv.y;
        SurfacePoint {
            p: self.transform.point(Vec3::new(cos_phi, sin_phi, 0.0) * r),
            n: self.transform.axis(),
            uv,
        }
    }

    fn is_own(&self, ctx: &LightSampleContext) -> bool {
        is_in_plane(ctx, self.transform.origin(), self.transform.axis())
    }

    /// The point at `local` of the disk's own plane.
    fn at(&self, local: Vec2) -> SurfacePoint {
        let u = azimuth(local.extend(0.0));
        let v = (self.radius - local.length()) / (self.radius - self.inner_radius);
        SurfacePoint {
            p: self.transform.point(local.extend(0.0)),
            n: self.transform.axis(),
            uv: Vec2::new(u, v.clamp(0.0, 1.0)),
        }
    }

    /// Where a ray meets the disk, whose origin may be off by `error`.
    fn met(&self, origin: Vec3, direction: Vec3, error: f32) -> Option<SurfacePoint> {
        let o = self.transform.inverse_point(origin);
        let d = self.transform.inverse_vector(direction);
        let t = -o.z / d.z;
        if !(t > 0.0 && t.is_finite()) {
            return None;
        }
        let local = o.truncate() + d.truncate() * t;
        let magnitude = o.length() + t + origin.length();
        let slack = hit_slack(magnitude, error, d.z).min(0.5 * self.radius);
        let r = local.length();
        let is_hit = r <= self.radius + slack && r >= self.inner_radius - slack;
        let on_disk = r.clamp(self.inner_radius, self.radius);
        let local = if r == on_disk {
            local
        } else {
            local.try_normalize().unwrap_or(Vec2::X) * on_disk
        };
        is_hit.then(|| self.at(local))
    }
}

impl Shape for Disk {
    fn area(&self) -> f32 {
        PI * (self.radius - self.inner_radius) * (self.radius + self.inner_radius)
    }

    fn bounds(&self) -> Aabb {
        // Extent of the rim along each axis of the scene.
        let reach = self.transform.circle_reach() * self.radius;
        Aabb {
            min: self.transform.origin() - reach,
            max: self.transform.origin() + reach,
        }
    }

    fn normal_cone(&self) -> DirectionCone {
        DirectionCone::from_direction(self.transform.axis())
    }

    fn uv_area(&self) -> UvArea {
        // The circumference of a ring grows with its radius.
        let width = self.radius - self.inner_radius;
        let radius = [self.radius, 0.0, -width].map(|r| Vec3::X * r);
        UvArea::Square(UvDensity::Length(radius))
    }

    /// The radii of a disk are mapped to those of the annulus with the same enclosed area.
    fn sample(&self, u: Vec2) -> Option<ShapeSample> {
        let on_disk = concentric_disk::sample(u);
        let share = on_disk.length_squared();
        let inner = self.inner_radius / self.radius;
        let local = if inner == 0.0 {
            on_disk
        } else {
            let r = sqrt(inner * inner + (1.0 - inner * inner) * share);
            on_disk.try_normalize().unwrap_or(Vec2::X) * r
        };
        Some(ShapeSample {
            at: self.at(local * self.radius),
            pdf: 1.0 / self.area(),
        })
    }

    fn pdf(&self, _at: &SurfacePoint) -> f32 {
        1.0 / self.area()
    }

    fn sample_toward(&self, ctx: &LightSampleContext, u: Vec2) -> Option<ShapeDirectionSample> {
        if self.is_own(ctx) {
            return None;
        }
        let ShapeSample { at, pdf } = self.sample(u)?;
        let to_light = at.p - ctx.p;
        let (wi, pdf) = area_to_solid_angle(pdf, to_light, at.n)?;
        with_density_of_ray(self, ctx, to_light, ShapeDirectionSample { at, wi, pdf })
    }

    fn pdf_toward(&self, ctx: &LightSampleContext, wi: Vec3) -> f32 {
        if self.is_own(ctx) {
            return 0.0;
        }
        let pdf = |at: SurfacePoint| area_to_solid_angle(1.0 / self.area(), at.p - ctx.p, at.n);
        self.met(ctx.p, wi, ctx.p_error.length())
            .and_then(pdf)
            .map_or(0.0, |(_, pdf)| pdf)
    }

    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        self.met(origin, direction, 0.0)
    }
}

impl fmt::Display for DiskError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Radius => "radius: must be positive, with an area that is a number",
            Self::InnerRadius => "inner_radius: must lie in [0, radius) and leave an area",
        })
    }
}

impl Error for DiskError {}
