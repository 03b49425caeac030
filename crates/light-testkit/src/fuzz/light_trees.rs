use light_bounds::{LightExtent, LightId, LightSampleContext};
use light_math::glam::Vec3;
use light_samplers::{BvhLightSampler, LightSampler, ReferenceBvhLightSampler};

use super::input::Input;

/// Lights that one input may hold: enough for a few levels.
const MAX_LIGHTS: usize = 40;

/// Both trees refuse lights that are not valid, and have a result for every query about the others:
/// the pmf of a sample has the bits of the queried pmf, and pmfs sum to one at most.
///
/// # Panics
/// If a guarantee is violated.
pub fn light_trees(data: &[u8]) {
    let mut input = Input::new(data);
    let contexts = [input.context(), input.context()];
    let us = [input.fraction(), input.fraction(), input.fraction()];
    let mut lights = Vec::new();
    while !input.is_empty() && lights.len() < MAX_LIGHTS {
        lights.push(input.extent());
    }
    let valid = lights.iter().all(is_valid);
    let reference = ReferenceBvhLightSampler::new(&lights);
    assert_eq!(
        reference.is_ok(),
        valid,
        "the reference tree takes all valid lights and no others"
    );
    let default = BvhLightSampler::new(&lights);
    assert_eq!(
        default.is_ok(),
        valid && lights.iter().all(is_near),
        "the default tree takes all valid lights that are not too far, and no others"
    );
    for ctx in &contexts {
        if let (Ok(reference), Ok(default)) = (&reference, &default) {
            check(reference, lights.len(), ctx, &us);
            check(default, lights.len(), ctx, &us);
        }
    }
}

fn is_valid(light: &LightExtent) -> bool {
    match light {
        LightExtent::Bounded(bounds) => bounds.validate().is_ok(),
        LightExtent::Lobe(bounds, lobe) => bounds.validate().is_ok() && lobe.is_valid(),
        LightExtent::Infinite(bounds) => bounds.validate().is_ok(),
    }
}

/// Whether the default tree promises to take differences of its coordinates.
fn is_near(light: &LightExtent) -> bool {
    let near = |p: Vec3| p.abs().max_element() <= 1e36;
    light
        .bounded()
        .is_none_or(|b| near(b.bounds.min) && near(b.bounds.max))
}

fn check(sampler: &impl LightSampler, count: usize, ctx: &LightSampleContext, us: &[u64]) {
    let ids = (0..count as u32).map(LightId);
    let sum: f64 = ids.map(|id| f64::from(sampler.pmf(ctx, id))).sum();
    assert!(
        (0.0..=1.0 + 1e-4).contains(&sum),
        "pmfs sum to {sum} at {ctx:?}"
    );
    for &u in us {
        let Some(chosen) = sampler.sample(ctx, u) else {
            continue;
        };
        let asked = sampler.pmf(ctx, chosen.light);
        assert_eq!(
            chosen.pmf.to_bits(),
            asked.to_bits(),
            "{chosen:?}, but the queried pmf is {asked} at {ctx:?}"
        );
        assert!(chosen.pmf > 0.0, "{chosen:?}");
    }
}
