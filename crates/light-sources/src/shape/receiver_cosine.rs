use crate::glam::{Vec2, Vec3};
use light_bounds::LightSampleContext;
use light_math::warp::bilinear;

/// A warp of the random numbers for a shape that is sampled by solid angle, in proportion to the
/// receiver's cosine.
///
/// The cosine at the directions toward the corners of the unit square, interpolated between them:
/// the density is nearly in proportion to solid angle times cosine. In a medium the warp is the
/// identity.
///
/// # Source
/// `[Hart2020]`, section 4. A corner below the horizon counts as one above it at the same angle, as
/// the receiver may transmit; no corner counts less than 1/100, so that the density never gets near
/// 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct ReceiverCosine(Option<[f32; 4]>);

pub(super) const SMALLEST: f32 = 0.01;

impl ReceiverCosine {
    /// The map for a receiver, where the corners (0, 0), (1, 0), (0, 1), (1, 1) of the square stand
    /// for `points`.
    pub(super) fn new(ctx: &LightSampleContext, points: [Vec3; 4]) -> Self {
        Self::toward(ctx, points.map(|p| (p - ctx.p).normalize_or_zero()))
    }

    /// The same, where they represent points in these `directions`.
    #[inline]
    pub(super) fn toward(ctx: &LightSampleContext, directions: [Vec3; 4]) -> Self {
        let cosine = |ns: Vec3| directions.map(|w| w.dot(ns).abs().max(SMALLEST));
        Self(ctx.ns().map(cosine))
    }

    /// The mean cosine over the square, 1 in a medium.
    pub(super) fn mean(&self) -> f32 {
        self.0
            .map_or(1.0, |weights| 0.25 * weights.iter().sum::<f32>())
    }

    /// The image of `u`, and the density there.
    #[inline]
    pub(super) fn sample(&self, u: Vec2) -> (Vec2, f32) {
        match self.0 {
            None => (u, 1.0),
            Some(weights) => {
                let u = bilinear::sample(u, weights);
                (u, bilinear::pdf(u, weights))
            }
        }
    }

    /// The density at the point that `place` returns, which is not called where the density is
    /// uniform.
    #[inline]
    pub(super) fn pdf(&self, place: impl FnOnce() -> Vec2) -> f32 {
        self.0
            .map_or(1.0, |weights| bilinear::pdf(place(), weights))
    }
}
