//! Time, variance, memory and builds of the hierarchies side by side.

use light_render::SamplerKind;
use light_render::bench::BenchRow;
use light_sets::{BenchSet, SetKind};

use super::measure::{figure, measure, options, set};

const SETS: [SetKind; 4] = [
    SetKind::Uniform,
    SetKind::Clusters,
    SetKind::Spots,
    SetKind::Mixed,
];

/// Lights of a set, how the table writes that, and how many points its variance is taken over.
const SIZES: [(u32, &str, usize); 3] = [
    (100, "100", 4096),
    (10_000, "10 k", 4096),
    (1_000_000, "1 M", 16),
];

/// The lines of one set: each sampler, samples of one call, and its name in the table. All others
/// are compared with the first.
const LINES: [(SamplerKind, u32, &str); 4] = [
    (SamplerKind::BvhReference, 1, "reference"),
    (SamplerKind::Bvh, 1, "default"),
    (SamplerKind::BvhMorton, 1, "fast build"),
    (SamplerKind::Bvh, 16, "default, k = 16"),
];

const HEADER: &str = "\
| set, lights | sampler | ns sample | ns pmf | V mean | V median | V 99 % | bytes a light | \
build ms |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |
";

/// The table, of all sets or of those of the given `sizes`; prints each line as it comes.
pub(super) fn table(sizes: &[u32]) -> Result<String, String> {
    let mut table = HEADER.to_owned();
    for (n, size, points) in SIZES {
        if !sizes.is_empty() && !sizes.contains(&n) {
            continue;
        }
        for kind in SETS {
            let rows = rows(kind, &set(kind, n), points)?;
            let lines = lines(&format!("{}, {size}", kind.name()), &rows);
            print!("{lines}");
            table += &lines;
        }
    }
    Ok(table)
}

/// The rows of a set, in the order of [`LINES`]; all trees are built on two threads.
fn rows(kind: SetKind, set: &BenchSet, points: usize) -> Result<Vec<BenchRow>, String> {
    let mut rows = Vec::new();
    // What is measured with the same number of samples is measured in one run, in turns.
    for same in LINES.chunk_by(|a, b| a.1 == b.1) {
        let samplers: Vec<SamplerKind> = same.iter().map(|line| line.0).collect();
        let mut options = options(&samplers, points);
        options.measurement.k = same[0].1;
        options.measurement.threads = 2;
        rows.extend(measure(kind, set, &options)?);
    }
    Ok(rows)
}

/// The lines of one set. Times are followed by how many times faster than the first line's they
/// are.
fn lines(set: &str, rows: &[BenchRow]) -> String {
    let mut lines = String::new();
    for (i, (row, (_, k, name))) in rows.iter().zip(LINES).enumerate() {
        let time = |of: fn(&BenchRow) -> f64| {
            let ratio = of(&rows[0]) / of(row);
            match i {
                0 => figure(of(row)),
                _ => format!("{} ({ratio:.1} x)", figure(of(row))),
            }
        };
        let own = |text: String| if k == 1 { text } else { String::new() };
        let bytes = row.bytes as f64 / row.n_lights as f64;
        lines += &format!(
            "| {} | {name} | {} | {} | {} | {} | {} | {} | {} |\n",
            if i == 0 { set } else { "" },
            time(|row| row.time.sample),
            own(time(|row| row.time.pmf)),
            figure(row.variance.mean),
            figure(row.variance.median),
            figure(row.variance.p99),
            own(format!("{bytes:.0}")),
            own(time(|row| row.build_ms)),
        );
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_render::bench::{Laws, QueryTime, Variance};

    fn row(time: f64) -> BenchRow {
        BenchRow {
            set: "spots".to_owned(),
            n_lights: 100,
            sampler: SamplerKind::Bvh,
            k: 1,
            points: 256,
            build_ms: time,
            refit_ms: None,
            bytes: 3100,
            depth: 1,
            time: QueryTime {
                sample: time,
                pmf: time,
                pmf_random_light: time,
            },
            variance: Variance {
                mean: 0.75,
                median: 0.5,
                p99: 12.3,
                ..Variance::default()
            },
            laws: Laws::default(),
        }
    }

    #[test]
    fn ratios_are_to_the_first_line() {
        let lines = lines("spots, 100", &[800.0, 200.0, 160.0, 100.0].map(row));
        let lines: Vec<&str> = lines.lines().collect();
        assert!(
            lines[0].starts_with("| spots, 100 | reference | 800 | 800 |"),
            "{}",
            lines[0]
        );
        assert!(lines[1].contains("| 200 (4.0 x) |"), "{}", lines[1]);
        assert!(
            lines[1].contains("| 0.75 | 0.50 | 12 | 31 |"),
            "{}",
            lines[1]
        );
        assert!(lines[2].ends_with("| 160 (5.0 x) |"), "{}", lines[2]);
        // One call for many lights has no build and no bytes of its own.
        assert!(lines[3].contains("| 100 (8.0 x) |  |"), "{}", lines[3]);
    }
}
