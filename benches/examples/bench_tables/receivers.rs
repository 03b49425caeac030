//! Receivers and occluders: variance against the light of whole areas.

use light_render::SamplerKind;
use light_render::bench::{BenchOptions, BenchReceiverKind, GroundTruth};
use light_sets::SetKind;

use super::measure::{figure, measure, options, set};

const SETS: [SetKind; 4] = [
    SetKind::Uniform,
    SetKind::Clusters,
    SetKind::Spots,
    SetKind::Mixed,
];

const LIGHTS: u32 = 10_000;

/// The receiver, the number of occluding spheres, and their name in the table.
const RECEIVERS: [(&str, BenchReceiverKind, usize); 5] = [
    ("diffuse", BenchReceiverKind::Diffuse, 0),
    ("two-sided", BenchReceiverKind::TwoSided, 0),
    ("medium", BenchReceiverKind::Medium, 0),
    ("glossy, roughness 0.2", BenchReceiverKind::Glossy(0.2), 0),
    ("diffuse behind 64 spheres", BenchReceiverKind::Diffuse, 64),
];

const HEADER: &str = "\
| set | receiver | reference: V mean | V median | V 99 % | default: V mean | V median | V 99 % |
| --- | --- | --- | --- | --- | --- | --- | --- |
";

/// A line a set and receiver.
pub(super) fn table() -> Result<String, String> {
    let mut table = HEADER.to_owned();
    for kind in SETS {
        let set = set(kind, LIGHTS);
        for (name, receiver, occluders) in RECEIVERS {
            let options = BenchOptions {
                ground_truth: GroundTruth::Area,
                receiver,
                occluders,
                ..options(&[SamplerKind::BvhReference, SamplerKind::Bvh], 512)
            };
            let mut line = format!("| {} | {name} |", kind.name());
            for row in measure(kind, &set, &options)? {
                let variance = row.variance;
                for quantity in [variance.mean, variance.median, variance.p99] {
                    line += &format!(" {} |", figure(quantity));
                }
            }
            println!("{line}");
            table += &line;
            table.push('\n');
        }
    }
    Ok(table)
}
