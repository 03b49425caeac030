use super::normal::{has_digits, normal_length, unit_normal};
use super::receiver_cosine::ReceiverCosine;
use super::rounding::{is_in_plane, with_density_of_ray};
use super::solid_angle::{SMALL, area_to_solid_angle};
use super::{Shape, ShapeDirectionSample, ShapeSample, TriangleError, UvArea};
use crate::glam::{Vec2, Vec3};
use crate::surface_point::SurfacePoint;
use light_bounds::LightSampleContext;
use light_math::float::sqrt;
use light_math::warp::{SphericalTriangle, uniform_triangle};
use light_math::{Aabb, DirectionCone};

/// Twice the solid angle below which a triangle is small, as a normal is twice as long as the area,
/// but for a hundredth for rounding.
pub(super) const SMALL_BOUND: f32 = 0.99 * 2.0 * SMALL;

/// The rounding error of the volume that a ray and an edge span, as a part of it.
pub(super) const EDGE_ERROR: f32 = 8.0 * f32::EPSILON;

/// A triangle; its front is the side from which the vertices run counter-clockwise.
///
/// Directions toward it are chosen by solid angle and nearly by the receiver's cosine, or by area
/// when it is small.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    p: [Vec3; 3],
    uv: [Vec2; 3],
}

impl Triangle {
    /// Surface parameters of the vertices where no others are given.
    pub const DEFAULT_UV: [Vec2; 3] = [Vec2::ZERO, Vec2::X, Vec2::ONE];

    /// The triangle with vertices `p`, and surface parameters `uv` at them.
    ///
    /// # Errors
    /// When a vertex is not finite or the triangle has no area, of at least 3e-39.
    pub fn new(p: [Vec3; 3], uv: [Vec2; 3]) -> Result<Self, TriangleError> {
        if !p.iter().all(|p| p.is_finite()) {
            return Err(TriangleError::Vertex);
        }
        let triangle = Self { p, uv };
        let area = triangle.area();
        if !(area.is_finite() && (1.0 / area).is_finite()) {
            return Err(TriangleError::Area);
        }
        Ok(triangle)
    }

    /// A triangle that may have no area: it is never sampled then.
    pub(crate) const fn from_corners(p: [Vec3; 3], uv: [Vec2; 3]) -> Self {
        Self { p, uv }
    }

    /// The vertices.
    #[must_use]
    pub const fn vertices(&self) -> [Vec3; 3] {
        self.p
    }

    /// Surface parameters at the vertices.
    #[cfg(feature = "alloc")]
    pub(crate) const fn uvs(&self) -> [Vec2; 3] {
        self.uv
    }

    /// The unit normal of the front; `None` without area.
    #[must_use]
    pub fn normal(&self) -> Option<Vec3> {
        unit_normal(self.scaled_normal())
    }

    /// The normal, as long as twice the area.
    fn scaled_normal(&self) -> Vec3 {
        let [a, b, c] = self.p;
        (b - a).cross(c - a)
    }

    /// The unit normal of the front, and one over the area; `None` without area.
    #[inline]
    fn normal_and_inv_area(&self) -> Option<(Vec3, f32)> {
        let normal = self.scaled_normal();
        let scale = 1.0 / normal_length(normal);
        let n = if has_digits(normal.length_squared()) {
            normal * scale
        } else {
            light_math::direction(normal)?
        };
        (scale > 0.0 && scale.is_finite()).then_some((n, 2.0 * scale))
    }

    #[inline]
    fn at(&self, b: Vec3, n: Vec3) -> SurfacePoint {
        let [uv0, uv1, uv2] = self.uv;
        SurfacePoint {
            p: self.p[0] + self.offset_at(b),
            n,
            uv: uv0 * b.x + uv1 * b.y + uv2 * b.z,
        }
    }

    /// The triangle on the sphere of directions around `p`; `None` where it is so small that it is
    /// sampled by area.
    #[inline]
    fn seen_from(&self, p: Vec3) -> Option<SphericalTriangle> {
        if self.is_small_from(p) {
            return None;
        }
        SphericalTriangle::new(self.p, p).filter(|seen| seen.solid_angle() > SMALL)
    }

    /// A cheap bound: whether the triangle cannot cover more than [`SMALL`], which holds for most
    /// triangles and points.
    ///
    /// At the height `h` over its plane and a distance of at least `r` from all of it, an area `A`
    /// covers at most `h A / r^3`.
    #[inline]
    fn is_small_from(&self, p: Vec3) -> bool {
        let [a, b, c] = self.p;
        let edge_sq = (b - a).length_squared().max((c - a).length_squared());
        let r = (p - a).length() - sqrt(edge_sq);
        r > 0.0 && self.scaled_normal().dot(p - a).abs() < SMALL_BOUND * (r * r * r)
    }

    /// The square of a [`SphericalTriangle`] has the second vertex all along its lower side.
    #[inline]
    fn receiver_cosine(ctx: &LightSampleContext, seen: &SphericalTriangle) -> ReceiverCosine {
        let [a, b, c] = seen.directions();
        ReceiverCosine::toward(ctx, [b, b, a, c])
    }

    /// From `p` to the point at `b`: not by way of the point itself, whose rounding grows with the
    /// coordinates of the scene.
    #[inline]
    fn toward(&self, p: Vec3, b: Vec3) -> Vec3 {
        (self.p[0] - p) + self.offset_at(b)
    }

    /// From the first vertex to the point at `b`.
    #[inline]
    fn offset_at(&self, b: Vec3) -> Vec3 {
        let [p0, p1, p2] = self.p;
        (p1 - p0) * b.y + (p2 - p0) * b.z
    }

    /// Where the ray meets the triangle, and the vector from its origin, which may be off by `error`, to
    /// there.
    fn intersect(&self, origin: Vec3, direction: Vec3, error: f32) -> Option<(Vec3, Vec3)> {
        let b = self.barycentric(origin, direction, error)?;
        let to_light = self.toward(origin, b);
        (to_light.dot(direction) > 0.0).then_some((b, to_light))
    }

    /// Barycentric coordinates of the point that the ray passes, if it hits; hits slightly outside
    /// of the edges count.
    ///
    /// Each edge and the origin span a plane, and the ray has to pass all three on the same side.
    /// The triangle is enlarged by the rounding error of the products, so that a direction toward
    /// any point of it always hits, and by that of the origin. What hits beyond its edges by the latter is
    /// at the edge.
    fn barycentric(&self, origin: Vec3, direction: Vec3, error: f32) -> Option<Vec3> {
        let v = self.p.map(|p| p - origin);
        let side = |i: usize, j: usize| {
            let edge = v[j] - v[i];
            let slack = (EDGE_ERROR * v[i].length() + error) * edge.length();
            (direction.dot(v[i].cross(edge)), slack)
        };
        let sides = [side(1, 2), side(2, 0), side(0, 1)];
        let front = sides.iter().all(|(s, slack)| *s >= -slack);
        let back = sides.iter().all(|(s, slack)| *s <= *slack);
        let b = Vec3::from_array(sides.map(|(s, _)| s));
        let sum = b.element_sum();
        if !(front || back) || sum == 0.0 {
            return None;
        }
        let b = b / sum;
        let inside = b.max(Vec3::ZERO);
        Some(if error > 0.0 {
            inside / inside.element_sum()
        } else {
            b
        })
    }
}

impl Shape for Triangle {
    fn area(&self) -> f32 {
        0.5 * normal_length(self.scaled_normal())
    }

    fn bounds(&self) -> Aabb {
        Aabb::from_points(self.p)
    }

    fn normal_cone(&self) -> DirectionCone {
        self.normal()
            .map_or(DirectionCone::EMPTY, DirectionCone::from_direction)
    }

    fn uv_area(&self) -> UvArea {
        UvArea::Triangle(self.uv)
    }

    #[inline(always)]
    fn sample(&self, u: Vec2) -> Option<ShapeSample> {
        let (n, pdf) = self.normal_and_inv_area()?;
        let at = self.at(uniform_triangle::sample(u), n);
        pdf.is_finite().then_some(ShapeSample { at, pdf })
    }

    fn pdf(&self, _at: &SurfacePoint) -> f32 {
        1.0 / self.area()
    }

    #[inline]
    fn sample_toward(&self, ctx: &LightSampleContext, u: Vec2) -> Option<ShapeDirectionSample> {
        let (n, inv_area) = self.normal_and_inv_area()?;
        if is_in_plane(ctx, self.p[0], n) {
            return None;
        }
        let Some(seen) = self.seen_from(ctx.p) else {
            let b = uniform_triangle::sample(u);
            let (at, to_light) = (self.at(b, n), self.toward(ctx.p, b));
            let (wi, pdf) = area_to_solid_angle(inv_area, to_light, n)?;
            return with_density_of_ray(self, ctx, to_light, ShapeDirectionSample { at, wi, pdf });
        };
        let (u, pdf) = Self::receiver_cosine(ctx, &seen).sample(u);
        let b = seen.sample(u);
        let (at, to_light) = (self.at(b, n), self.toward(ctx.p, b));
        let wi = unit_normal(to_light)?;
        let pdf = pdf * seen.pdf();
        with_density_of_ray(self, ctx, to_light, ShapeDirectionSample { at, wi, pdf })
    }

    fn pdf_toward(&self, ctx: &LightSampleContext, wi: Vec3) -> f32 {
        let met = self
            .normal_and_inv_area()
            .zip(self.intersect(ctx.p, wi, ctx.p_error.length()));
        let Some(((n, inv_area), (b, to_light))) = met else {
            return 0.0;
        };
        if is_in_plane(ctx, self.p[0], n) {
            return 0.0;
        }
        match self.seen_from(ctx.p) {
            Some(seen) => Self::receiver_cosine(ctx, &seen).pdf(|| seen.invert(b)) * seen.pdf(),
            None => area_to_solid_angle(inv_area, to_light, n).map_or(0.0, |(_, pdf)| pdf),
        }
    }

    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        let (b, _) = self.intersect(origin, direction, 0.0)?;
        Some(self.at(b, self.normal()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_math::solid_angle;

    #[test]
    fn what_is_left_to_area_looks_small_from_every_side() {
        let uv = Triangle::DEFAULT_UV;
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let (mut small, mut missed) = (0, 0);
        for corners in [corners, [corners[1], corners[0], corners[2]]] {
            let triangle = Triangle::new(corners, uv).expect("a triangle");
            for i in 0..64u8 {
                let (turn, tilt) = (f32::from(i % 8), f32::from(i / 8));
                let (sin, cos) = (0.8 * turn).sin_cos();
                let toward = Vec3::new(cos, sin, 0.1 * tilt * tilt).normalize();
                for p in (0..80u8).map(|d| toward * f32::from(d)) {
                    let omega = solid_angle::triangle(corners, p);
                    if triangle.is_small_from(p) {
                        small += 1;
                        assert!(omega <= SMALL, "{omega} from {p}");
                    } else if omega < SMALL {
                        missed += 1;
                    }
                }
            }
        }
        assert!(small > 10 * missed, "nearly all: {small} and {missed}");
    }

    #[test]
    fn the_normal_of_a_tiny_triangle_is_a_unit_vector() {
        let mut with_normal = 0;
        for size in [1e-8, 1e-10, 1e-11, 1e-20] {
            let corners = [Vec3::ZERO, Vec3::X * size, Vec3::new(0.3, 0.4, 0.5) * size];
            let triangle = Triangle::from_corners(corners, Triangle::DEFAULT_UV);
            let Some(normal) = triangle.normal() else {
                continue;
            };
            with_normal += 1;
            let (length, tilt) = (normal.length(), normal.dot(Vec3::new(0.0, 0.4, 0.5)));
            assert!((length - 1.0).abs() < 1e-6, "size {size}: {normal}");
            assert!(tilt.abs() < 1e-3, "size {size}: {normal}");
        }
        assert!(with_normal > 2, "{with_normal} of four");
    }
}
