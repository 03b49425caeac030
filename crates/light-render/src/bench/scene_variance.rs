use lights::bounds::{LightId, LightSampleContext};
use lights::samplers::LightSampler;
use rayon::prelude::*;

use super::scene_receiver::{points, receivers};
use super::variance_split::{LightMoments, VarianceSplit};
use crate::{AnyLightSampler, AnyLightSamplerError, SamplerKind, View, World};

/// A way to choose one light at a receiver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ChoiceKind {
    /// The default hierarchy, one choice.
    Tree,
    /// The default hierarchy, one of two choices: by its cut.
    Cut,
    /// The published hierarchy.
    Reference,
    /// The default hierarchy with the cells of visibility of the view, one choice.
    Cells,
    /// In proportion to the unoccluded contribution of each light.
    Unoccluded,
    /// In proportion to the probability of the default hierarchy times the root of the share of the
    /// light that is seen.
    TreeAndVisibility,
    /// In proportion to the root of the second moment of the arriving light: the least variance.
    Best,
}

/// The variance of one choice, mean over the receivers that a camera sees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RelativeVariance {
    /// Between lights: better choices can remove it.
    pub between: f64,
    /// Within lights: penumbrae, and the forms of lights.
    pub within: f64,
    /// The share of all light that comes from lights of probability 0.
    pub lost: f64,
}

/// How well lights of a scene can be chosen, seen from its camera.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneVariance {
    /// How many points were looked at: where the camera sees a surface that emits nothing and
    /// scatters light into more than single directions.
    pub receivers: usize,
    /// Of the light that would arrive at all receivers if nothing were in the way, the share that
    /// arrives.
    pub arriving: f64,
    /// Each way to choose, in the order of [`ChoiceKind::ALL`].
    pub rows: Vec<(ChoiceKind, RelativeVariance)>,
}

impl ChoiceKind {
    /// All kinds.
    pub const ALL: [Self; 7] = [
        Self::Tree,
        Self::Cut,
        Self::Reference,
        Self::Cells,
        Self::Unoccluded,
        Self::TreeAndVisibility,
        Self::Best,
    ];

    /// A few words for the title of a column.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Tree => "tree",
            Self::Cut => "cut of two",
            Self::Reference => "reference tree",
            Self::Cells => "cells",
            Self::Unoccluded => "exact irradiance",
            Self::TreeAndVisibility => "tree x root of visibility",
            Self::Best => "ceiling",
        }
    }
}

/// The exact variance of one choice among the lights of `world` at one receiver for each pixel of
/// `view`: all lights are tried, with `strata` times `strata` points each, by the light samples and
/// the rays of the renderer. What arrives is what a receiver scatters toward the camera, mean over
/// the channels; material samples have no part in it.
///
/// As in relMSE, the variance at a receiver is divided by the squared light there plus a hundredth
/// of the square of the mean light over all receivers. Points and receivers are functions of
/// `seed`. `O(receivers * lights * strata^2)` light samples and rays.
///
/// # Errors
/// When a hierarchy refuses the lights.
pub fn scene_variance(
    world: &World,
    view: &View,
    strata: u16,
    seed: u32,
) -> Result<SceneVariance, AnyLightSamplerError> {
    let tree = AnyLightSampler::new(SamplerKind::Bvh, world.lights())?;
    let samplers = Samplers {
        reference: AnyLightSampler::new(SamplerKind::BvhReference, world.lights())?,
        cells: tree.clone().in_cells(world, view, 2)?,
        tree,
    };
    let receivers = receivers(world, view, seed);
    let at_each: Vec<AtReceiver> = receivers
        .par_iter()
        .map(|receiver| {
            let lights = receiver.moments(world, &points(strata.max(1), receiver.key));
            AtReceiver::new(&receiver.ctx, &lights, &samplers)
        })
        .collect();
    Ok(SceneVariance::over(&at_each))
}

/// The hierarchies that are compared.
struct Samplers {
    tree: AnyLightSampler,
    reference: AnyLightSampler,
    cells: AnyLightSampler,
}

/// The variances at one receiver, in the order of [`ChoiceKind::ALL`].
struct AtReceiver {
    splits: [VarianceSplit; ChoiceKind::ALL.len()],
    unoccluded: f64,
}

impl AtReceiver {
    fn new(
        ctx: &LightSampleContext,
        lights: &[(LightId, LightMoments)],
        samplers: &Samplers,
    ) -> Self {
        let Samplers {
            tree,
            reference,
            cells,
        } = samplers;
        let moments: Vec<LightMoments> = lights.iter().map(|(_, light)| *light).collect();
        let by = |pmf: &dyn Fn(LightId) -> f32| {
            VarianceSplit::of(
                lights
                    .iter()
                    .map(|&(id, light)| (light, f64::from(pmf(id)))),
            )
        };
        let weights: Vec<f64> = lights
            .iter()
            .map(|&(id, light)| f64::from(tree.pmf(ctx, id)) * light.seen().sqrt())
            .collect();
        let sum: f64 = weights.iter().sum();
        let cut = tree.at(ctx, 2);
        let splits = ChoiceKind::ALL.map(|kind| match kind {
            ChoiceKind::Tree => by(&|id| tree.pmf(ctx, id)),
            ChoiceKind::Cut => by(&|id| cut.pmf(id)),
            ChoiceKind::Reference => by(&|id| reference.pmf(ctx, id)),
            ChoiceKind::Cells => by(&|id| cells.pmf(ctx, id)),
            ChoiceKind::Unoccluded => {
                VarianceSplit::in_proportion(&moments, |light| light.unoccluded)
            }
            ChoiceKind::TreeAndVisibility => {
                let weighed = moments.iter().zip(&weights);
                VarianceSplit::of(weighed.map(|(light, w)| (*light, w / sum)))
            }
            ChoiceKind::Best => VarianceSplit::best(&moments),
        });
        Self {
            splits,
            unoccluded: moments.iter().map(|light| light.unoccluded).sum(),
        }
    }

    /// The arriving light.
    const fn total(&self) -> f64 {
        self.splits[0].total
    }
}

impl SceneVariance {
    fn over(at_each: &[AtReceiver]) -> Self {
        let total: f64 = at_each.iter().map(AtReceiver::total).sum();
        let unoccluded: f64 = at_each.iter().map(|at| at.unoccluded).sum();
        let count = at_each.len().max(1) as f64;
        let floor = 0.01 * (total / count) * (total / count);
        let row = |(i, kind): (usize, ChoiceKind)| {
            let mut mean = RelativeVariance::default();
            for at in at_each {
                let split = at.splits[i];
                let weight = 1.0 / (at.total() * at.total() + floor) / count;
                if weight.is_finite() {
                    mean.between += split.between * weight;
                    mean.within += split.within * weight;
                }
                mean.lost += if total > 0.0 { split.lost / total } else { 0.0 };
            }
            (kind, mean)
        };
        Self {
            receivers: at_each.len(),
            arriving: if unoccluded > 0.0 {
                total / unoccluded
            } else {
                0.0
            },
            rows: ChoiceKind::ALL.into_iter().enumerate().map(row).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::Shadows;
    use light_scene::{OcclusionKind, OcclusionScene};
    use lights::glam::Vec2;
    use lights::math::fraction::to_f32;
    use rand_core::{Rng, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    /// Choices and points at random have the variance that the sum over all of them says, at the
    /// receiver of a single pixel.
    #[test]
    fn random_choices_have_the_variance_of_the_split() {
        const DRAWS: u32 = 400_000;
        const STRATA: u16 = 8;
        let scene = OcclusionScene {
            kind: OcclusionKind::Trunks,
            lamps: 40,
            seed: 3,
        };
        let scene = scene.load();
        let view = View::new(&scene.camera_or_default(), 1, 1).expect("a pixel");
        let world = World::new(scene).expect("valid");
        let exact = scene_variance(&world, &view, STRATA, 2).expect("lights");
        assert_eq!(exact.receivers, 1, "the ground");
        let (kind, row) = exact.rows[0];
        assert_eq!(kind, ChoiceKind::Tree, "the first row");

        let receiver = &receivers(&world, &view, 2)[0];
        let tree = AnyLightSampler::new(SamplerKind::Bvh, world.lights()).expect("lights");
        let mut rng = Pcg64Mcg::seed_from_u64(5);
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..DRAWS {
            let Some(choice) = tree.sample(&receiver.ctx, rng.next_u64()) else {
                continue;
            };
            let u = Vec2::new(to_f32(rng.next_u64()), to_f32(rng.next_u64()));
            let [_, f] = receiver.gives(&world, choice.light, u, Shadows::Cast);
            let x = f / f64::from(choice.pmf);
            sum += x;
            squares += x * x;
        }
        let mean = sum / f64::from(DRAWS);
        let variance = squares / f64::from(DRAWS) - mean * mean;
        // One receiver: the floor is a hundredth of its own light.
        let by_draws = variance / (1.01 * mean * mean);
        let by_sums = row.between + row.within;
        assert!(
            (by_draws / by_sums - 1.0).abs() < 0.05,
            "{by_draws}, {by_sums}"
        );
        assert!(row.between > 0.0, "{row:?}");
    }
}
