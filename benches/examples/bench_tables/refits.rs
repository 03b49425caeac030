//! Refits of lights that move, against builds for where they are.

use light_render::SamplerKind;
use light_render::bench;
use light_sets::SetKind;

use super::measure::{figure, options, set};

const SETS: [SetKind; 2] = [SetKind::Uniform, SetKind::Clusters];

const LIGHTS: u32 = 10_000;

/// How often the way of the lights is doubled.
const STEPS: u32 = 8;

const HEADER: &str = "\
| set | moved by | degradation | refit: V mean | V 99 % | rebuilt: V mean | V 99 % |
| --- | --- | --- | --- | --- | --- | --- |
";

/// A line a set and step.
pub(super) fn table() -> Result<String, String> {
    let mut table = HEADER.to_owned();
    for kind in SETS {
        let name = kind.name();
        let options = options(&[SamplerKind::Bvh], 512);
        let rows = bench::refits(name, &set(kind, LIGHTS), &options, STEPS);
        for row in rows.map_err(|e| format!("{name}: {e}"))? {
            if row.refitted.lost_energy > 0.0 {
                return Err(format!("energy is lost\n{row}"));
            }
            let mut line = format!("| {name} | {} | {:.2} |", row.moved, row.degradation);
            for variance in [row.refitted, row.rebuilt] {
                line += &format!(" {} | {} |", figure(variance.mean), figure(variance.p99));
            }
            println!("{line}");
            table += &line;
            table.push('\n');
        }
    }
    Ok(table)
}
