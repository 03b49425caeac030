use light_bounds::LightSampleContext;
use light_math::glam::{Vec2, Vec3};
use light_sources::{ColorModel, Light, PdfCoverage};

use super::LightCase;
use super::case::le;
use crate::{Rng, edge_cases};

/// The bounds of a light have an importance above 0 wherever its light arrives.
///
/// # Panics
/// If the law does not hold.
pub fn bounds_hold<C: ColorModel, L: Light<C>>(case: &LightCase<'_, C, L>) {
    let extent = case.light.extent();
    let mut rng = Rng::new(47);
    for ctx in &case.contexts {
        for _ in 0..64 {
            let Some(sample) = case.li(ctx, rng.vec2(), PdfCoverage::Complete) else {
                continue;
            };
            let above = ctx.ns().is_none_or(|ns| ns.dot(sample.wi) > 1e-4);
            if !(sample.l > 0.0 && above) {
                continue;
            }
            let may = match (extent.bounded(), extent.infinite()) {
                (Some(bounds), _) => bounds.importance(ctx) > 0.0,
                (_, Some(bounds)) => {
                    bounds.fluence > 0.0
                        && sample.wi.dot(bounds.cone.w) >= bounds.cone.cos_theta - 1e-5
                }
                _ => false,
            };
            assert!(
                may,
                "{}: {sample:?} arrives, {extent:?} denies it at {ctx:?}",
                case.name
            );
        }
    }
}

/// At the edges of `u`, on the light and far away, samples are valid or none; nothing panics.
///
/// # Panics
/// If the law does not hold.
pub fn edges_are_survived<C: ColorModel, L: Light<C>>(case: &LightCase<'_, C, L>) {
    let mut contexts = case.contexts.clone();
    if let Some(bounds) = case.light.bounds() {
        let points = [bounds.bounds.center(), bounds.bounds.min, bounds.bounds.max];
        contexts.extend(points.map(LightSampleContext::medium));
        let far = [1e-20, 1e6, 1e18, f32::MAX, f32::NAN];
        contexts.extend(far.map(|x| LightSampleContext::medium(Vec3::new(x, -x, 0.5 * x))));
    }
    let us = edge_cases::EDGES_OF_U;
    let pairs = us.iter().flat_map(|&x| us.map(|y| Vec2::new(x, y)));
    for u in pairs {
        for ctx in &contexts {
            let Some(sample) = case.li(ctx, u, PdfCoverage::Complete) else {
                continue;
            };
            let wi_is_unit = (sample.wi.length() - 1.0).abs() < 1e-4;
            assert!(
                sample.pdf > 0.0 && sample.pdf.is_finite() && sample.l >= 0.0 && wi_is_unit,
                "{}: {sample:?} is no valid sample for {u} at {ctx:?}",
                case.name
            );
        }
        for v in [
            Vec2::ZERO,
            Vec2::splat(light_math::float::ONE_MINUS_EPSILON),
        ] {
            let power = le(case, u, v).power;
            assert!(
                power.is_finite(),
                "{}: a ray for {u}, {v} carries {power}",
                case.name
            );
        }
    }
}
