//! Compact bounds and their importance against light-bounds.

use light_bounds::{CompactLightBounds, LightBounds, LightSampleContext, ReceiverKind};
use light_gpu::compact_bounds_rows;
use light_math::Aabb;
use light_math::glam::Vec3;
use light_sets::{BenchSet, SetKind};

use crate::device::Device;
use crate::query::{Query, Weighed};

/// How far an importance may be off, as a part of itself.
const ERROR: f32 = 1e-4;

/// The share of the queries whose importance may be off by more, next to the edge of an emission:
/// WGSL lets a division err by 2.5 units in the last place. An H100 has 2.4e-4, Mesa's software
/// driver, which rounds every division correctly, less than 1e-4.
const OFF: f64 = 1e-3;

/// How far a corner may be off, as a part of the box, and a cosine.
const NEAR: f32 = 1e-6;

/// Lights of a set.
const LIGHTS: usize = 10_000;

/// Prints a row a set; whether all of them keep what is promised.
///
/// # Errors
/// One line by the driver.
pub fn check(device: &Device, count: u32, kinds: &[SetKind]) -> Result<bool, String> {
    println!("\n| bounds | decoded off | importance off | largest difference | zeros |");
    println!("| --- | ---: | ---: | ---: | ---: |");
    let mut all = true;
    for &kind in kinds {
        all &= check_set(device, kind, count)?;
    }
    Ok(all)
}

fn check_set(device: &Device, kind: SetKind, count: u32) -> Result<bool, String> {
    let set = BenchSet::generate(kind, LIGHTS, 1);
    let bounds: Vec<LightBounds> = set.lights.iter().map(|light| light.bounds()).collect();
    let all = bounds
        .iter()
        .map(|b| b.bounds)
        .reduce(|a, b| a.union(b))
        .expect("lights");
    let compact: Vec<CompactLightBounds> = bounds
        .iter()
        .map(|b| CompactLightBounds::encode(b, &all))
        .collect();
    let queries: Vec<Query> = (0..count).map(|i| Query::new(&set, LIGHTS, i)).collect();
    let rows = compact_bounds_rows(&compact, &all);
    let (answers, _) = device.run::<Weighed>(("weigh", 5), &rows, &queries)?;
    let [mut decoded, mut off, mut zeros] = [0u32; 3];
    let mut largest = 0.0f32;
    for (query, theirs) in queries.iter().zip(&answers) {
        let ours = compact[query.other().index()];
        decoded += u32::from(!is_near(&ours.decode(&all), theirs, &all));
        // The shader weighs the beginning of a segment.
        let ctx = query.context();
        let ours = match ctx.kind() {
            ReceiverKind::Segment { .. } => {
                ours.importance(&all, &LightSampleContext::medium(ctx.p))
            }
            _ => ours.importance(&all, &ctx),
        };
        if (ours > 0.0) != (theirs.importance > 0.0) {
            zeros += 1;
        } else if ours > 0.0 {
            let difference = (theirs.importance / ours - 1.0).abs();
            largest = largest.max(difference);
            off += u32::from(!(difference <= ERROR));
        }
    }
    let percent = |n: u32| 100.0 * f64::from(n) / f64::from(count);
    let name = kind.name();
    println!(
        "| {name} {LIGHTS} | {decoded} | {:.3} % | {largest:.1e} | {zeros} |",
        percent(off)
    );
    Ok(decoded == 0 && zeros == 0 && percent(off) <= 100.0 * OFF)
}

fn is_near(ours: &LightBounds, theirs: &Weighed, all: &Aabb) -> bool {
    let size = (all.max - all.min).max_element() + all.max.abs().max(all.min.abs()).max_element();
    let off = |a: Vec3, b: [f32; 3]| (a - Vec3::from(b)).abs().max_element();
    let cosines = (ours.cos_theta_o - theirs.cos_theta_o)
        .abs()
        .max((ours.cos_theta_e - theirs.cos_theta_e).abs());
    off(ours.bounds.min, theirs.lower).max(off(ours.bounds.max, theirs.upper)) <= NEAR * size
        && off(ours.w, theirs.w).max(cosines) <= NEAR
        && ours.phi == theirs.phi
        && ours.two_sided == (theirs.two_sided == 1)
}
