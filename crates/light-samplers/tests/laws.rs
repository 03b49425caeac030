//! Every sampler of this crate obeys the laws of light samplers.

use light_bvh::LightBvhOptions;
use light_samplers::light_bounds::glam::Vec3;
use light_samplers::light_bounds::{Gloss, LightExtent, LightId, LightSampleContext, SampledLight};
use light_samplers::{
    BvhLightSampler, ExhaustiveLightSampler, LightChoices, LightSampler, PowerLightSampler,
    ReferenceBvhLightSampler, UniformLightSampler,
};
use light_testkit::SamplerCase;

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
        |set| BvhLightSampler::with(&set.extents(), &LightBvhOptions::FAST).expect("valid bounds")
    }

    /// The default hierarchy, built with lights that are off.
    mod bvh_dynamic {
        |set| BvhLightSampler::with(&set.extents(), &LightBvhOptions::DYNAMIC)
            .expect("valid bounds")
    }

    /// The default hierarchy, refitted after lights have swapped positions.
    mod bvh_refitted {
        |set| {
            let mut sampler = BvhLightSampler::with(&exchanged(set), &LightBvhOptions::DYNAMIC)
                .expect("valid bounds");
            sampler.refit(&set.extents()).expect("as many lights");
            sampler
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

/// The lights of a set, those that are somewhere in reverse order.
fn exchanged(set: &SamplerCase) -> Vec<LightExtent> {
    let extents = set.extents();
    let mut bounded = extents.iter().rev().filter(|e| e.bounded().is_some());
    let other = |e: &LightExtent| match e {
        LightExtent::Bounded(_) | LightExtent::Lobe(..) => *bounded.next().expect("as many"),
        LightExtent::Infinite(_) => *e,
    };
    extents.iter().map(other).collect()
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

/// A sampler that changes every context before it uses it.
struct Asked<S>(S, fn(&LightSampleContext) -> LightSampleContext);

impl<S: LightSampler> LightSampler for Asked<S> {
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        self.0.sample(&self.1(ctx), u)
    }

    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.0.pmf(&self.1(ctx), light)
    }

    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        self.0.at(&self.1(ctx), count)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.0.sample_emitter(u)
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.0.pmf_emitter(light)
    }
}
