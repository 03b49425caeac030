//! Light samplers: a sample, a pmf of a light that was sampled, and the build, each beside the
//! reference.

mod settings;

use benches::{Queries, queries_of};
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, criterion_group, criterion_main};
use light_testkit::SamplerCase;
use light_testkit::light_sets::SetKind;
use lights::bounds::LightExtent;
use lights::bvh::LightBvhOptions;
use lights::samplers::{
    BvhLightSampler, LightSampler, PowerLightSampler, ReferenceBvhLightSampler,
};

/// The sets on which queries are timed. A million lights take `lights bench`, which knows of
/// caches.
fn sets() -> Vec<SamplerCase> {
    [100, 10_000]
        .into_iter()
        .flat_map(|n| {
            [
                SamplerCase::generated(SetKind::Uniform, n, 81),
                SamplerCase::generated(SetKind::Clusters, n, 82),
                SamplerCase::generated(SetKind::Spots, n, 83),
                SamplerCase::mixed(n, 84),
            ]
        })
        .collect()
}

fn name(set: &SamplerCase) -> String {
    format!("{} {}", set.name, set.emitters.len())
}

fn sample_and_pmf(c: &mut Criterion) {
    let sets = sets();
    let mut group = c.benchmark_group("sample");
    for set in &sets {
        each_sampler(set, |sampler, by| {
            bench_sample(&mut group, set, sampler, by)
        });
    }
    group.finish();
    let mut group = c.benchmark_group("pmf");
    for set in &sets {
        each_sampler(set, |sampler, by| bench_pmf(&mut group, set, sampler, by));
    }
}

fn each_sampler(set: &SamplerCase, mut bench: impl FnMut(&dyn LightSampler, &str)) {
    let extents = set.extents();
    bench(
        &ReferenceBvhLightSampler::new(&extents).expect("valid lights"),
        "reference",
    );
    bench(
        &BvhLightSampler::new(&extents).expect("valid lights"),
        "bvh",
    );
    bench(
        &PowerLightSampler::new(&set.powers()).expect("valid powers"),
        "power",
    );
}

fn bench_sample(
    group: &mut BenchmarkGroup<'_, WallTime>,
    set: &SamplerCase,
    sampler: &dyn LightSampler,
    by: &str,
) {
    let mut queries = queries_of(set);
    group.bench_function(BenchmarkId::new(by, name(set)), |b| {
        b.iter(|| {
            let (ctx, u) = queries.next_query();
            sampler.sample(&ctx, u)
        });
    });
}

fn bench_pmf(
    group: &mut BenchmarkGroup<'_, WallTime>,
    set: &SamplerCase,
    sampler: &dyn LightSampler,
    by: &str,
) {
    // What multiple importance sampling asks for: lights that the sampler itself would choose
    // there.
    let mut asked = queries_of(set);
    let mut queries = Queries::new(|_| {
        loop {
            let (ctx, u) = asked.next_query();
            if let Some(chosen) = sampler.sample(&ctx, u) {
                break (ctx, chosen.light);
            }
        }
    });
    group.bench_function(BenchmarkId::new(by, name(set)), |b| {
        b.iter(|| {
            let (ctx, light) = queries.next_query();
            sampler.pmf(&ctx, light)
        });
    });
}

fn build(c: &mut Criterion) {
    let mut group = c.benchmark_group("build");
    for set in sets() {
        let extents: Vec<LightExtent> = set.extents();
        group.bench_function(BenchmarkId::new("reference", name(&set)), |b| {
            b.iter(|| ReferenceBvhLightSampler::new(&extents));
        });
        group.bench_function(BenchmarkId::new("bvh", name(&set)), |b| {
            b.iter(|| BvhLightSampler::new(&extents));
        });
        group.bench_function(BenchmarkId::new("bvh-morton", name(&set)), |b| {
            b.iter(|| BvhLightSampler::with_options(&extents, &LightBvhOptions::FAST));
        });
        let mut tree = BvhLightSampler::new(&extents).expect("valid lights");
        group.bench_function(BenchmarkId::new("refit", name(&set)), |b| {
            b.iter(|| tree.refit(&extents));
        });
    }
}

criterion_group! {
    name = samplers;
    config = settings::criterion();
    targets = sample_and_pmf, build
}
criterion_main!(samplers);
