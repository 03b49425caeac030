//! The laws of light samplers for contexts that are invalid.

use light_bounds::{Gloss, LightSampleContext};
use light_math::fraction;
use light_math::glam::Vec3;
use light_samplers::LightSampler;

use super::sampler::ROUNDING;
use crate::{Rng, SamplerCase};

/// Lengths at which code tends to fail: many have squares that overflow or vanish.
const LENGTHS: [f32; 12] = [
    1e-45,
    1e-30,
    1e-10,
    0.5,
    1e4,
    1e14,
    1e19,
    1e25,
    1e36,
    f32::MAX,
    f32::INFINITY,
    f32::NAN,
];

/// Contexts like `ctx` with numbers of every kind in each of their fields.
#[must_use]
pub fn invalid_contexts(ctx: &LightSampleContext) -> Vec<LightSampleContext> {
    let p = ctx.p;
    let up = ctx.ns().unwrap_or(Vec3::new(0.48, 0.6, 0.64));
    let surface = LightSampleContext::surface(p, up, up);
    let mut all = Vec::new();
    for x in LENGTHS {
        for on_surface in [LightSampleContext::surface, LightSampleContext::two_sided] {
            let leaning = Vec3::new(x, -0.2, 0.3);
            all.extend([up * x, leaning].map(|ns| on_surface(p, up, ns)));
            all.push(on_surface(p, up * x, up * -x));
            all.push(on_surface(p * x, up, up));
            all.push(on_surface(p, up, up).with_error(up * x));
        }
        all.push(LightSampleContext::medium(Vec3::new(p.x, x, -x)));
        all.extend([
            surface.with_error(Vec3::splat(-x)),
            surface.with_error(Vec3::new(x, -x, f32::NAN)),
            LightSampleContext::medium(p).with_error(Vec3::new(0.0, -x, x)),
            LightSampleContext::segment(p, up).with_error(Vec3::new(-x, x, 1.0)),
        ]);
        for way in [up, -up, Vec3::X] {
            all.push(LightSampleContext::segment(p, way * x));
        }
        all.push(LightSampleContext::segment(p * x, up));
        let smooth = Gloss {
            wo: up,
            alpha: 0.1,
            diffuse: 0.2,
        };
        let odd = [
            Gloss {
                wo: up * x,
                ..smooth
            },
            Gloss {
                wo: Vec3::new(0.0, x, 1.0),
                ..smooth
            },
            Gloss { alpha: x, ..smooth },
            Gloss {
                alpha: -x,
                diffuse: 0.0,
                ..smooth
            },
            Gloss {
                diffuse: x,
                ..smooth
            },
            Gloss {
                diffuse: -x,
                alpha: 0.0,
                ..smooth
            },
            Gloss {
                wo: Vec3::ZERO,
                alpha: x,
                diffuse: x,
            },
        ];
        all.extend(odd.map(|gloss| surface.with_gloss(gloss)));
    }
    all
}

/// At any context the pmfs are a distribution, and sampled and queried pmfs have the same bits.
///
/// # Panics
/// If the law does not hold.
pub fn laws_hold_at_any_context(set: &SamplerCase, sampler: &impl LightSampler) {
    const STRATA: u32 = 32;
    let mut rng = Rng::new(34);
    // Of one context only, for time; which one depends on the number of lights.
    let index = set.emitters.len() % set.contexts.len().max(1);
    let around = set.contexts.get(index).map(invalid_contexts);
    for ctx in around.into_iter().flatten() {
        let name = set.name;
        let pmfs = set.ids().map(|id| {
            let pmf = sampler.pmf(&ctx, id);
            assert!(
                (0.0..=1.0).contains(&pmf),
                "{name}: pmf {pmf} of {id:?} at {ctx:?}"
            );
            f64::from(pmf)
        });
        let sum: f64 = pmfs.sum();
        let rng = &mut rng;
        let inside = (0..STRATA).map(|i| fraction::stratum(i, STRATA, rng.u64()));
        let edges = [0, u64::MAX];
        let mut none = 0;
        for (i, u) in (0..).zip(inside.chain(edges)) {
            let Some(chosen) = sampler.sample(&ctx, u) else {
                none += u32::from(i < STRATA);
                continue;
            };
            let asked = sampler.pmf(&ctx, chosen.light);
            let sound = chosen.pmf.to_bits() == asked.to_bits() && chosen.pmf > 0.0;
            assert!(
                sound,
                "{name}: {chosen:?}, but the queried pmf is {asked} at u = {u}, {ctx:?}"
            );
        }
        // As for valid contexts: a stratum that spans an edge may go either way.
        let predicted = (1.0 - sum).clamp(0.0, 1.0);
        let spread = (predicted * (1.0 - predicted) / f64::from(STRATA)).sqrt();
        let margin = ROUNDING + 5.0 * spread + 3.0 / f64::from(STRATA);
        let off = (sum + f64::from(none) / f64::from(STRATA) - 1.0).abs();
        assert!(
            sum <= 1.0 + ROUNDING && off <= margin,
            "{name}: pmfs sum to {sum}, none in {none} of {STRATA} at {ctx:?}"
        );
    }
}

/// A light that contributes at a point by the direction of its normal can be chosen, however long
/// the normal is; and by any light if it has no direction.
///
/// # Panics
/// If the law does not hold.
pub fn contributing_lights_can_be_chosen_whatever_the_normal(
    set: &SamplerCase,
    sampler: &impl LightSampler,
) {
    for ctx in &set.contexts {
        for length in LENGTHS {
            let Some(ns) = ctx.ns() else { continue };
            let odd = LightSampleContext::surface(ctx.p, ns * length, ns * length);
            for (id, emitter) in set.ids().zip(&set.emitters) {
                assert!(
                    sampler.pmf(&odd, id) > 0.0 || emitter.contribution(&odd) == 0.0,
                    "{}: {id:?} is never chosen at {odd:?}: {emitter:?}",
                    set.name
                );
            }
        }
    }
}
