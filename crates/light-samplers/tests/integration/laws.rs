//! Every sampler of this crate obeys the laws of light samplers.

use light_bvh::LightBvhOptions;
use light_samplers::light_bounds::glam::Vec3;
use light_samplers::light_bounds::{
    Gloss, LightExtent, LightGroups, LightId, LightSampleContext, SampledLight,
};
use light_samplers::{
    BvhLightSampler, ExhaustiveLightSampler, GroupedLightSampler, LightChoices, LightSampler,
    PowerLightSampler, ReferenceBvhLightSampler, UniformLightSampler,
};
use light_testkit::{SamplerCase, stored};

use crate::support::asked::Asked;

light_testkit::sampler_laws! {
    /// Every light alike.
    mod uniform {
        |set| UniformLightSampler::new(set.count())
    }

    /// In proportion to power.
    mod power {
        |set| PowerLightSampler::new(&set.powers()).expect("valid powers")
    }

    /// In proportion to importance.
    mod exhaustive {
        |set| ExhaustiveLightSampler::new(&set.extents()).expect("valid bounds")
    }

    /// The published hierarchy.
    mod reference_bvh {
        |set| ReferenceBvhLightSampler::new(&set.extents()).expect("valid bounds")
    }

    /// The default hierarchy.
    mod bvh {
        |set| BvhLightSampler::new(&set.extents()).expect("valid bounds")
    }

    /// The default hierarchy, built along a space-filling curve.
    mod bvh_morton {
        |set| BvhLightSampler::with_options(&set.extents(), &LightBvhOptions::FAST).expect("valid bounds")
    }

    /// The default hierarchy, built with lights that are off.
    mod bvh_dynamic {
        |set| BvhLightSampler::with_options(&set.extents(), &LightBvhOptions::DYNAMIC)
            .expect("valid bounds")
    }

    /// The default hierarchy, refitted after lights have swapped positions.
    mod bvh_refitted {
        |set| refitted(set)
    }

    /// The default hierarchy in bytes, refitted before.
    mod bvh_stored {
        |set| stored(&refitted(set))
    }

    /// The default hierarchy of two groups, of which contexts ask for one.
    mod bvh_grouped {
        |set| {
            let (extents, groups) = twice(set);
            let mut of_two = BvhLightSampler::new(&extents).expect("valid bounds");
            of_two.set_groups(groups).expect("as many groups");
            let plain = BvhLightSampler::new(&set.extents()).expect("valid bounds");
            OfGroup { of_two, plain }
        }
    }

    /// The same in bytes.
    mod bvh_grouped_stored {
        |set| {
            let (extents, groups) = twice(set);
            let mut of_two = BvhLightSampler::new(&extents).expect("valid bounds");
            of_two.set_groups(groups).expect("as many groups");
            let plain = BvhLightSampler::new(&set.extents()).expect("valid bounds");
            OfGroup { of_two: stored(&of_two), plain: stored(&plain) }
        }
    }

    /// The published hierarchy, restricted to one of two groups.
    mod reference_bvh_grouped {
        |set| {
            let (extents, groups) = twice(set);
            let [of_two, plain] = [extents, set.extents()]
                .map(|extents| ReferenceBvhLightSampler::new(&extents).expect("valid bounds"));
            OfGroup { of_two: GroupedLightSampler::new(of_two, groups), plain }
        }
    }

    /// The default hierarchy at surfaces that transmit light.
    mod bvh_two_sided {
        |set| Asked(
            BvhLightSampler::new(&set.extents()).expect("valid bounds"),
            |ctx| match (ctx.n(), ctx.ns()) {
                (Some(n), Some(ns)) => LightSampleContext::two_sided(ctx.p, n, ns),
                _ => *ctx,
            },
        )
    }

    /// The default hierarchy at glossy surfaces.
    mod bvh_glossy {
        |set| Asked(
            BvhLightSampler::new(&set.extents()).expect("valid bounds"),
            |ctx| {
                let n = ctx.n().unwrap_or(Vec3::Z);
                let wo = (n + 0.9 * n.any_orthonormal_vector()).normalize();
                ctx.with_gloss(Gloss { wo, alpha: 0.1, diffuse: 0.0 })
            },
        )
    }

    /// The default hierarchy for ray segments.
    mod bvh_segment {
        |set| Asked(
            BvhLightSampler::new(&set.extents()).expect("valid bounds"),
            |ctx| LightSampleContext::segment(ctx.p, ctx.p * 0.5),
        )
    }

    /// The default hierarchy as it chooses several lights at once.
    mod bvh_cut {
        |set| OfCut(BvhLightSampler::new(&set.extents()).expect("valid bounds"))
    }
}

/// A tree that has followed the lights of the set to where they are.
fn refitted(set: &SamplerCase) -> BvhLightSampler {
    let before = set.exchanged_extents();
    let sampler = BvhLightSampler::with_options(&before, &LightBvhOptions::DYNAMIC);
    let mut sampler = sampler.expect("valid bounds");
    sampler.refit(&set.extents()).expect("as many lights");
    sampler
}

const OURS: LightGroups = LightGroups::of(3);

/// The lights of a set in one group, and the same in another.
fn twice(set: &SamplerCase) -> (Vec<LightExtent>, Vec<LightGroups>) {
    let extents = set.extents();
    let groups = [OURS, LightGroups::of(4)].map(|group| vec![group; extents.len()]);
    ([&*extents, &*extents].concat(), groups.concat())
}

/// The choice of [`OURS`] among lights of two groups; without a receiver that of the set alone.
struct OfGroup<S, P> {
    of_two: S,
    plain: P,
}

impl<S: LightSampler, P: LightSampler> LightSampler for OfGroup<S, P> {
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        self.of_two.sample(&ctx.with_groups(OURS), u)
    }

    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.of_two.pmf(&ctx.with_groups(OURS), light)
    }

    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        self.of_two.at(&ctx.with_groups(OURS), count)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.plain.sample_emitter(u)
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.plain.pmf_emitter(light)
    }
}

/// Single choices by the rule of several.
struct OfCut(BvhLightSampler);

impl LightSampler for OfCut {
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        self.0.at(ctx, 2).sample(u)
    }

    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.0.at(ctx, 2).pmf(light)
    }

    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        LightChoices::one_by_one(self, ctx, count)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.0.sample_emitter(u)
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.0.pmf_emitter(light)
    }
}
