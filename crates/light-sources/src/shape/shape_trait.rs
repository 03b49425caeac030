use super::{UvArea, UvDensity};
use crate::glam::{Vec2, Vec3};
use crate::surface_point::SurfacePoint;
use light_bounds::LightSampleContext;
use light_math::{Aabb, DirectionCone};

/// The shape of an area light.
pub trait Shape {
    /// Area in length^2.
    fn area(&self) -> f32;

    /// A box around the surface.
    fn bounds(&self) -> Aabb;

    /// A cone around the normals of the front side.
    fn normal_cone(&self) -> DirectionCone;

    /// The distribution of area over the surface parameters.
    fn uv_area(&self) -> UvArea {
        UvArea::Square(UvDensity::Even)
    }

    /// A point of the surface, for light that leaves it, with its density per area; `None` without
    /// area.
    fn sample(&self, u: Vec2) -> Option<ShapeSample>;

    /// Density per area with which [`sample`](Self::sample) chooses `at`, a point of the surface.
    fn pdf(&self, at: &SurfacePoint) -> f32;

    /// A point of the surface as seen from `ctx.p`, with the density of its direction per solid
    /// angle; `None` when the surface is seen from its edge, or not at all.
    fn sample_toward(&self, ctx: &LightSampleContext, u: Vec2) -> Option<ShapeDirectionSample>;

    /// Density per solid angle with which [`sample_toward`](Self::sample_toward) chooses `wi`; 0
    /// when it misses.
    fn pdf_toward(&self, ctx: &LightSampleContext, wi: Vec3) -> f32;

    /// The first point of the surface on the ray from `origin` in the unit direction `direction`,
    /// from either side.
    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint>;
}

impl<S: Shape> Shape for &S {
    fn area(&self) -> f32 {
        (**self).area()
    }

    fn bounds(&self) -> Aabb {
        (**self).bounds()
    }

    fn normal_cone(&self) -> DirectionCone {
        (**self).normal_cone()
    }

    fn uv_area(&self) -> UvArea {
        (**self).uv_area()
    }

    fn sample(&self, u: Vec2) -> Option<ShapeSample> {
        (**self).sample(u)
    }

    fn pdf(&self, at: &SurfacePoint) -> f32 {
        (**self).pdf(at)
    }

    fn sample_toward(&self, ctx: &LightSampleContext, u: Vec2) -> Option<ShapeDirectionSample> {
        (**self).sample_toward(ctx, u)
    }

    fn pdf_toward(&self, ctx: &LightSampleContext, wi: Vec3) -> f32 {
        (**self).pdf_toward(ctx, wi)
    }

    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        (**self).hit(origin, direction)
    }
}

/// A point of a surface, sampled by area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeSample {
    /// The point.
    pub at: SurfacePoint,
    /// Density per area, in length^-2, positive and finite.
    pub pdf: f32,
}

/// A point of a surface, sampled by solid angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeDirectionSample {
    /// The point.
    pub at: SurfacePoint,
    /// Unit direction toward it.
    pub wi: Vec3,
    /// Density per solid angle, in sr^-1, positive and finite.
    pub pdf: f32,
}
