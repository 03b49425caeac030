use serde_json::{Value, json};

use super::failure::Failure;
use super::memory_check::check_cells_memory;
use super::stdout::say;
use super::visibility::{VisibilityCosts, VisibilityName, cells, with_visibility};
use crate::{
    AnyLightSampler, ChoiceEstimates, ChoicePlan, SamplerKind, View, Visibility, VisibilityCells,
    World,
};

/// What is known of visibility in a picture by the scene's camera.
pub(super) enum Visible {
    /// What light samples tell, and the cells that pay; `None` where nothing is lit, and for a tree
    /// of placed trees.
    Share(Option<(ChoiceEstimates, Cells)>),
    Cells(Cells),
}

/// The cells of visibility for a picture by the scene's camera.
pub(super) struct Cells {
    counts: [usize; 2],
    /// Pixels that show a surface in a cell, and all.
    pixels: [usize; 2],
    costs: VisibilityCosts,
}

impl Visible {
    pub(super) fn over(
        name: VisibilityName,
        world: &World,
        view: &View,
        max_depth: u32,
    ) -> Result<Self, Failure> {
        let sampler =
            AnyLightSampler::new(SamplerKind::DEFAULT, world.lights()).map_err(Failure::input)?;
        Ok(match name {
            VisibilityName::Cells => {
                let (width, height) = view.resolution();
                check_cells_memory(width, height)?;
                let with = with_visibility(sampler, Visibility::Cells, world, view, max_depth)?;
                Self::Cells(Cells::of(with, view))
            }
            VisibilityName::Off | VisibilityName::Share | VisibilityName::Pilot => {
                let estimates = |lights| ChoiceEstimates::new(world, view, lights, max_depth);
                let estimates = sampler.hierarchy().and_then(estimates);
                let with = with_visibility(sampler, Visibility::Share, world, view, max_depth)?;
                Self::Share(estimates.map(|estimates| (estimates, Cells::of(with, view))))
            }
        })
    }

    pub(super) fn report(&self) -> Value {
        match self {
            Self::Share(Some((estimates, cells))) => json!({
                "visible_share": estimates.visible_share(),
                "variances": ChoicePlan::ALL.map(|plan| estimates.variance(plan)),
                "choice": estimates.best().name(),
                "cells": cells.report(),
            }),
            Self::Share(None) => json!({ "visible_share": null }),
            Self::Cells(cells) => cells.report(),
        }
    }

    pub(super) fn print(&self) -> Result<(), Failure> {
        match self {
            Self::Share(Some((estimates, cells))) => {
                let of = |plan| estimates.variance(plan);
                say!(
                    "  visibility {:.2} of the light that nothing would hide arrives",
                    estimates.visible_share()
                )?;
                say!(
                    "  choice     {}: variances of a sample {:.3}, by a cut {:.3}, by two {:.3}",
                    estimates.best().name(),
                    of(ChoicePlan::OneFromRoot),
                    of(ChoicePlan::OneByCut),
                    of(ChoicePlan::AsAsked)
                )?;
                cells.print()
            }
            Self::Share(None) => {
                say!("  visibility no estimate: nothing is lit, or a tree of placed trees chooses")
            }
            Self::Cells(cells) => cells.print(),
        }
    }
}

impl Cells {
    fn of((sampler, costs): (AnyLightSampler, VisibilityCosts), view: &View) -> Self {
        let cells = cells(&sampler);
        Self {
            counts: cells.map_or([0; 2], VisibilityCells::counts),
            pixels: [cells.map_or(0, VisibilityCells::pixels), view.pixels()],
            costs,
        }
    }

    fn report(&self) -> Value {
        json!({
            "coarse_cells": self.counts[0],
            "fine_cells": self.counts[1],
            "known_pixels": self.pixels[0],
            "pixels": self.pixels[1],
            "bytes": self.costs.bytes,
            "seconds": self.costs.time.as_secs_f64(),
        })
    }

    fn print(&self) -> Result<(), Failure> {
        let ([coarse, fine], [known, all]) = (self.counts, self.pixels);
        say!(
            "  cells      {coarse} coarse and {fine} fine ones know the lights of {known} of {all} \
             pixels: {} bytes, filled in {:.2} s",
            self.costs.bytes,
            self.costs.time.as_secs_f64()
        )
    }
}
