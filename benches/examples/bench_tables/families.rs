//! Families of places: both hierarchies, at two sizes, on seeds that nothing was tuned on.

use light_render::SamplerKind;
use light_sets::{BenchSet, Family, SetKind};

use super::measure::{figure, measure, options};

/// Seeds of the table. Constants were chosen on seeds below 10.
const SEEDS: [u64; 2] = [11, 12];

/// Lights, and the points that the variance is taken over.
const SIZES: [(usize, usize); 2] = [(100, 1024), (10_000, 128)];

const HEADER: &str = "\
| family | lights | reference: V mean | 99 % | by light | default: V mean | median | 99 % | by light |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |
";

/// A line a family and size: means over the seeds.
pub(super) fn table() -> Result<String, String> {
    let mut table = HEADER.to_owned();
    for family in Family::ALL {
        for (lights, points) in SIZES {
            let mut options = options(&[SamplerKind::BvhReference, SamplerKind::Bvh], points);
            options.measurement.threads = 2;
            let mut sums = [0.0; 7];
            for seed in SEEDS {
                let kind = SetKind::Place(family);
                let set = BenchSet::generate(kind, lights, seed);
                let rows = measure(kind, &set, &options)?;
                let [reference, default] = [0, 1].map(|i| rows[i].variance);
                let found = [
                    reference.mean,
                    reference.p99,
                    reference.flux_weighted,
                    default.mean,
                    default.median,
                    default.p99,
                    default.flux_weighted,
                ];
                for (sum, figure) in sums.iter_mut().zip(found) {
                    *sum += figure / SEEDS.len() as f64;
                }
            }
            let figures = sums.map(figure).join(" | ");
            let line = format!("| {} | {lights} | {figures} |", family.name());
            println!("{line}");
            table += &line;
            table.push('\n');
        }
    }
    Ok(table)
}
