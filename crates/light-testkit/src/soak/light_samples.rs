use light_math::glam::{Vec2, Vec3};
use light_sources::PdfCoverage;

use super::described_lights::Lights;
use super::receivers::receiver;
use super::report::Row;
use crate::light_agreement::{Demand, le_agrees, li_agrees};
use crate::{Rng, edge_cases};

/// Samples that one receiver takes.
const EACH: u32 = 8;

/// `None` results that are allowed for each sample that is compared.
const MOST_NONE: u64 = 8;

/// One empty row a light.
pub(super) fn rows(lights: &Lights) -> Vec<Row> {
    lights
        .names
        .iter()
        .map(|(name, _)| Row::new(*name))
        .collect()
}

/// Takes `count` samples of one light: of eight six that arrive at a receiver, two that leave.
pub(super) fn soak(lights: &Lights, index: usize, count: u64, seed: u64) -> Row {
    let (_, id) = lights.names[index];
    let light = lights.set.get(id).expect("a light of the set");
    let mut rng = Rng::new(seed);
    let mut row = Row::default();
    while row.samples < count && row.none < MOST_NONE * count {
        let ctx = receiver(&mut rng, Vec3::splat(-4.0), Vec3::splat(4.0));
        for i in 0..EACH {
            let outcome = match i % 4 {
                0 => le_agrees(&light, point(&mut rng), point(&mut rng), Demand::Density),
                1 => li_agrees(
                    &light,
                    &ctx,
                    point(&mut rng),
                    PdfCoverage::Incomplete,
                    Demand::Density,
                ),
                _ => li_agrees(
                    &light,
                    &ctx,
                    point(&mut rng),
                    PdfCoverage::Complete,
                    Demand::Density,
                ),
            };
            match outcome {
                Ok(true) => row.count(None),
                Ok(false) => row.none += 1,
                Err(fault) => row.count(Some(fault)),
            }
        }
    }
    row
}

/// A point of the unit square, now and then at an edge.
fn point(rng: &mut Rng) -> Vec2 {
    let mut u = || match rng.below(64) {
        0 => edge_cases::EDGES_OF_U[rng.below(edge_cases::EDGES_OF_U.len())],
        _ => rng.f32(),
    };
    Vec2::new(u(), u())
}
