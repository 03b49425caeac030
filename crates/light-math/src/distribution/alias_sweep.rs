use super::alias_bin::AliasBin;
use super::error::{TableError, check_len, positive_total};
use crate::discrete::PARTS;

/// The parts of a bin.
const BIN: u64 = PARTS as u64;

/// Fills `bins` by one sweep with a cursor over the indices of at most a bin and one over the
/// others.
pub(super) const fn fill(weights: &[f32], bins: &mut [AliasBin]) -> Result<(), TableError> {
    let total = match positive_total(weights) {
        Ok(total) => total,
        Err(error) => return Err(error),
    };
    if let Err(error) = check_len(weights.len(), bins.len()) {
        return Err(error);
    }
    if weights.len() as u64 > u32::MAX as u64 {
        return Err(TableError::TooLarge);
    }
    share_parts(weights, total, bins);
    sweep(bins);
    Ok(())
}

/// Stores in each bin the parts of its index: a whole number, at least 1 for a positive weight, and
/// as many as there are parts in all bins together. The sign of the probability marks those of more
/// than a bin until the sweep ends.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast truncates on purpose; probabilities are rounded"
)]
const fn share_parts(weights: &[f32], total: f64, bins: &mut [AliasBin]) {
    let all = bins.len() as u64 * BIN;
    let (mut positive, mut index) = (0, 0);
    while index < weights.len() {
        positive += (weights[index] > 0.0) as u64;
        index += 1;
    }
    // Running sums are rounded, so that no error adds up; the last one is `total` to the bit.
    let (mut sum, mut given, mut index) = (0.0, 0, 0);
    while index < weights.len() {
        let mut parts = 0;
        if weights[index] > 0.0 {
            sum += weights[index] as f64;
            let up_to = (sum / total * (all - positive) as f64 + 0.5) as u64;
            parts = 1 + up_to - given;
            given = up_to;
        }
        set_parts(&mut bins[index], parts);
        let pmf = (parts as f64 / all as f64) as f32;
        bins[index].pmf = if parts > BIN { -pmf } else { pmf };
        index += 1;
    }
}

/// Until the sweep settles a bin, both its words hold the parts of its index: 48 bits at the most.
#[expect(clippy::cast_possible_truncation, reason = "splits a word")]
const fn set_parts(bin: &mut AliasBin, parts: u64) {
    bin.own = parts as u32;
    bin.alias = (parts >> 32) as u32;
}

const fn parts(bin: &AliasBin) -> u64 {
    (bin.alias as u64) << 32 | bin.own as u64
}

/// Settles all bins: the indices of more than a bin fill up those of less.
///
/// Nothing rounds, so that the parts come out even.
const fn sweep(bins: &mut [AliasBin]) {
    let mut light = next_light(bins, 0);
    let mut heavy = next_heavy(bins, 0);
    while heavy < bins.len() {
        let mut rest = parts(&bins[heavy]);
        while rest > BIN && light < bins.len() {
            let own = parts(&bins[light]);
            settle(bins, light, own, heavy);
            rest -= BIN - own;
            light = next_light(bins, light + 1);
        }
        // What is left of it has become light itself: the following one fills up its bin.
        let following = next_heavy(bins, heavy + 1);
        if following < bins.len() {
            let lent = BIN - rest;
            settle(bins, heavy, rest, following);
            let left = parts(&bins[following]) - lent;
            set_parts(&mut bins[following], left);
        } else {
            settle(bins, heavy, BIN, heavy);
        }
        heavy = following;
    }
    while light < bins.len() {
        settle(bins, light, BIN, light);
        light = next_light(bins, light + 1);
    }
    let mut index = 0;
    while index < bins.len() {
        bins[index].pmf = bins[index].pmf.abs();
        index += 1;
    }
}

/// Gives the bin of `index` its `own` parts; the others belong to `alias`.
#[expect(
    clippy::cast_possible_truncation,
    reason = "indices were checked to fit, and a bin has 2^16 parts"
)]
const fn settle(bins: &mut [AliasBin], index: usize, own: u64, alias: usize) {
    bins[index].own = own as u32;
    bins[index].alias = alias as u32;
}

const fn next_light(bins: &[AliasBin], mut index: usize) -> usize {
    while index < bins.len() && bins[index].pmf < 0.0 {
        index += 1;
    }
    index
}

const fn next_heavy(bins: &[AliasBin], mut index: usize) -> usize {
    while index < bins.len() && !(bins[index].pmf < 0.0) {
        index += 1;
    }
    index
}
