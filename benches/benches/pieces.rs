//! The small pieces of which a light sample is made: directions, tables, warps, importance.

mod settings;

use core::hint::black_box;

use benches::{Queries, queries_of, squares};
use criterion::{Criterion, criterion_group, criterion_main};
use light_testkit::light_sets::SetKind;
use light_testkit::{Rng, SamplerCase};
use lights::bounds::{CompactLightBounds, LightBounds};
use lights::math::distribution::{AliasTable, PiecewiseConstant1D, PiecewiseConstant2D};
use lights::math::{Aabb, OctahedralVector, equal_area, warp};

fn directions(c: &mut Criterion) {
    let mut group = c.benchmark_group("directions");
    let mut codes = Queries::new(|rng| OctahedralVector::from_bits(rng.u32()));
    group.bench_function("octahedral decode", |b| {
        b.iter(|| codes.next_query().decode())
    });
    let mut vectors = Queries::new(Rng::direction);
    group.bench_function("octahedral encode", |b| {
        b.iter(|| OctahedralVector::encode(vectors.next_query()));
    });
    let mut us = squares();
    group.bench_function("equal-area square to sphere", |b| {
        b.iter(|| equal_area::square_to_sphere(us.next_query()));
    });
    group.bench_function("equal-area sphere to square", |b| {
        b.iter(|| equal_area::sphere_to_square(vectors.next_query()));
    });
    group.bench_function("cosine hemisphere", |b| {
        b.iter(|| warp::cosine_hemisphere::sample(us.next_query()));
    });
    group.bench_function("uniform sphere", |b| {
        b.iter(|| warp::uniform_sphere::sample(us.next_query()));
    });
}

fn tables(c: &mut Criterion) {
    const N: usize = 4096;
    const WIDTH: usize = 64;
    let mut rng = Rng::new(73);
    let weights: Vec<f32> = (0..N).map(|_| rng.f32() * rng.f32()).collect();
    let mut group = c.benchmark_group("tables of 4096");
    let mut us = squares();

    let alias = AliasTable::new(&weights).expect("weights");
    let mut fractions = Queries::new(Rng::u64);
    group.bench_function("alias table sample", |b| {
        b.iter(|| alias.sample(fractions.next_query()));
    });
    let line = PiecewiseConstant1D::new(&weights).expect("weights");
    group.bench_function("piecewise constant 1D sample", |b| {
        b.iter(|| line.sample(us.next_query().x));
    });
    let image = PiecewiseConstant2D::new(&weights, WIDTH, N / WIDTH).expect("weights");
    group.bench_function("piecewise constant 2D sample", |b| {
        b.iter(|| image.sample(us.next_query()));
    });
    group.bench_function("piecewise constant 2D pdf", |b| {
        b.iter(|| image.pdf(us.next_query()));
    });
}

fn importance(c: &mut Criterion) {
    let set = SamplerCase::generated(SetKind::Clusters, 1000, 74);
    let bounds: Vec<LightBounds> = set
        .extents()
        .iter()
        .filter_map(|e| e.bounded().copied())
        .collect();
    let all = bounds
        .iter()
        .fold(Aabb::EMPTY, |all, b| all.union(b.bounds));
    let compact: Vec<CompactLightBounds> = bounds
        .iter()
        .map(|b| CompactLightBounds::encode(b, &all))
        .collect();
    let mut queries = queries_of(&set);
    let mut lights = (0..bounds.len()).cycle();
    let mut light = || lights.next().expect("a cycle");
    let mut group = c.benchmark_group("importance");
    group.bench_function("exact bounds", |b| {
        b.iter(|| black_box(&bounds[light()]).importance(&queries.next_query().0));
    });
    group.bench_function("compact bounds", |b| {
        b.iter(|| black_box(&compact[light()]).importance(&all, &queries.next_query().0));
    });
}

criterion_group! {
    name = pieces;
    config = settings::criterion();
    targets = directions, tables, importance
}
criterion_main!(pieces);
