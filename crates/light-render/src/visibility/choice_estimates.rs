use lights::samplers::BvhLightSampler;
use rayon::prelude::*;

use super::choice_plan::ChoicePlan;
use super::pixel_moments::{PixelMoments, pixel_moments};
use crate::{View, World};

/// Rows and columns of the grid of pixels that are looked at.
const GRID: u32 = 32;

/// Rows and columns of the blocks of that grid whose mean light sets the scale of their noise.
const BLOCK: u32 = 2;

/// What each node on the longest way down the hierarchy adds to the cost of a sample by a cut, in
/// costs of a sample from the root: 7 to 25 % among hundreds of lights, 10 to 45 % among 100,000,
/// by the thread seconds of pictures.
const CUT_COST_PER_LEVEL: f64 = 0.05;

/// What a second choice adds to the cost of a vertex, measured likewise.
const SECOND_CHOICE_COST: f64 = 0.26;

/// A plan must be expected to be so much better than a faster one: few samples find too little of
/// rare bright light, which makes all plans noisy.
const HANDICAP: f64 = 1.05;

/// What a few light samples tell of the light in a picture, before it is rendered: how much of it
/// arrives, and how noisy it will be by each [`ChoicePlan`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChoiceEstimates {
    visible_share: f64,
    /// Relative to the light of a block of pixels.
    variances: [f64; 3],
    /// Relative to the light of each pixel.
    own_variances: [f64; 3],
    /// The parts of the variances that are of first vertices.
    first_shares: [f64; 3],
    costs: [f64; 3],
    /// Of a path, where light is sampled.
    vertices: f64,
}

impl ChoiceEstimates {
    /// Estimates for what `view` shows of `world`, over paths of at most `max_depth` segments;
    /// `None` where no light would arrive even without occlusion.
    ///
    /// Measured on the threads of the current `rayon` pool by 8,192 light samples at most at the
    /// surfaces that a grid of 32 x 32 pixels shows, and as many at the next two vertices of their
    /// paths: a pure function of the scene, of the whole picture's view, whatever part of it is
    /// rendered, and of `max_depth`.
    #[must_use]
    pub fn new(
        world: &World,
        view: &View,
        lights: &BvhLightSampler,
        max_depth: u32,
    ) -> Option<Self> {
        let pixels: Vec<PixelMoments> = (0..GRID * GRID)
            .into_par_iter()
            .map(|i| {
                let (width, height) = view.resolution();
                let pixel = (middle(i % GRID, width), middle(i / GRID, height));
                pixel_moments(world, view, lights, pixel, max_depth.saturating_sub(1))
            })
            .collect();
        // One after the other: the sums do not depend on the threads.
        let sum = |of: fn(&PixelMoments) -> f64| pixels.iter().map(of).sum::<f64>();
        let asked = sum(|pixel| pixel.asked);
        if !(asked > 0.0) {
            return None;
        }
        let lit = sum(|pixel| f64::from(u8::from(pixel.vertices > 0.0)));
        let floor = 0.1 * sum(|pixel| pixel.mean) / lit;
        let means: Vec<f64> = pixels.iter().map(|pixel| pixel.mean).collect();
        let relative = |means: &[f64], of: fn(&PixelMoments) -> [f64; 3]| {
            let mut sums = [0.0; 3];
            for (pixel, mean) in pixels.iter().zip(means) {
                let scale = mean * mean + floor * floor;
                if scale > 0.0 {
                    for (sum, variance) in sums.iter_mut().zip(of(pixel)) {
                        *sum += variance / scale / lit;
                    }
                }
            }
            sums
        };
        let vertices = (sum(|pixel| pixel.vertices) / lit).max(1.0);
        let cut = CUT_COST_PER_LEVEL * lights.tree().depth() as f64;
        let blocks = means_of_blocks(&pixels);
        let variances = relative(&blocks, |pixel| pixel.variances);
        let of_first = relative(&blocks, |pixel| pixel.of_first);
        Some(Self {
            visible_share: sum(|pixel| pixel.seen) / asked,
            variances,
            own_variances: relative(&means, |pixel| pixel.variances),
            first_shares: core::array::from_fn(|plan| of_first[plan] / variances[plan]),
            costs: [1.0, 1.0 + cut, 1.0 + (cut + SECOND_CHOICE_COST) / vertices],
            vertices,
        })
    }

    /// The share of light samples at the first vertices that arrive, among those that would without
    /// occlusion.
    #[must_use]
    pub const fn visible_share(&self) -> f64 {
        self.visible_share
    }

    /// The relative variance of a pixel by one sample, mean over pixels, by the plan; too small
    /// where rare light is bright.
    #[must_use]
    pub const fn variance(&self, plan: ChoicePlan) -> f64 {
        self.variances[plan as usize]
    }

    /// The part of the variance that is of first vertices.
    pub(super) const fn first_share(&self, plan: ChoicePlan) -> f64 {
        self.first_shares[plan as usize]
    }

    /// The cost of a sample, in costs of one with choices from the root.
    pub(super) const fn cost(&self, plan: ChoicePlan) -> f64 {
        self.costs[plan as usize]
    }

    /// Vertices of a path where light is sampled, of the three that are looked at.
    pub(super) const fn vertices(&self) -> f64 {
        self.vertices
    }

    /// The plan whose variance times the cost of a sample is estimated to be the least.
    ///
    /// Single choices are compared by variances relative to blocks of pixels, for the mean of a
    /// single pixel is large just where a sample has found rare bright light, and would hide it.
    /// Several choices pay where most light arrives, and samples of a pixel differ little: there
    /// the neighbours' brightness would add more error than it removes.
    #[must_use]
    pub fn best(&self) -> ChoicePlan {
        let is_better = |plan, faster, variances: &[f64; 3]| {
            let product = |plan: ChoicePlan| variances[plan as usize] * self.costs[plan as usize];
            product(plan) * HANDICAP < product(faster)
        };
        let mut best = ChoicePlan::OneFromRoot;
        if is_better(ChoicePlan::OneByCut, best, &self.variances) {
            best = ChoicePlan::OneByCut;
        }
        let mut singles = [ChoicePlan::OneFromRoot, ChoicePlan::OneByCut].into_iter();
        if singles.all(|single| is_better(ChoicePlan::AsAsked, single, &self.own_variances)) {
            best = ChoicePlan::AsAsked;
        }
        best
    }
}

/// For each pixel of the grid the mean light of its block.
fn means_of_blocks(pixels: &[PixelMoments]) -> Vec<f64> {
    let side = GRID / BLOCK;
    let block = |i: u32| (i / GRID / BLOCK * side + i % GRID / BLOCK) as usize;
    // Sums of light and numbers of lit pixels.
    let mut sums = vec![[0.0; 2]; (side * side) as usize];
    for (i, pixel) in (0..).zip(pixels) {
        if pixel.vertices > 0.0 {
            let [light, count] = &mut sums[block(i)];
            *light += pixel.mean;
            *count += 1.0;
        }
    }
    let mean = |i| {
        let [light, count]: [f64; 2] = sums[block(i)];
        if count > 0.0 { light / count } else { 0.0 }
    };
    (0..GRID * GRID).map(mean).collect()
}

/// The pixel in the middle of part `i` of so many pixels.
#[expect(clippy::cast_possible_truncation, reason = "less than `pixels`")]
const fn middle(i: u32, pixels: u32) -> u32 {
    ((2 * i as u64 + 1) * pixels as u64 / (2 * GRID as u64)) as u32
}
