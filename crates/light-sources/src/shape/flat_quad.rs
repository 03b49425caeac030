use super::receiver_cosine::ReceiverCosine;
use super::solid_angle::SMALL;
use super::{Shape, ShapeDirectionSample, Triangle};
use crate::glam::{Vec2, Vec3};
use light_bounds::LightSampleContext;
use light_math::solid_angle;

/// A flat convex quadrilateral seen from a point, as the two triangles on both sides of a diagonal.
///
/// The triangles are chosen in proportion to solid angle times mean cosine, so that the density has
/// no step at the diagonal.
#[derive(Clone, Copy, Debug)]
pub(super) struct FlatQuad {
    triangles: [Triangle; 2],
    /// The probability of the first.
    first: f32,
}

impl FlatQuad {
    /// The view from `ctx` of the quadrilateral with the corners at (u, v) = (0, 0), (1, 0), (0,
    /// 1), (1, 1); `None` where it is so small that it is sampled by area.
    pub(super) fn new(ctx: &LightSampleContext, [p00, p10, p01, p11]: [Vec3; 4]) -> Option<Self> {
        let triangles = [[p00, p10, p11], [p00, p11, p01]];
        let angles = triangles.map(|t| solid_angle::triangle(t, ctx.p));
        if !(angles[0] + angles[1] > SMALL) {
            return None;
        }
        let mean_cosine = |[a, b, c]: [Vec3; 3]| ReceiverCosine::new(ctx, [b, b, a, c]).mean();
        let [first, second] = [0, 1].map(|i| angles[i] * mean_cosine(triangles[i]));
        Some(Self {
            triangles: triangles.map(|p| Triangle::from_corners(p, Triangle::DEFAULT_UV)),
            first: first / (first + second),
        })
    }

    /// A direction toward the quadrilateral; the point on it has the parameters of a triangle. The
    /// density is that of the direction as it is rounded, which may pass the other triangle.
    pub(super) fn sample(&self, ctx: &LightSampleContext, u: Vec2) -> Option<ShapeDirectionSample> {
        let is_first = u.x < self.first;
        let (triangle, start, chance) = if is_first {
            (&self.triangles[0], 0.0, self.first)
        } else {
            (&self.triangles[1], self.first, 1.0 - self.first)
        };
        // The rest of the number is uniform again: by at least 2^-24 below `chance`, so below
        // 1.
        let x = (u.x - start) / chance;
        let sample = triangle.sample_toward(ctx, Vec2::new(x, u.y))?;
        let pdf = self.pdf(ctx, sample.wi);
        (pdf > 0.0).then_some(ShapeDirectionSample { pdf, ..sample })
    }

    /// Where rounding lets a direction pass both triangles, the larger density: both have nearly
    /// the same, unless one is a sliver, whose density says nothing of the other.
    pub(super) fn pdf(&self, ctx: &LightSampleContext, wi: Vec3) -> f32 {
        let larger = |ctx: &LightSampleContext| {
            let [first, second] = self.triangles.each_ref().map(|t| t.pdf_toward(ctx, wi));
            (first * self.first).max(second * (1.0 - self.first))
        };
        // The error of the receiver enlarges triangles beyond the diagonal, too.
        let exact = larger(&ctx.with_error(Vec3::ZERO));
        if exact > 0.0 { exact } else { larger(ctx) }
    }
}
