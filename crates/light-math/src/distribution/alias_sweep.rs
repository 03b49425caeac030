use super::alias_bin::AliasBin;
use super::error::{TableError, check_len, positive_total};

/// Fills `bins` by one sweep with a cursor over the weights below the mean and one over those above
/// it.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounds probabilities; indices were checked to fit"
)]
pub(super) const fn fill(weights: &[f32], bins: &mut [AliasBin]) -> Result<(), TableError> {
    let total = match positive_total(weights) {
        Ok(total) => total,
        Err(error) => return Err(error),
    };
    let len = weights.len();
    if let Err(error) = check_len(len, bins.len()) {
        return Err(error);
    }
    if len as u64 > u32::MAX as u64 {
        return Err(TableError::TooLarge);
    }
    let mut index = 0;
    while index < len {
        let pmf = (weights[index] as f64 / total) as f32;
        let alias = index as u32;
        bins[index] = AliasBin { q: 1.0, alias, pmf };
        index += 1;
    }

    let share = Share { weights, total };
    let mut light = share.next_light(0, bins);
    let mut heavy = share.next_heavy(0, bins);
    if heavy == len {
        return Ok(());
    }
    let mut following = share.next_heavy(heavy + 1, bins);
    let mut rest = share.of(heavy, bins);
    loop {
        if light < len && (rest > 1.0 || following == len) {
            // The heavy weight fills up the bin of a light one.
            let own = share.of(light, bins);
            bins[light].q = own as f32;
            bins[light].alias = heavy as u32;
            rest -= 1.0 - own;
            light = share.next_light(light + 1, bins);
        } else if following < len && rest <= 1.0 {
            // What is left of it has become light itself: the following one fills up its bin.
            bins[heavy].q = rest as f32;
            bins[heavy].alias = following as u32;
            rest += share.of(following, bins) - 1.0;
            heavy = following;
            following = share.next_heavy(heavy + 1, bins);
        } else {
            // Rounding alone is left over.
            return Ok(());
        }
    }
}

/// Weights in units of their mean.
struct Share<'a> {
    weights: &'a [f32],
    total: f64,
}

impl Share<'_> {
    /// A weight over the mean; 0 if its probability has vanished by rounding.
    const fn of(&self, index: usize, bins: &[AliasBin]) -> f64 {
        if bins[index].pmf > 0.0 {
            self.weights[index] as f64 * (self.weights.len() as f64 / self.total)
        } else {
            0.0
        }
    }

    const fn next_light(&self, mut index: usize, bins: &[AliasBin]) -> usize {
        while index < self.weights.len() && self.of(index, bins) > 1.0 {
            index += 1;
        }
        index
    }

    const fn next_heavy(&self, mut index: usize, bins: &[AliasBin]) -> usize {
        while index < self.weights.len() && self.of(index, bins) <= 1.0 {
            index += 1;
        }
        index
    }
}
