//! Sets that break hierarchies: how deep they grow, and that no light is lost.

use light_render::SamplerKind;
use light_sets::SetKind;

use super::measure::{figure, measure, options, set};

const SETS: [SetKind; 7] = [
    SetKind::OnePoint,
    SetKind::Line,
    SetKind::Nested,
    SetKind::LargeWorld,
    SetKind::Magnitudes,
    SetKind::TwinPlaces,
    SetKind::FarLamp,
];

const LIGHTS: u32 = 1_000_000;

/// The hierarchies, and their names in the table.
const SAMPLERS: [SamplerKind; 3] = [
    SamplerKind::BvhReference,
    SamplerKind::Bvh,
    SamplerKind::BvhMorton,
];
const NAMES: [&str; 3] = ["reference", "default", "fast build"];

const HEADER: &str = "\
| set | sampler | depth | bytes a light | build ms | V median | energy lost | pmf mismatches | \
NaN | sum above 1 |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
";

/// A line a set and hierarchy, a million lights each.
pub(super) fn table() -> Result<String, String> {
    let mut table = HEADER.to_owned();
    for kind in SETS {
        let rows = measure(kind, &set(kind, LIGHTS), &options(&SAMPLERS, 16))?;
        for (row, name) in rows.iter().zip(NAMES) {
            let excess = match row.laws.pmf_sum_max_error {
                0.0 => "0".to_owned(),
                rounding => format!("{rounding:.0e}"),
            };
            let line = format!(
                "| {} | {name} | {} | {:.0} | {} | {} | {} | {} | {} | {excess} |",
                kind.name(),
                row.depth,
                row.bytes as f64 / row.n_lights as f64,
                figure(row.build_ms),
                figure(row.variance.median),
                row.variance.lost_energy,
                row.laws.pmf_mismatch,
                row.laws.pmf_nan,
            );
            println!("{line}");
            table += &line;
            table.push('\n');
        }
    }
    Ok(table)
}
