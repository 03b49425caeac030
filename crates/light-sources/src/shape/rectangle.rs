use core::error::Error;
use core::fmt;

use super::normal::unit_normal;
use super::receiver_cosine::ReceiverCosine;
use super::rounding::{hit_slack, is_in_plane, with_density_of_ray};
use super::solid_angle::{LEAST_DENSITY, SMALL, area_to_solid_angle};
use super::{Shape, ShapeDirectionSample, ShapeSample};
use crate::glam::{Vec2, Vec3};
use crate::surface_point::SurfacePoint;
use light_bounds::LightSampleContext;
use light_math::warp::SphericalRectangle;
use light_math::{Aabb, DirectionCone};

/// A rectangle; its front is the side of the cross product of its two edges.
///
/// Directions toward it are chosen by solid angle and nearly by the receiver's cosine, or by area
/// when it is small.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    corner: Vec3,
    edges: [Vec3; 2],
    normal: Vec3,
}

/// Why a rectangle is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RectangleError {
    /// The corner is not finite.
    Corner,
    /// An edge is zero or not finite, or the area is no positive number.
    Edge,
    /// The edges are not perpendicular.
    NotPerpendicular,
}

/// Tolerance of the cosine between the edges: files write few digits.
const TOLERANCE: f32 = 1e-4;

/// The most that an edge is extended by, as a part of its length.
pub(super) const WIDEST_SLACK: f32 = 0.5;

impl Rectangle {
    /// The rectangle with one corner and the edges from there along u and v.
    ///
    /// # Errors
    /// When the edges are not perpendicular or there is no area.
    pub fn new(corner: Vec3, edges: [Vec3; 2]) -> Result<Self, RectangleError> {
        if !corner.is_finite() {
            return Err(RectangleError::Corner);
        }
        let axes = edges.map(Vec3::try_normalize);
        let [Some(x), Some(y)] = axes else {
            return Err(RectangleError::Edge);
        };
        if !(x.dot(y).abs() <= TOLERANCE) {
            return Err(RectangleError::NotPerpendicular);
        }
        let rectangle = Self {
            corner,
            // Exactly perpendicular: the projection has to be a spherical rectangle.
            edges: [edges[0], edges[1] - x * x.dot(edges[1])],
            normal: x.cross(y).normalize(),
        };
        let area = rectangle.area();
        if !(area > 0.0 && area.is_finite() && (1.0 / area).is_finite()) {
            return Err(RectangleError::Edge);
        }
        Ok(rectangle)
    }

    /// The corner at (u, v) = (0, 0).
    #[must_use]
    pub const fn corner(&self) -> Vec3 {
        self.corner
    }

    /// The edges from the corner along u and v, exactly perpendicular.
    #[must_use]
    pub const fn edges(&self) -> [Vec3; 2] {
        self.edges
    }

    fn corners(&self) -> [Vec3; 4] {
        let [x, y] = self.edges;
        [Vec3::ZERO, x, y, x + y].map(|d| self.corner + d)
    }

    /// The rectangle on the sphere of directions around `p`; `None` where it is so small that it is
    /// sampled by area.
    fn seen_from(&self, p: Vec3) -> Option<SphericalRectangle> {
        let [x, y] = self.edges;
        let seen = SphericalRectangle::new(self.corner, x, y, p);
        seen.filter(|seen| seen.solid_angle() > SMALL)
    }

    fn is_own(&self, ctx: &LightSampleContext) -> bool {
        is_in_plane(ctx, self.corner, self.normal)
    }

    fn receiver_cosine(&self, ctx: &LightSampleContext) -> ReceiverCosine {
        ReceiverCosine::new(ctx, self.corners())
    }

    /// Direction and density of a point that is chosen by area, seen along `to_light`.
    fn by_area(&self, to_light: Vec3) -> Option<(Vec3, f32)> {
        let (wi, pdf) = area_to_solid_angle(1.0 / self.area(), to_light, self.normal)?;
        Some((wi, pdf.max(LEAST_DENSITY)))
    }

    /// From `p` to the point at `uv`: not by way of the point itself, whose rounding grows with the
    /// coordinates of the scene.
    fn toward(&self, p: Vec3, uv: Vec2) -> Vec3 {
        (self.corner - p) + self.edges[0] * uv.x + self.edges[1] * uv.y
    }

    fn at(&self, uv: Vec2) -> SurfacePoint {
        SurfacePoint {
            p: self.corner + self.edges[0] * uv.x + self.edges[1] * uv.y,
            n: self.normal,
            uv,
        }
    }

    /// Where a ray meets the rectangle, whose origin may be off by `error`.
    fn met(&self, origin: Vec3, direction: Vec3, error: f32) -> Option<SurfacePoint> {
        let to_corner = self.corner - origin;
        let cos_theta = direction.dot(self.normal);
        let t = to_corner.dot(self.normal) / cos_theta;
        if !(t > 0.0 && t.is_finite()) {
            return None;
        }
        let p = direction * t - to_corner;
        let magnitude = t + to_corner.length() + self.corner.length();
        let slack = hit_slack(magnitude, error, cos_theta);
        let along = |edge: Vec3| {
            let x = p.dot(edge) / edge.length_squared();
            let slack = (slack / edge.length()).min(WIDEST_SLACK);
            (x >= -slack && x <= 1.0 + slack).then(|| x.clamp(0.0, 1.0))
        };
        Some(self.at(Vec2::new(along(self.edges[0])?, along(self.edges[1])?)))
    }
}

impl Shape for Rectangle {
    fn area(&self) -> f32 {
        self.edges[0].length() * self.edges[1].length()
    }

    fn bounds(&self) -> Aabb {
        Aabb::from_points(self.corners())
    }

    fn normal_cone(&self) -> DirectionCone {
        DirectionCone::from_direction(self.normal)
    }

    fn sample(&self, u: Vec2) -> Option<ShapeSample> {
        Some(ShapeSample {
            at: self.at(u),
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
        let Some(seen) = self.seen_from(ctx.p) else {
            let (at, to_light) = (self.at(u), self.toward(ctx.p, u));
            let (wi, pdf) = self.by_area(to_light)?;
            return with_density_of_ray(self, ctx, to_light, ShapeDirectionSample { at, wi, pdf });
        };
        let (u, pdf) = self.receiver_cosine(ctx).sample(u);
        let uv = seen.sample(u);
        let (at, to_light) = (self.at(uv), self.toward(ctx.p, uv));
        let wi = unit_normal(to_light)?;
        let pdf = pdf * seen.pdf();
        with_density_of_ray(self, ctx, to_light, ShapeDirectionSample { at, wi, pdf })
    }

    fn pdf_toward(&self, ctx: &LightSampleContext, wi: Vec3) -> f32 {
        if self.is_own(ctx) {
            return 0.0;
        }
        let Some(at) = self.met(ctx.p, wi, ctx.p_error.length()) else {
            return 0.0;
        };
        let by_area = || self.by_area(self.toward(ctx.p, at.uv));
        match self.seen_from(ctx.p) {
            Some(seen) => self.receiver_cosine(ctx).pdf(|| seen.invert(at.uv)) * seen.pdf(),
            None => by_area().map_or(0.0, |(_, pdf)| pdf),
        }
    }

    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        self.met(origin, direction, 0.0)
    }
}

impl fmt::Display for RectangleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Corner => "corner: must be finite",
            Self::Edge => "edges: must be finite and span an area above 0",
            Self::NotPerpendicular => "edges: must be perpendicular",
        })
    }
}

impl Error for RectangleError {}
