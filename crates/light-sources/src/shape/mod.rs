//! Shapes of area lights, one per file.

mod any;
mod bilinear_patch;
mod bilinear_patch_error;
mod cylinder;
mod cylinder_view;
mod disk;
mod flat_quad;
mod patch_area;
mod patch_ray;
mod receiver_cosine;
mod rectangle;
mod sphere;
mod triangle;
mod triangle_error;
mod uv_area;

pub use any::{AnyShape, ShapeDesc, ShapeError};
pub use bilinear_patch::BilinearPatch;
pub use bilinear_patch_error::BilinearPatchError;
pub use cylinder::{Cylinder, CylinderError};
pub use disk::{Disk, DiskError};
pub use rectangle::{Rectangle, RectangleError};
pub use sphere::{Sphere, SphereError};
pub use triangle::Triangle;
pub use triangle_error::TriangleError;
pub use uv_area::{UvArea, UvDensity};

use crate::glam::{Vec2, Vec3};
use crate::surface_point::SurfacePoint;
use core::f32::consts::TAU;
use light_bounds::LightSampleContext;
use light_math::float::{ONE_MINUS_EPSILON, atan2, sqrt};
use light_math::{Aabb, DirectionCone};

/// The numbers of the samples toward triangles, rectangles and spheres, by name, for ports of them
/// to another language.
pub const SHAPE_CONSTANTS: [(&str, f32); 10] = [
    ("CLOSE", CLOSE),
    ("DIRECTION_ERROR", sphere::DIRECTION_ERROR),
    ("EDGE_ERROR", triangle::EDGE_ERROR),
    ("HIT_ERROR", HIT_ERROR),
    ("LEAST_COSINE", receiver_cosine::SMALLEST),
    ("OWN_ERROR", sphere::OWN_ERROR),
    ("SMALL_BOUND", triangle::SMALL_BOUND),
    ("SMALL_SOLID_ANGLE", SMALL),
    ("SPHERE_ERROR", sphere::SPHERE_ERROR),
    ("WIDEST_SLACK", rectangle::WIDEST_SLACK),
];

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
    fn sample_toward(&self, ctx: &LightSampleContext, u: Vec2) -> Option<DirectionSample>;

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

    fn sample_toward(&self, ctx: &LightSampleContext, u: Vec2) -> Option<DirectionSample> {
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
pub struct DirectionSample {
    /// The point.
    pub at: SurfacePoint,
    /// Unit direction toward it.
    pub wi: Vec3,
    /// Density per solid angle, in sr^-1, positive and finite.
    pub pdf: f32,
}

/// The solid angle in sr below which shapes with straight edges are sampled by area: the remaining
/// variance costs less than sampling by solid angle.
const SMALL: f32 = 3e-4;

/// Density per solid angle of a point that was chosen with density `pdf_area` on a surface with
/// unit normal `n`, seen along `to_light` (not of unit length); `None` edge-on, where the density
/// is infinite, and within 1e-19.
#[inline]
pub(crate) fn area_to_solid_angle(pdf_area: f32, to_light: Vec3, n: Vec3) -> Option<(Vec3, f32)> {
    let dist_sq = to_light.length_squared();
    // The square of a shorter distance loses digits, and no density of it holds.
    if !(dist_sq >= f32::MIN_POSITIVE) {
        return None;
    }
    let wi = to_light.try_normalize()?;
    let pdf = pdf_area * dist_sq / n.dot(wi).abs();
    (pdf > 0.0 && pdf.is_finite()).then_some((wi, pdf))
}

/// The distance, as a part of the coordinates, within which their rounding shows.
const CLOSE: f32 = 1e-3;

/// Whether a point `at` is so close, compared with its coordinates, that their rounding turns the
/// direction `to_light` visibly.
#[inline]
fn is_within_rounding(to_light: Vec3, at: Vec3) -> bool {
    to_light.length_squared() < CLOSE * CLOSE * at.length_squared()
}

/// The sample of `shape` whose direction is `wi`, with the point that the direction meets and the
/// density that it has, if it meets one.
#[cold]
fn met_by(shape: &impl Shape, ctx: &LightSampleContext, wi: Vec3) -> Option<DirectionSample> {
    let at = shape.hit(ctx.p, wi)?;
    let pdf = shape.pdf_toward(ctx, wi);
    (pdf > 0.0).then_some(DirectionSample { at, wi, pdf })
}

/// The rounding error of a hit, as a part of the coordinates that were subtracted.
const HIT_ERROR: f32 = 4.0 * f32::EPSILON;

/// Rounding error of the intersection of a ray with a surface at the given distance, as a length
/// along the surface; it grows at grazing angles. Edges are extended by it, so that a direction
/// toward any point hits.
///
/// `magnitude` is the size of the coordinates that were subtracted.
fn hit_slack(magnitude: f32, cos_theta: f32) -> f32 {
    HIT_ERROR * magnitude / cos_theta.abs()
}

/// The angle around the axis z of the point at `p`, as a part of a full turn, in `[0, 1)`.
pub(crate) fn azimuth(p: Vec3) -> f32 {
    let turn = atan2(p.y, p.x) / TAU;
    let turn = if turn < 0.0 { turn + 1.0 } else { turn };
    turn.min(ONE_MINUS_EPSILON)
}

/// The length of a normal, as an area; also where that is so small that its square loses digits.
#[inline]
fn normal_length(normal: Vec3) -> f32 {
    let length_sq = normal.length_squared();
    if length_sq >= f32::MIN_POSITIVE {
        sqrt(length_sq)
    } else {
        tiny_length(normal)
    }
}

/// Divided by the largest component first, so that no square vanishes.
#[cold]
fn tiny_length(v: Vec3) -> f32 {
    let largest = v.abs().max_element();
    if largest > 0.0 {
        largest * (v / largest).length()
    } else {
        0.0
    }
}

/// The unit vector along a normal; also where that is so short, as of a tiny surface, that its
/// square loses digits.
#[inline]
fn unit_normal(normal: Vec3) -> Option<Vec3> {
    if normal.length_squared() >= f32::MIN_POSITIVE {
        normal.try_normalize()
    } else {
        light_math::direction(normal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn azimuths_stay_below_a_full_turn() {
        let turns = [Vec3::X, Vec3::Y, Vec3::NEG_X, Vec3::NEG_Y].map(azimuth);
        assert_eq!(turns, [0.0, 0.25, 0.5, 0.75], "quarters");
        // An angle so little below the axis x that its part of a turn rounds to 1.
        for y in [1e-9, 1e-20, f32::MIN_POSITIVE] {
            assert_eq!(azimuth(Vec3::new(1.0, -y, 0.0)), ONE_MINUS_EPSILON, "{y}");
        }
    }

    #[test]
    fn areas_seen_from_their_edge_have_no_density() {
        let seen = |to| area_to_solid_angle(0.5, to, Vec3::Z);
        assert_eq!(seen(Vec3::Z * 2.0), Some((Vec3::Z, 2.0)), "d^2 / A");
        assert_eq!(
            seen(Vec3::NEG_Z * 2.0),
            Some((Vec3::NEG_Z, 2.0)),
            "from behind"
        );
        for none in [
            Vec3::X,
            Vec3::ZERO,
            Vec3::NAN,
            Vec3::Z * 1e-30,
            Vec3::Z * 2e-22,
            Vec3::Z * 1e30,
        ] {
            assert_eq!(seen(none), None, "{none}");
        }
    }
}
