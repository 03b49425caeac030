//! A tree of trees obeys the laws of light samplers.

use light_samplers::light_bounds::glam::{Mat3, Quat, Vec3};
use light_samplers::light_bounds::light_math::Aabb;
use light_samplers::light_bounds::{
    EmissionLobe, Gloss, LightBounds, LightExtent, LightId, LightSampleContext, SampledLight,
};
use light_samplers::light_bvh::{InstancedLightBvh, LightBvhOptions, LightPrototype, Placement};
use light_samplers::{
    InstancedBvhLightSampler, InstancedBvhLightSamplerError, LightChoices, LightSampler,
};
use light_testkit::SamplerCase;

use crate::support::asked::Asked;

light_testkit::sampler_laws! {
    /// Every few lights are a prototype, turned back from where it is placed.
    mod instanced {
        |set| taken_apart(set, 7)
    }

    /// The same, none of which is opened.
    mod instanced_closed {
        |set| taken_apart_opening(set, 7, 0)
    }

    /// Every light is a prototype of its own.
    mod instanced_alone {
        |set| taken_apart(set, 1)
    }

    /// The same at surfaces that transmit light.
    mod instanced_two_sided {
        |set| Asked(taken_apart(set, 7), |ctx| match (ctx.n(), ctx.ns()) {
            (Some(n), Some(ns)) => LightSampleContext::two_sided(ctx.p, n, ns),
            _ => *ctx,
        })
    }

    /// The same at glossy surfaces.
    mod instanced_glossy {
        |set| Asked(taken_apart(set, 7), |ctx| {
            let n = ctx.n().unwrap_or(Vec3::Z);
            let wo = (n + 0.9 * n.any_orthonormal_vector()).normalize();
            ctx.with_gloss(Gloss { wo, alpha: 0.1, diffuse: 0.0 })
        })
    }

    /// The same for ray segments.
    mod instanced_segment {
        |set| Asked(
            taken_apart(set, 7),
            |ctx| LightSampleContext::segment(ctx.p, ctx.p * 0.5),
        )
    }
}

/// Turns, scales and translations; translations are shares of a light's position.
fn motion(i: usize) -> (Quat, f32, f32) {
    let quarter = Quat::from_mat3(&Mat3::from_cols(Vec3::Y, Vec3::NEG_X, Vec3::Z));
    let oblique = Quat::from_axis_angle(Vec3::new(0.48, 0.6, 0.64).normalize(), i as f32);
    [
        (Quat::IDENTITY, 1.0, 0.0),
        (quarter, 2.0, 1.0),
        (oblique, 1.0, 0.5),
        (oblique, -0.75, 1.0),
        (oblique, 30.0, -1.0),
    ][i % 5]
}

/// A sampler of the lights of the set as placed prototypes of at most `few` lights.
fn taken_apart(set: &SamplerCase, few: usize) -> Renumbered {
    taken_apart_opening(set, few, usize::MAX)
}

/// The same, with so many lights of opened placements at most.
fn taken_apart_opening(set: &SamplerCase, few: usize, most_opened: usize) -> Renumbered {
    let (mut prototypes, mut placements) = (Vec::new(), Vec::new());
    let (mut bounded, mut infinite) = (Vec::new(), Vec::new());
    for (id, extent) in set.ids().zip(set.extents()) {
        match extent {
            LightExtent::Infinite(bounds) => infinite.push((id, bounds)),
            LightExtent::Bounded(_) | LightExtent::Lobe(..) => bounded.push((id, extent)),
        }
    }
    for (prototype, (i, lights)) in (0..).zip(bounded.chunks(few).enumerate()) {
        let (turn, scale, share) = motion(i);
        let first = lights[0].1.bounded().expect("a light with a position");
        let translation = first.bounds.center() * share;
        let back = |(_, extent): &(LightId, LightExtent)| back(extent, turn, scale, translation);
        let lights: Vec<_> = lights.iter().map(back).collect();
        prototypes.push(LightPrototype::new(&lights).expect("valid bounds"));
        let placement = Placement::new(prototype, turn, scale, translation).expect("rigid");
        placements.push(placement.with_power(1.0).expect("a factor"));
    }
    let options = LightBvhOptions::default();
    let tree = InstancedLightBvh::build_opening(prototypes, &placements, &options, most_opened)
        .expect("within reach");
    let skies: Vec<_> = infinite.iter().map(|(_, bounds)| *bounds).collect();
    let all = bounded.iter().map(|(id, _)| *id);
    let ids: Vec<LightId> = all.chain(infinite.iter().map(|(id, _)| *id)).collect();
    let mut own = vec![LightId(u32::MAX); ids.len()];
    for (light, id) in (0..).map(LightId).zip(&ids) {
        own[id.index()] = light;
    }
    Renumbered {
        sampler: InstancedBvhLightSampler::new(tree, &skies).expect("valid bounds"),
        ids,
        own,
    }
}

/// A light in the frame of its prototype.
fn back(extent: &LightExtent, turn: Quat, scale: f32, translation: Vec3) -> LightExtent {
    let around = turn.inverse();
    let direction = |v: Vec3| around * (v * scale.signum());
    let bounds = |light: &LightBounds| {
        let Aabb { min, max } = light.bounds;
        let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| {
            let pick = |axis: usize| {
                if i >> axis & 1 == 0 {
                    min[axis]
                } else {
                    max[axis]
                }
            };
            let corner = Vec3::new(pick(0), pick(1), pick(2));
            around * ((corner - translation) * (1.0 / scale))
        });
        LightBounds {
            bounds: Aabb::from_points(corners),
            w: direction(light.w).normalize(),
            ..*light
        }
    };
    match extent {
        LightExtent::Bounded(light) => LightExtent::Bounded(bounds(light)),
        LightExtent::Lobe(light, lobe) => {
            let mean = direction(lobe.mean);
            LightExtent::Lobe(bounds(light), EmissionLobe { mean, ..*lobe })
        }
        LightExtent::Infinite(_) => *extent,
    }
}

/// A sampler whose light `i` has the id `ids[i]`; `own` is the other way round.
struct Renumbered {
    sampler: InstancedBvhLightSampler,
    ids: Vec<LightId>,
    own: Vec<LightId>,
}

impl Renumbered {
    fn named(&self, chosen: SampledLight) -> SampledLight {
        let light = self.ids[chosen.light.index()];
        SampledLight { light, ..chosen }
    }

    fn own(&self, light: LightId) -> LightId {
        let own = self.own.get(light.index());
        own.copied().unwrap_or(LightId(u32::MAX))
    }
}

impl LightSampler for Renumbered {
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        self.sampler.sample(ctx, u).map(|chosen| self.named(chosen))
    }

    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.sampler.pmf(ctx, self.own(light))
    }

    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        LightChoices::one_by_one(self, ctx, count)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.sampler
            .sample_emitter(u)
            .map(|chosen| self.named(chosen))
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.sampler.pmf_emitter(self.own(light))
    }
}

#[test]
fn too_many_lights_for_ids_are_refused() {
    let point = LightBounds {
        bounds: Aabb::from_point(Vec3::ZERO),
        w: Vec3::Z,
        phi: 1.0,
        cos_theta_o: -1.0,
        cos_theta_e: 0.0,
        two_sided: false,
    };
    let prototype = LightPrototype::new(&[LightExtent::Bounded(point); 1 << 12]).expect("valid");
    let placements = vec![Placement::at(0, Vec3::ZERO); 1 << 20];
    let tree = InstancedLightBvh::build(vec![prototype], &placements).expect("a tree");
    assert_eq!(tree.light_count(), 1 << 32, "one more than ids count");
    let refused = InstancedBvhLightSampler::new(tree, &[]).err();
    let most = u32::MAX as usize;
    let many = InstancedBvhLightSamplerError::TooManyLights { most };
    assert_eq!(refused, Some(many), "by name");
    let says = "expected at most 4294967295 lights: ids have 32 bits";
    assert_eq!(many.to_string(), says, "with the limit");
}
