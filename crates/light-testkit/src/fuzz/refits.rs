use light_bounds::{InfiniteBounds, LightExtent, LightId, LightSampleContext};
use light_bvh::{DarkLights, LightBvhOptions};
use light_math::glam::Vec3;
use light_samplers::{BvhLightSampler, LightSampler};

use super::input::Input;
use super::sampler_kind::{Kind, check, power};
use super::samplers::options;

/// Lights that one input may hold: enough for two levels of wide nodes.
const MAX_LIGHTS: usize = 24;

/// Changes of the lights that one input may hold.
const MAX_STEPS: usize = 3;

/// How far the share of all lights of a tree may be from that of another's: the probabilities that
/// add up to it are rounded.
const SHARE_ROUNDING: f64 = 2e-5;

/// The largest coordinate that the default tree takes.
const MAX_PLACE: Vec3 = Vec3::splat(1e36);

/// A tree that follows its lights obeys the laws after each step, as the one that is built of them
/// does, and divides power between the sky and itself in the same way; it remembers nothing of the
/// steps before; a step that it refuses leaves it as it was.
///
/// How the lights of a tree share what is emitted depends on its shape, so that no light's share is
/// compared with that in a rebuilt tree. A node weighs a group by its power times the unit of its
/// axes, which is 0.29 to 1 times the root mean square of axes and offsets in it, in codes that are
/// right to a sixteenth, and to 2^-34 of the largest child.
///
/// # Panics
/// If a guarantee is violated.
pub fn refits(data: &[u8]) {
    let mut input = Input::new(data);
    let options = options(&mut input);
    let contexts = [input.receiver()];
    let us = [input.fraction()];
    let count = input.below(MAX_LIGHTS) + 1;
    let first: Vec<LightExtent> = (0..count).map(|_| input.scene_extent()).collect();
    let mut tree = BvhLightSampler::with_options(&first, &options).expect("valid lights");
    let fresh = tree.clone();
    let mut lights = first.clone();
    for _ in 0..MAX_STEPS {
        if input.is_empty() {
            return;
        }
        let mut next = lights.clone();
        for _ in 0..=input.below(4) {
            change(&mut next, &mut input);
        }
        let before = answers(&tree, &lights, &contexts[0]);
        match tree.refit(&next) {
            Ok(()) => {
                assert!(
                    fits(&first, &next, &options),
                    "no place for {next:?} in the tree of {first:?}"
                );
                lights = next;
                check(Kind::named("refit"), &tree, &lights, &contexts, &us);
                compare(&tree, &lights, &options, &contexts, &us);
                let mut at_once = fresh.clone();
                at_once.refit(&lights).expect("as it was done in steps");
                assert_eq!(
                    answers(&tree, &lights, &contexts[0]),
                    answers(&at_once, &lights, &contexts[0]),
                    "a refit remembers what was before: {lights:?}"
                );
            }
            Err(error) => {
                assert!(
                    !fits(&first, &next, &options),
                    "{error}: {next:?} in the tree of {first:?}"
                );
                let after = answers(&tree, &lights, &contexts[0]);
                assert_eq!(before, after, "a refused refit changes the tree");
            }
        }
    }
}

/// Moves a light, turns it, switches it, or puts another in its place.
fn change(lights: &mut [LightExtent], input: &mut Input<'_>) {
    let at = input.below(lights.len());
    let light = &mut lights[at];
    match (input.byte() % 8, &mut *light) {
        (0, _) => *light = input.scene_extent(),
        (1, _) => set_power(light, 0.0),
        (2, _) => set_power(light, input.amount(1e30)),
        (3, LightExtent::Bounded(bounds)) => bounds.w = input.axis(),
        (3, LightExtent::Lobe(_, lobe)) => lobe.mean = input.axis() * input.unit(),
        (_, LightExtent::Bounded(bounds) | LightExtent::Lobe(bounds, _)) => {
            let by = input.place();
            let moved = |p: Vec3| (p + by).clamp(-MAX_PLACE, MAX_PLACE);
            bounds.bounds.min = moved(bounds.bounds.min);
            bounds.bounds.max = moved(bounds.bounds.max);
        }
        (_, LightExtent::Infinite(bounds)) => {
            *bounds = InfiniteBounds::distant(bounds.fluence, input.axis());
        }
    }
}

fn set_power(light: &mut LightExtent, power: f32) {
    match light {
        LightExtent::Bounded(bounds) => bounds.phi = power,
        LightExtent::Lobe(bounds, lobe) => {
            bounds.phi = power;
            lobe.power = power;
        }
        LightExtent::Infinite(bounds) => bounds.fluence = power,
    }
}

/// Whether the documentation of `refit` says that the tree of `first` can follow to `next`.
fn fits(first: &[LightExtent], next: &[LightExtent], options: &LightBvhOptions) -> bool {
    first.iter().zip(next).all(|(before, now)| {
        let has_place = match before.infinite() {
            Some(_) => false,
            None => options.dark == DarkLights::Kept || power(before) > 0.0,
        };
        match now.infinite() {
            Some(_) => !has_place,
            None => has_place || power(now) == 0.0,
        }
    })
}

/// Against the sampler that is built of the lights: the same power, the same sky, the same laws.
fn compare(
    refit: &BvhLightSampler,
    lights: &[LightExtent],
    options: &LightBvhOptions,
    contexts: &[LightSampleContext],
    us: &[u64],
) {
    let rebuilt = BvhLightSampler::with_options(lights, options).expect("valid lights");
    check(Kind::named("rebuilt"), &rebuilt, lights, contexts, us);
    let powers = [refit, &rebuilt].map(|sampler| sampler.tree().power());
    assert_eq!(
        powers[0], powers[1],
        "after a refit and of a rebuilt tree: {lights:?}"
    );
    let [mut tree_of_refit, mut tree_of_rebuilt] = [0.0; 2];
    for (id, light) in (0..).map(LightId).zip(lights) {
        let [a, b] = [refit, &rebuilt].map(|sampler| f64::from(sampler.pmf_emitter(id)));
        if light.infinite().is_some() {
            assert_eq!(
                a, b,
                "{id:?} emits after a refit and when rebuilt: {light:?} of {lights:?}"
            );
        } else {
            tree_of_refit += a;
            tree_of_rebuilt += b;
        }
    }
    assert!(
        (tree_of_refit - tree_of_rebuilt).abs() <= SHARE_ROUNDING,
        "the tree emits with {tree_of_refit} after a refit, {tree_of_rebuilt} when rebuilt: \
         {lights:?}"
    );
}

/// Everything that a sampler says at a receiver, in bits.
fn answers(
    sampler: &BvhLightSampler,
    lights: &[LightExtent],
    ctx: &LightSampleContext,
) -> (u32, Vec<[u32; 2]>) {
    let ids = (0..lights.len() as u32).map(LightId);
    let pmfs = ids.map(|id| [sampler.pmf(ctx, id), sampler.pmf_emitter(id)].map(f32::to_bits));
    (sampler.tree().power().to_bits(), pmfs.collect())
}
