//! From the visible share of each child to the factors of a cell.

use alloc::vec;
use alloc::vec::Vec;

use crate::node::wide_node::WIDTH;
use crate::visibility::cell_factors::CopiedNode;
use crate::visibility::factor_code::{ONE, encode_factor};

/// Codes of the factors with which each closed child is chosen in proportion to its `mean`
/// importance times its visible `share`, which counts at least `floor` of the mean share. An opened
/// child gets the sum of its children, so that the choice is the same at every level.
///
/// This also corrects the importance: that of a child at its parent becomes the sum over the
/// child's own children.
pub(super) fn factors(
    shape: &[CopiedNode],
    mean: &[[f32; WIDTH]],
    share: &[[f32; WIDTH]],
    floor: f32,
) -> Vec<[u8; WIDTH]> {
    let least = floor * mean_share(shape, mean, share);
    let mut codes = vec![[ONE; WIDTH]; shape.len()];
    let mut sums = vec![0.0; shape.len()];
    // Copies come after their parents.
    for (place, copied) in shape.iter().enumerate().rev() {
        for child in 0..WIDTH {
            let importance = mean[place][child];
            let closed = share[place][child].max(least);
            let factor = match copied.copy_of(child) {
                Some(copy) if importance > 0.0 => sums[copy] / importance,
                _ => closed,
            };
            sums[place] += importance * factor;
            codes[place][child] = encode_factor(factor);
        }
    }
    codes
}

/// The mean of the shares of all closed children, by importance; 1 if nothing has importance.
fn mean_share(shape: &[CopiedNode], mean: &[[f32; WIDTH]], share: &[[f32; WIDTH]]) -> f32 {
    let (mut all, mut kept) = (0.0, 0.0);
    for ((copied, mean), share) in shape.iter().zip(mean).zip(share) {
        for child in (0..WIDTH).filter(|&child| copied.copy_of(child).is_none()) {
            all += mean[child];
            kept += mean[child] * share[child];
        }
    }
    if all > 0.0 { kept / all } else { 1.0 }
}
