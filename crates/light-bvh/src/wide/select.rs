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
        let target = u * f64::from(total);
        // The last child that can contribute takes what rounding leaves beyond the sum.
        let mut below = 0.0;
        let mut chosen = (usize::MAX, 0.0);
        for (k, &weight) in self.lanes.iter().enumerate() {
            if weight > 0.0 {
                let end = below + f64::from(weight);
                chosen = (k, below);
                if target < end {
                    break;
                }
                below = end;
            }
        }
        let (child, start) = chosen;
        let weight = self.lanes[child & (WIDTH - 1)];
        let rest = (target - start) / f64::from(weight);
        Some(Choice {
            child,
            probability: share(weight, total),
            u: rest.clamp(0.0, SampledLight::MAX_U),
        })
    }

    /// Probability of [`choose`](Self::choose)-ing `child`.
    #[inline(always)]
    pub(crate) fn probability(&self, child: usize) -> f32 {
        share(self.lanes[child & (WIDTH - 1)], self.total())
    }
}

/// `weight / total`: 0 only if the weight is.
#[inline(always)]
fn share(weight: f32, total: f32) -> f32 {
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
