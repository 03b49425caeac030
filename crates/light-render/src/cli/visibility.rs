use core::time::Duration;
use std::time::Instant;

use clap::ValueEnum;

use crate::{AnyLightSampler, View, Visibility, VisibilityCells, World};

use super::failure::Failure;

/// The names of what is known of visibility on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum VisibilityName {
    Off,
    Share,
    Cells,
    Pilot,
}

impl VisibilityName {
    /// What to say of a name that does not do what it says.
    pub(super) const fn note(self) -> Option<&'static str> {
        match self {
            Self::Pilot => Some(
                "--visibility pilot: no pilot picture is made, lights are chosen as by default; \
                 share and cells choose them by what is seen (docs/occlusion.md says why there is \
                 no pilot)",
            ),
            Self::Off | Self::Share | Self::Cells => None,
        }
    }
}

/// What measuring or filling took.
#[derive(Debug, Default)]
pub(super) struct VisibilityCosts {
    pub(super) time: Duration,
    pub(super) bytes: usize,
}

/// The sampler with what is to be known of `visibility` for paths of at most `max_depth` segments,
/// measured or filled on the threads of the current `rayon` pool.
///
/// # Errors
/// When there are more cells than 32 bits count.
pub(super) fn with_visibility(
    sampler: AnyLightSampler,
    visibility: Visibility,
    world: &World,
    view: &View,
    max_depth: u32,
) -> Result<(AnyLightSampler, VisibilityCosts), Failure> {
    let start = Instant::now();
    let sampler = match visibility {
        Visibility::Off => return Ok((sampler, VisibilityCosts::default())),
        Visibility::Share => sampler.by_estimates(world, view, max_depth),
        Visibility::Cells => sampler
            .in_cells(world, view, max_depth)
            .map_err(Failure::input)?,
    };
    let costs = VisibilityCosts {
        time: start.elapsed(),
        bytes: cells(&sampler).map_or(0, VisibilityCells::bytes),
    };
    Ok((sampler, costs))
}

/// The cells of a sampler that has some.
pub(super) const fn cells(sampler: &AnyLightSampler) -> Option<&VisibilityCells> {
    match sampler {
        AnyLightSampler::BvhInCells(sampler) => Some(sampler.cells()),
        _ => None,
    }
}
