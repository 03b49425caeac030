//! Families of places, and four plain sets: both hierarchies, on seeds that nothing was tuned on.

use light_render::SamplerKind;
use light_render::bench::Variance;
use light_sets::{BenchSet, Family, SetKind};

use super::by_cut::by_cut;
use super::measure::{figure, measure, options};

/// Lights, the points that the variance is taken over, and the seeds; constants were chosen on
/// seeds below 10.
const SIZES: [(usize, usize, &[u64]); 3] = [
    (100, 1024, &[11, 12]),
    (10_000, 128, &[11, 12]),
    (1_000_000, 32, &[11]),
];

/// Samples of one call of the column `k = 16`.
const K: u32 = 16;

const HEADER: &str = "\
| family | lights | reference: V mean | 99 % | by light | default: V mean | median | 99 % | \
by light | k = 16: V mean | by a cut: V mean | nodes |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
";

/// The figures of a line.
type Figures = [f64; 10];

/// A line a family and size: means over the seeds.
pub(super) fn table() -> Result<String, String> {
    let mut table = HEADER.to_owned();
    for kind in kinds() {
        for (lights, points, seeds) in SIZES {
            let mut sums = Figures::default();
            for &seed in seeds {
                let found = figures(kind, lights, seed, points)?;
                for (sum, figure) in sums.iter_mut().zip(found) {
                    *sum += figure / seeds.len() as f64;
                }
            }
            table += &line(kind, lights, sums);
        }
    }
    Ok(table)
}

fn kinds() -> impl Iterator<Item = SetKind> {
    let plain = [
        SetKind::Uniform,
        SetKind::Clusters,
        SetKind::Spots,
        SetKind::Mixed,
    ];
    let families = Family::ALL.into_iter().map(SetKind::Place);
    plain.into_iter().chain(families)
}

/// Both hierarchies on one set.
fn figures(kind: SetKind, lights: usize, seed: u64, points: usize) -> Result<Figures, String> {
    let mut set = BenchSet::generate(kind, lights, seed);
    set.points.truncate(points);
    let variances = |samplers: &[SamplerKind], k: u32| -> Result<Vec<Variance>, String> {
        let mut options = options(samplers, points);
        options.measurement.threads = 2;
        options.measurement.is_timed = false;
        options.measurement.k = k;
        let rows = measure(kind, &set, &options)?;
        Ok(rows.iter().map(|row| row.variance).collect())
    };
    let single = variances(&[SamplerKind::BvhReference, SamplerKind::Bvh], 1)?;
    let of_16 = variances(&[SamplerKind::Bvh], K)?;
    let [reference, default] = [single[0], single[1]];
    let by_cut = by_cut(&set)?;
    Ok([
        reference.mean,
        reference.p99,
        reference.flux_weighted,
        default.mean,
        default.median,
        default.p99,
        default.flux_weighted,
        of_16[0].mean,
        by_cut.variance,
        by_cut.nodes,
    ])
}

/// The line, printed as well: tables of many lights take minutes.
fn line(kind: SetKind, lights: usize, figures: Figures) -> String {
    let figures = figures.map(figure).join(" | ");
    let line = format!("| {} | {lights} | {figures} |", kind.name());
    println!("{line}");
    line + "\n"
}
