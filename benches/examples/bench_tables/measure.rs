//! One measurement of a table: the machinery of `lights bench` on a generated set.

use light_render::SamplerKind;
use light_render::bench::{BenchOptions, BenchRow, Measurement, bench};
use light_sets::{BenchSet, SetKind};

/// Seed of the sets of all tables.
const SEED: u64 = 1;

/// The set of `n` lights of a kind.
pub(super) fn set(kind: SetKind, n: u32) -> BenchSet {
    BenchSet::generate(kind, n as usize, SEED)
}

/// The variance of these samplers over so many points, otherwise as `lights bench` measures.
pub(super) fn options(samplers: &[SamplerKind], points: usize) -> BenchOptions {
    BenchOptions {
        measurement: Measurement {
            samplers: samplers.to_vec(),
            var_points: Some(points),
            ..Measurement::default()
        },
        ..BenchOptions::default()
    }
}

/// One row a sampler, all of which lose no light and keep the laws.
///
/// # Errors
/// A light that a sampler refuses, or a broken law.
pub(super) fn measure(
    kind: SetKind,
    set: &BenchSet,
    options: &BenchOptions,
) -> Result<Vec<BenchRow>, String> {
    let rows = bench(kind.name(), set, options).map_err(|e| format!("{}: {e}", kind.name()))?;
    match rows.iter().find(|row| !is_lawful(row)) {
        Some(broken) => Err(format!("a law is broken\n{}\n{broken}", BenchRow::header())),
        None => Ok(rows),
    }
}

fn is_lawful(row: &BenchRow) -> bool {
    row.variance.lost_energy == 0.0 && row.laws.hold()
}

/// Two to four digits, or a power of ten.
pub(super) fn figure(x: f64) -> String {
    match x {
        _ if x >= 1e5 => format!("{x:.0e}"),
        _ if x >= 10.0 => format!("{x:.0}"),
        _ if x >= 1.0 => format!("{x:.1}"),
        _ => format!("{x:.2}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_broken_law_is_no_row() {
        let set = set(SetKind::Uniform, 10);
        let options = options(&[SamplerKind::Bvh], 2);
        let rows = measure(SetKind::Uniform, &set, &options).expect("laws are kept");
        let broken = |change: fn(&mut BenchRow)| {
            let mut row = rows[0].clone();
            change(&mut row);
            !is_lawful(&row)
        };
        assert!(!broken(|_| {}), "all is kept");
        assert!(broken(|row| row.variance.lost_energy = 1e-9), "lost energy");
        assert!(broken(|row| row.laws.pmf_sum_max_error = 1e-3), "above 1");
    }
}
