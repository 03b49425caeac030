use light_bounds::SampledLight;

use super::lane::Weights;
use super::node::WIDTH;

/// A child chosen in proportion to its weight.
pub(crate) struct Choice {
    pub(crate) child: usize,
    pub(crate) probability: f32,
    /// The unused part of `u`.
    pub(crate) u: f64,
}

impl Weights {
    /// The child that `u` of `[0, 1)` falls on; `None` if no child can contribute.
    #[inline(always)]
    pub(crate) fn choose(&self, u: f64) -> Option<Choice> {
        let total = self.total();
        if !(total > 0.0) {
            return None;
        }
        let (child, u) = pick(&self.lanes, u * f64::from(total))?;
        Some(Choice {
            child,
            probability: share(self.lanes[child], total),
            u,
        })
    }

    /// Probability of [`choose`](Self::choose)-ing `child`.
    #[inline(always)]
    pub(crate) fn probability(&self, child: usize) -> f32 {
        share(self.lanes[child & (WIDTH - 1)], self.total())
    }
}

/// The child that `target`, from 0 to the sum of the weights, falls on, and how far into it as a part of 1.
///
/// Summed in double precision: 24 bits cannot address the lights below eight children that differ much.
#[inline(always)]
pub(crate) fn pick(lanes: &[f32; WIDTH], target: f64) -> Option<(usize, f64)> {
    let mut below = 0.0;
    // The last child with any weight takes what rounding leaves beyond the sum.
    let mut chosen = None;
    for (child, &weight) in lanes.iter().enumerate() {
        if weight > 0.0 {
            let weight = f64::from(weight);
            chosen = Some((child, below, weight));
            if target < below + weight {
                break;
            }
            below += weight;
        }
    }
    let (child, start, weight) = chosen?;
    let rest = (target - start) / weight;
    Some((child, rest.clamp(0.0, SampledLight::MAX_U)))
}

/// `weight / total`: 0 only if the weight is.
#[inline(always)]
pub(crate) fn share(weight: f32, total: f32) -> f32 {
    if weight > 0.0 {
        (weight / total).max(f32::MIN_POSITIVE)
    } else {
        0.0
    }
}

/// The probability of two choices in turn, which never vanishes by rounding alone.
#[inline(always)]
pub(crate) fn both(a: f32, b: f32) -> f32 {
    if a > 0.0 && b > 0.0 {
        (a * b).max(f32::MIN_POSITIVE)
    } else {
        0.0
    }
}
