use lights::bounds::LightSampleContext;
use lights::glam::{Vec2, Vec3};
use lights::math::direction;
use lights::sources::SurfacePoint;

use crate::{PrimitiveId, QuadricShape, Ray};

/// A point on a surface where a path meets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// The point.
    pub p: Vec3,
    /// Half widths of the box around `p` in which the exact point lies.
    pub p_error: Vec3,
    /// Unit geometric normal, on the counter-clockwise side.
    pub n: Vec3,
    /// Unit shading normal, on the side of `n`.
    pub ns: Vec3,
    /// Texture coordinates.
    pub uv: Vec2,
    /// Texture coordinates for images that use the second ones.
    pub second_uv: Vec2,
    /// Linear RGB that multiplies the colour of the material.
    pub color: Vec3,
    /// The primitive.
    pub primitive: PrimitiveId,
}

/// A generous multiple of the rounding error of a sum of two or three products.
const ERROR: f32 = 8.0 * f32::EPSILON;

/// The unit vector along a normal that is as long as an area, whose square may be more or less than
/// a float holds; 0 without a direction.
#[inline]
fn unit_normal(normal: Vec3) -> Vec3 {
    if (f32::MIN_POSITIVE..=f32::MAX).contains(&normal.length_squared()) {
        normal.normalize()
    } else {
        direction(normal).unwrap_or(Vec3::ZERO)
    }
}

impl Surface {
    /// The point with the given weights of the second and third of `corners`; flat, without texture
    /// coordinates.
    ///
    /// The error bound is a generous multiple of the rounding error of the interpolation, so that a
    /// ray which starts outside of it does not meet a neighbour in the same plane.
    #[inline]
    #[must_use]
    pub(crate) fn on_triangle(
        triangle: PrimitiveId,
        corners: [Vec3; 3],
        barycentric: Vec2,
    ) -> Self {
        let [a, b, c] = corners;
        let weights = [
            1.0 - barycentric.x - barycentric.y,
            barycentric.x,
            barycentric.y,
        ];
        let [pa, pb, pc] = [a * weights[0], b * weights[1], c * weights[2]];
        let n = unit_normal((b - a).cross(c - a));
        Self {
            p: pa + pb + pc,
            p_error: (pa.abs() + pb.abs() + pc.abs()) * ERROR,
            n,
            ns: n,
            uv: barycentric,
            second_uv: Vec2::ZERO,
            color: Vec3::ONE,
            primitive: triangle,
        }
    }

    /// The point `at` of a quadric, with its normal; the error bound is that of a triangle.
    #[must_use]
    pub(crate) fn on_quadric(id: PrimitiveId, shape: &QuadricShape, at: &SurfacePoint) -> Self {
        let &SurfacePoint { p, n, uv } = at;
        Self {
            p,
            p_error: shape.magnitude(n) * ERROR,
            n,
            ns: n,
            uv,
            second_uv: Vec2::ZERO,
            color: Vec3::ONE,
            primitive: id,
        }
    }

    /// The point `at` of a light that says itself where rays hit it; the error bound is that of its
    /// coordinates.
    #[must_use]
    pub(crate) fn on_light(id: PrimitiveId, at: &SurfacePoint) -> Self {
        let &SurfacePoint { p, n, uv } = at;
        Self {
            p,
            p_error: p.abs() * ERROR,
            n,
            ns: n,
            uv,
            second_uv: Vec2::ZERO,
            color: Vec3::ONE,
            primitive: id,
        }
    }

    /// The point with the shading normal that `normals` of the corners give, turned to the side of
    /// `n`; flat without them.
    #[inline]
    #[must_use]
    pub(crate) fn with_normals(self, normals: Option<[Vec3; 3]>, barycentric: Vec2) -> Self {
        let Some([a, b, c]) = normals else {
            return self;
        };
        let Vec2 { x, y } = barycentric;
        let ns = (a * (1.0 - x - y) + b * x + c * y).normalize_or(self.n);
        let ns = if ns.dot(self.n) < 0.0 { -ns } else { ns };
        Self { ns, ..self }
    }

    /// The first and the second texture coordinates.
    #[inline]
    #[must_use]
    pub(crate) const fn uvs(&self) -> [Vec2; 2] {
        [self.uv, self.second_uv]
    }

    /// A ray from here in the unit direction `wi`, started beyond the error bounds of the surface.
    #[inline]
    #[must_use]
    pub fn spawn(&self, wi: Vec3) -> Ray {
        let outward = if wi.dot(self.n) < 0.0 {
            -self.n
        } else {
            self.n
        };
        let offset = outward * self.n.abs().dot(self.p_error);
        Ray {
            origin: self.p + offset,
            direction: wi,
        }
    }

    /// The context for light samplers and lights at this point, with the normals turned to
    /// the side of `wo`.
    #[inline]
    #[must_use]
    pub fn light_context(&self, wo: Vec3) -> LightSampleContext {
        let side = if wo.dot(self.n) < 0.0 { -1.0 } else { 1.0 };
        LightSampleContext::surface(self.p, self.n * side, self.ns * side).with_error(self.p_error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface() -> Surface {
        let corners = [Vec3::ZERO, Vec3::X * 3.0, Vec3::Y * 3.0].map(|v| v + Vec3::Z * 100.0);
        Surface::on_triangle(PrimitiveId::new(5), corners, Vec2::new(0.25, 0.5))
    }

    #[test]
    fn interpolates_and_orients() {
        let s = surface();
        assert!(
            s.p.distance(Vec3::new(0.75, 1.5, 100.0)) < 1e-5,
            "weights of the corners"
        );
        assert_eq!(s.n, Vec3::Z, "the counter-clockwise side");
    }

    #[test]
    fn rays_start_on_the_side_they_leave_to() {
        let s = surface();
        let (up, down) = (s.spawn(Vec3::Z), s.spawn(Vec3::NEG_Z));
        assert!(
            up.origin.z > 100.0 && down.origin.z < 100.0,
            "off the plane"
        );
        assert!(up.origin.z - 100.0 < 1e-3, "but not far");
    }

    #[test]
    fn the_context_faces_the_viewer() {
        let s = surface();
        assert_eq!(
            s.light_context(Vec3::NEG_Z).ns(),
            Some(Vec3::NEG_Z),
            "seen from behind"
        );
        assert_eq!(s.light_context(Vec3::Z).n(), Some(Vec3::Z), "front");
    }
}
