//! Rounding of the places where directions meet a surface.

use super::{DirectionSample, Shape};
use crate::glam::Vec3;
use light_bounds::LightSampleContext;

/// The distance, as a part of the coordinates, within which their rounding shows.
pub(super) const CLOSE: f32 = 1e-3;

/// The cosine below which the height of a receiver over a plane has few digits.
const GRAZING: f32 = 1e-3;

/// Whether a direction comes in so low over a surface with unit normal `n` that rounding changes
/// where it meets the surface, and the density there, visibly.
#[inline]
pub(super) fn is_edge_on(wi: Vec3, n: Vec3) -> bool {
    wi.dot(n).abs() < GRAZING
}

/// Whether a point `at` is so close, compared with its coordinates, that their rounding turns the
/// direction `to_light` visibly.
#[inline]
pub(super) fn is_within_rounding(to_light: Vec3, at: Vec3) -> bool {
    to_light.length_squared() < CLOSE * CLOSE * at.length_squared()
}

/// The sample of `shape` whose direction is `wi`, with the point that the direction meets and the
/// density that it has, if it meets one.
#[cold]
pub(super) fn met_by(
    shape: &impl Shape,
    ctx: &LightSampleContext,
    wi: Vec3,
) -> Option<DirectionSample> {
    let at = shape.hit(ctx.p, wi)?;
    let pdf = shape.pdf_toward(ctx, wi);
    (pdf > 0.0).then_some(DirectionSample { at, wi, pdf })
}

/// The rounding error of a hit, as a part of the coordinates that were subtracted.
pub(super) const HIT_ERROR: f32 = 4.0 * f32::EPSILON;

/// Rounding error of the intersection of a ray with a surface at the given distance, as a length
/// along the surface; it grows at grazing angles. Edges are extended by it, so that a direction
/// toward any point hits.
///
/// `magnitude` is the size of the coordinates that were subtracted.
pub(super) fn hit_slack(magnitude: f32, cos_theta: f32) -> f32 {
    HIT_ERROR * magnitude / cos_theta.abs()
}
