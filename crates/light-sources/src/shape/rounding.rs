//! Rounding of the places where directions meet a surface.

use super::sphere::OWN_ERROR;
use super::{Shape, ShapeDirectionSample};
use crate::glam::Vec3;
use crate::surface_point::SurfacePoint;
use light_bounds::LightSampleContext;

/// The distance, as a part of the coordinates, within which their rounding shows.
pub(super) const CLOSE: f32 = 1e-3;

/// The cosine below which the height of a receiver over a plane has few digits.
pub(super) const GRAZING: f32 = 1e-3;

/// Whether rounding changes visibly where the direction `wi` along `to_light` meets a surface, and
/// the density there: because the point `at` is so close, compared with its coordinates, or because
/// `wi` comes in so low over the surface.
#[inline]
pub(super) fn is_within_rounding(wi: Vec3, to_light: Vec3, at: &SurfacePoint) -> bool {
    let is_close = to_light.length_squared() < CLOSE * CLOSE * at.p.length_squared();
    is_close || wi.dot(at.n).abs() < GRAZING
}

/// The sine below which a receiver's normal is that of a flat surface: some are stored with few
/// digits.
pub(super) const PARALLEL: f32 = 1e-3;

/// Whether the receiver may be a point of the plane through `on` with the unit normal `n`, wherever
/// rounding has put it: by its place and its normal. Nothing in a plane lights it, but from 1e-8
/// below, an emitter covers the half space.
#[inline]
pub(super) fn is_in_plane(ctx: &LightSampleContext, on: Vec3, n: Vec3) -> bool {
    let size = on.abs().max(ctx.p.abs()).max_element();
    let error = 2.0 * ctx.p_error.dot(n.abs()) + OWN_ERROR * size;
    let is_parallel = |other: Vec3| other.cross(n).length_squared() <= PARALLEL * PARALLEL;
    (ctx.p - on).dot(n).abs() <= error && ctx.n().is_some_and(is_parallel)
}

/// The sample of a flat `shape`, with the density that a query has for its direction where rounding
/// may tell them apart; `None` where a query has none.
///
/// The point stays the one that was chosen, as it lies on the ray: where a low ray meets the
/// surface is known less well than the ray.
#[inline]
pub(super) fn with_density_of_ray(
    shape: &impl Shape,
    ctx: &LightSampleContext,
    to_light: Vec3,
    sample: ShapeDirectionSample,
) -> Option<ShapeDirectionSample> {
    if !is_within_rounding(sample.wi, to_light, &sample.at) {
        return Some(sample);
    }
    queried(shape, ctx, sample)
}

#[cold]
fn queried(
    shape: &impl Shape,
    ctx: &LightSampleContext,
    sample: ShapeDirectionSample,
) -> Option<ShapeDirectionSample> {
    let pdf = shape.pdf_toward(ctx, sample.wi);
    (pdf > 0.0).then_some(ShapeDirectionSample { pdf, ..sample })
}

/// The rounding error of a hit, as a part of the coordinates that were subtracted.
pub(super) const HIT_ERROR: f32 = 4.0 * f32::EPSILON;

/// Rounding error of the intersection of a ray with a surface at the given distance, as a length
/// along the surface; it grows at grazing angles. Edges are extended by it, so that a direction
/// toward any point hits.
///
/// `magnitude` is the size of the coordinates that were subtracted, and `error` how far the origin of
/// the ray may be from where it is.
pub(super) fn hit_slack(magnitude: f32, error: f32, cos_theta: f32) -> f32 {
    (HIT_ERROR * magnitude + error) / cos_theta.abs()
}
