//! Hot paths, each in a function that is never inlined, so that callgrind counts its instructions alone.
//!
//! Without arguments lists `NAME CALLS`; with a name runs that one. `cargo xtask counts` does both.

use core::hint::black_box;

use benches::{Queries, queries_of};
use light_testkit::LightSet;
use lights::bounds::{LightBounds, LightId, LightSampleContext};
use lights::math::OctahedralVector;
use lights::math::distribution::AliasTable;
use lights::samplers::{BvhLightSampler, LightSampler, ReferenceBvhLightSampler};

/// Calls of each path.
const CALLS: u32 = 1000;

/// Lights in the trees.
const LIGHTS: usize = 2000;

const PATHS: [(&str, fn()); 7] = [
    ("alias_sample", alias_sample),
    ("importance", importance),
    ("octahedral_decode", octahedral_decode),
    ("pmf", pmf),
    ("pmf_reference", pmf_reference),
    ("sample", sample),
    ("sample_reference", sample_reference),
];

fn main() {
    let asked = std::env::args().nth(1);
    for (name, path) in PATHS {
        match &asked {
            None => println!("{name} {CALLS}"),
            Some(asked) if asked == name => path(),
            Some(_) => {}
        }
    }
}

fn calls<T: Copy>(mut queries: Queries<T>, mut call: impl FnMut(T)) {
    (0..CALLS).for_each(|_| call(queries.ask()));
}

fn alias_sample() {
    let weights: Vec<f32> = (0..LIGHTS).map(|i| (i * 37 % 101) as f32).collect();
    let table = AliasTable::new(&weights).expect("weights");
    calls(Queries::new(|rng| rng.f64()), |u| {
        count_alias_sample(&table, u)
    });
}

#[inline(never)]
fn count_alias_sample(table: &AliasTable<Vec<lights::math::distribution::AliasBin>>, u: f64) {
    black_box(table.sample(u));
}

fn importance() {
    let set = LightSet::clusters(1, 1);
    let extent = set.extents()[0];
    let bounds = extent.bounded().expect("a triangle");
    calls(queries_of(&set), |(ctx, _)| count_importance(bounds, &ctx));
}

#[inline(never)]
fn count_importance(bounds: &LightBounds, ctx: &LightSampleContext) {
    black_box(bounds.importance(ctx));
}

fn octahedral_decode() {
    let codes = Queries::new(|rng| OctahedralVector::from_bits(rng.u32()));
    calls(codes, count_octahedral_decode);
}

#[inline(never)]
fn count_octahedral_decode(code: OctahedralVector) {
    black_box(code.decode());
}

fn reference() -> (LightSet, ReferenceBvhLightSampler) {
    let set = LightSet::clusters(LIGHTS, 1);
    let sampler = ReferenceBvhLightSampler::new(&set.extents()).expect("valid lights");
    (set, sampler)
}

fn bvh() -> (LightSet, BvhLightSampler) {
    let set = LightSet::clusters(LIGHTS, 1);
    let sampler = BvhLightSampler::new(&set.extents()).expect("valid lights");
    (set, sampler)
}

fn sample() {
    let (set, sampler) = bvh();
    calls(queries_of(&set), |(ctx, u)| count_sample(&sampler, &ctx, u));
}

#[inline(never)]
fn count_sample(sampler: &BvhLightSampler, ctx: &LightSampleContext, u: f64) {
    black_box(sampler.sample(ctx, u));
}

fn sample_reference() {
    let (set, sampler) = reference();
    calls(queries_of(&set), |(ctx, u)| {
        count_sample_reference(&sampler, &ctx, u)
    });
}

#[inline(never)]
fn count_sample_reference(sampler: &ReferenceBvhLightSampler, ctx: &LightSampleContext, u: f64) {
    black_box(sampler.sample(ctx, u));
}

fn pmf() {
    let (set, sampler) = bvh();
    calls(chosen(&set, &sampler), |(ctx, light)| {
        count_pmf(&sampler, &ctx, light)
    });
}

#[inline(never)]
fn count_pmf(sampler: &BvhLightSampler, ctx: &LightSampleContext, light: LightId) {
    black_box(sampler.pmf(ctx, light));
}

fn pmf_reference() {
    let (set, sampler) = reference();
    calls(chosen(&set, &sampler), |(ctx, light)| {
        count_pmf_reference(&sampler, &ctx, light)
    });
}

#[inline(never)]
fn count_pmf_reference(
    sampler: &ReferenceBvhLightSampler,
    ctx: &LightSampleContext,
    light: LightId,
) {
    black_box(sampler.pmf(ctx, light));
}

/// Lights that the sampler itself would choose.
fn chosen(set: &LightSet, sampler: &impl LightSampler) -> Queries<(LightSampleContext, LightId)> {
    let mut asked = queries_of(set);
    Queries::new(|_| {
        loop {
            let (ctx, u) = asked.ask();
            if let Some(chosen) = sampler.sample(&ctx, u) {
                break (ctx, chosen.light);
            }
        }
    })
}
