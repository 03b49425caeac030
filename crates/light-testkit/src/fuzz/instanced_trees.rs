use light_bounds::{InfiniteBounds, LightExtent, LightId, LightSampleContext};
use light_bvh::{DarkLights, InstancedLightBvh, InstancedLightBvhError};
use light_samplers::{InstancedBvhLightSampler, LightSampler};

use super::input::Input;
use super::placed_scene::{Place, PlacedScene};
use super::sampler_kind::{Kind, check};
use super::samplers::options;

/// Changes of the placements that one input may hold.
const MAX_STEPS: usize = 2;

/// A tree of placed trees obeys the laws for every receiver, after it is built and after refits: no
/// light that contributes is lost, a sampled pmf has the bits of the queried one, pmfs and none add
/// up to one, and numbers of lights lead back to them. A refit remembers nothing of what was
/// before, and one that is refused changes nothing.
///
/// # Panics
/// If a guarantee is violated.
pub fn instanced_trees(data: &[u8]) {
    for most_opened in [usize::MAX, 0] {
        with_opened(data, most_opened);
    }
}

/// The same of a tree with so many lights of opened placements at most.
fn with_opened(data: &[u8], most_opened: usize) {
    let mut input = Input::new(data);
    let options = options(&mut input);
    let contexts = [input.receiver()];
    let us = [input.fraction(), input.fraction()];
    let skies: Vec<_> = (0..input.below(3))
        .map(|_| InfiniteBounds::distant(input.amount(1e30), input.axis()))
        .collect();
    let mut scene = PlacedScene::new(&mut input);
    let prototypes = scene.prototypes(&options);
    let placements = scene.placements();
    let built = InstancedLightBvh::build_opening(prototypes, &placements, &options, most_opened);
    let tree = match built {
        Ok(tree) => tree,
        Err(error) => return check_refused(&scene, error),
    };
    check_numbers(&scene, &tree);
    let mut sampler = InstancedBvhLightSampler::new(tree, &skies).expect("few lights");
    let first = sampler.clone();
    let had_power: Vec<bool> = scene
        .places
        .iter()
        .map(|place| has_power(&scene, place))
        .collect();
    check_lights(&scene, &skies, &sampler, &contexts, &us);
    for _ in 0..MAX_STEPS {
        if input.is_empty() || scene.places.is_empty() {
            return;
        }
        let mut next = scene.clone();
        let at = input.below(next.places.len());
        let prototype = next.places[at].placement.prototype();
        next.places[at] = Place::new(prototype, &mut input);
        let before = answers(&sampler, &contexts[0]);
        match sampler.refit(&next.placements()) {
            Ok(()) => {
                scene = next;
                check_lights(&scene, &skies, &sampler, &contexts, &us);
                let mut at_once = first.clone();
                let refit = at_once.refit(&scene.placements());
                refit.expect("as it was done in steps");
                let (steps, at_once) = (&sampler, &at_once);
                let both = [steps, at_once].map(|sampler| answers(sampler, &contexts[0]));
                assert_eq!(both[0], both[1], "a refit remembers: {scene:?}");
            }
            Err(error) => {
                let is_new = |placement: usize| !had_power[placement];
                let is_left_out = options.dark == DarkLights::LeftOut;
                match error {
                    InstancedLightBvhError::NoPlace { placement } => assert!(
                        is_left_out && is_new(placement as usize),
                        "{error}: {next:?}"
                    ),
                    _ => check_refused(&next, error),
                }
                let after = answers(&sampler, &contexts[0]);
                assert_eq!(before, after, "a refused refit changes the tree: {next:?}");
            }
        }
    }
}

/// Whether some light of a placement is on.
fn has_power(scene: &PlacedScene, place: &Place) -> bool {
    let mut lights = scene.lights_of(place).iter();
    lights.any(|light| place.is_lit(light))
}

/// Placements are refused only if they are far away.
fn check_refused(scene: &PlacedScene, error: InstancedLightBvhError) {
    let InstancedLightBvhError::TooFar { placement } = error else {
        panic!("{error}: {scene:?}");
    };
    let place = &scene.places[placement as usize];
    assert!(scene.may_be_far(place), "{error}: {scene:?}");
}

/// Each number leads to a light and back.
fn check_numbers(scene: &PlacedScene, tree: &InstancedLightBvh) {
    let count = scene.lights().count() as u64;
    assert_eq!(tree.light_count(), count, "{scene:?}");
    for index in 0..count {
        let light = tree.light_of_index(index);
        let again = light.and_then(|light| tree.light_index(light));
        assert_eq!(again, Some(index), "{light:?}");
    }
    assert_eq!(tree.light_of_index(count), None, "one too many");
}

/// All laws of a sampler of the scene's lights and of skies.
fn check_lights(
    scene: &PlacedScene,
    skies: &[InfiniteBounds],
    sampler: &InstancedBvhLightSampler,
    contexts: &[LightSampleContext],
    us: &[u64],
) {
    // What contributes is looked at below, in the frame of the prototype: the box of a turned box
    // says less than the sampler knows.
    let nothing = LightExtent::Infinite(InfiniteBounds::uniform(0.0));
    let placed = scene.lights().map(|_| nothing);
    let skies = skies.iter().copied().map(LightExtent::Infinite);
    let all: Vec<_> = placed.chain(skies).collect();
    check(Kind::named("instanced"), sampler, &all, contexts, us);
    for (id, (place, light)) in (0..).map(LightId).zip(scene.lights()) {
        let emitted = sampler.pmf_emitter(id);
        assert_eq!(
            emitted > 0.0,
            place.is_lit(light),
            "{id:?} is chosen to emit with {emitted}: {light:?} at {place:?}"
        );
        for ctx in contexts {
            let pmf = sampler.pmf(ctx, id);
            assert!(
                pmf > 0.0 || !place.may_contribute(light, ctx),
                "{id:?} may contribute and has pmf {pmf}: {light:?} at {place:?}, seen by {ctx:?}"
            );
            assert!(pmf == 0.0 || place.is_lit(light), "{id:?} is dark: {pmf}");
        }
    }
}

/// Everything that a sampler says at a receiver, in bits.
fn answers(sampler: &InstancedBvhLightSampler, ctx: &LightSampleContext) -> Vec<[u32; 2]> {
    let count = sampler.tree().light_count() as u32;
    let pmfs = |id| [sampler.pmf(ctx, id), sampler.pmf_emitter(id)];
    (0..count)
        .map(LightId)
        .map(|id| pmfs(id).map(f32::to_bits))
        .collect()
}
