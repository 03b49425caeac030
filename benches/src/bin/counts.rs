//! Hot paths, each in a function that is never inlined, so that callgrind counts its instructions
//! alone.
//!
//! Without arguments lists `NAME CALLS`; with a name runs that one. `cargo xtask counts` does both.

use core::hint::black_box;

use benches::{Queries, queries_of};
use light_testkit::light_sets::SetKind;
use light_testkit::{Rng, SamplerCase};
use lights::bounds::{LightBounds, LightExtent, LightId, LightSampleContext};
use lights::bvh::reference::ReferenceLightBvh;
use lights::bvh::visibility::{CellKey, CoarseCell, FillOptions, LightBvhInCell};
use lights::bvh::{LightBvh, LightBvhOptions};
use lights::glam::Vec3;
use lights::math::OctahedralVector;
use lights::math::distribution::AliasTable;
use lights::samplers::{BvhLightSampler, LightSampler, ReferenceBvhLightSampler};

/// Calls of a path that takes microseconds.
const CALLS: u32 = 1000;

/// Lights in the trees that are asked.
const LIGHTS: usize = 2000;

/// Lights of the trees that are built.
const LIGHTS_TO_BUILD: usize = 10_000;

/// Names, calls, and what makes them.
const PATHS: [(&str, u32, fn()); 13] = [
    ("alias_sample", CALLS, alias_sample),
    ("build", 1, build),
    ("build_morton", 1, build_morton),
    ("build_reference", 1, build_reference),
    ("importance", CALLS, importance),
    ("octahedral_decode", CALLS, octahedral_decode),
    ("pmf", CALLS, pmf),
    ("pmf_in_cell", CALLS, pmf_in_cell),
    ("pmf_reference", CALLS, pmf_reference),
    ("refit", 1, refit),
    ("sample", CALLS, sample),
    ("sample_in_cell", CALLS, sample_in_cell),
    ("sample_reference", CALLS, sample_reference),
];

fn main() {
    let asked = std::env::args().nth(1);
    for (name, calls, path) in PATHS {
        match &asked {
            None => println!("{name} {calls}"),
            Some(asked) if asked == name => path(),
            Some(_) => {}
        }
    }
}

fn calls<T: Copy>(mut queries: Queries<T>, mut call: impl FnMut(T)) {
    (0..CALLS).for_each(|_| call(queries.next_query()));
}

fn alias_sample() {
    let weights: Vec<f32> = (0..LIGHTS).map(|i| (i * 37 % 101) as f32).collect();
    let table = AliasTable::new(&weights).expect("weights");
    calls(Queries::new(Rng::u64), |u| count_alias_sample(&table, u));
}

#[inline(never)]
fn count_alias_sample(table: &AliasTable<Vec<lights::math::distribution::AliasBin>>, u: u64) {
    black_box(table.sample(u));
}

fn importance() {
    let set = SamplerCase::generated(SetKind::Clusters, 1, 1);
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

fn reference() -> (SamplerCase, ReferenceBvhLightSampler) {
    let set = SamplerCase::generated(SetKind::Clusters, LIGHTS, 1);
    let sampler = ReferenceBvhLightSampler::new(&set.extents()).expect("valid lights");
    (set, sampler)
}

fn bvh() -> (SamplerCase, BvhLightSampler) {
    let set = SamplerCase::generated(SetKind::Clusters, LIGHTS, 1);
    let sampler = BvhLightSampler::new(&set.extents()).expect("valid lights");
    (set, sampler)
}

/// Lights for a tree, and `work` on them, on one thread: callgrind counts by thread.
fn on_one_thread(work: impl FnOnce(&[LightExtent]) + Send) {
    let extents = SamplerCase::generated(SetKind::Clusters, LIGHTS_TO_BUILD, 1).extents();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("a thread").install(|| work(&extents));
}

fn build() {
    on_one_thread(count_build);
}

#[inline(never)]
fn count_build(extents: &[LightExtent]) {
    black_box(LightBvh::build(extents)).expect("valid lights");
}

fn build_morton() {
    on_one_thread(count_build_morton);
}

#[inline(never)]
fn count_build_morton(extents: &[LightExtent]) {
    black_box(LightBvh::build_with(extents, &LightBvhOptions::FAST)).expect("valid lights");
}

fn build_reference() {
    on_one_thread(count_build_reference);
}

#[inline(never)]
fn count_build_reference(extents: &[LightExtent]) {
    black_box(ReferenceLightBvh::build(extents)).expect("valid lights");
}

fn refit() {
    on_one_thread(|extents| {
        let mut tree = LightBvh::build(extents).expect("valid lights");
        count_refit(&mut tree, extents);
    });
}

#[inline(never)]
fn count_refit(tree: &mut LightBvh, extents: &[LightExtent]) {
    black_box(tree.refit(extents)).expect("as many lights");
}

fn sample() {
    let (set, sampler) = bvh();
    calls(queries_of(&set), |(ctx, u)| count_sample(&sampler, &ctx, u));
}

#[inline(never)]
fn count_sample(sampler: &BvhLightSampler, ctx: &LightSampleContext, u: u64) {
    black_box(sampler.sample(ctx, u));
}

fn sample_reference() {
    let (set, sampler) = reference();
    calls(queries_of(&set), |(ctx, u)| {
        count_sample_reference(&sampler, &ctx, u)
    });
}

#[inline(never)]
fn count_sample_reference(sampler: &ReferenceBvhLightSampler, ctx: &LightSampleContext, u: u64) {
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

/// A cell that sees every second light: it copies as many nodes as a cell may.
fn cell(tree: &LightBvh) -> CoarseCell {
    let places = [LightSampleContext::medium(Vec3::ZERO)];
    let key = CellKey::fine(&places[0], 1.0);
    let options = FillOptions::default();
    CoarseCell::fill(tree.view(), key, &places, &options, |_, light, _| {
        Some(light.0 % 2 == 0)
    })
}

fn sample_in_cell() {
    let (set, sampler) = bvh();
    let cell = cell(sampler.tree());
    let tree = sampler.tree().view().in_cell(cell.factors());
    calls(queries_of(&set), |(ctx, u)| {
        count_sample_in_cell(&tree, &ctx, u)
    });
}

#[inline(never)]
fn count_sample_in_cell(tree: &LightBvhInCell<'_>, ctx: &LightSampleContext, u: u64) {
    black_box(tree.sample(ctx, u));
}

fn pmf_in_cell() {
    let (set, sampler) = bvh();
    let cell = cell(sampler.tree());
    let tree = sampler.tree().view().in_cell(cell.factors());
    calls(chosen(&set, &sampler), |(ctx, light)| {
        count_pmf_in_cell(&tree, &ctx, light)
    });
}

#[inline(never)]
fn count_pmf_in_cell(tree: &LightBvhInCell<'_>, ctx: &LightSampleContext, light: LightId) {
    black_box(tree.pmf(ctx, light));
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
fn chosen(
    set: &SamplerCase,
    sampler: &impl LightSampler,
) -> Queries<(LightSampleContext, LightId)> {
    let mut asked = queries_of(set);
    Queries::new(|_| {
        loop {
            let (ctx, u) = asked.next_query();
            if let Some(chosen) = sampler.sample(&ctx, u) {
                break (ctx, chosen.light);
            }
        }
    })
}
