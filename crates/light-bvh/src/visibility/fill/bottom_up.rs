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

/// The mean importance and the share of each closed child.
pub(super) fn closed_children<'a>(
    shape: &'a [CopiedNode],
    mean: &'a [[f32; WIDTH]],
    share: &'a [[f32; WIDTH]],
) -> impl Iterator<Item = (f32, f32)> + 'a {
    let nodes = shape.iter().zip(mean).zip(share);
    nodes.flat_map(|((copied, mean), share)| {
        let closed = (0..WIDTH).filter(|&child| copied.copy_of(child).is_none());
        closed.map(|child| (mean[child], share[child]))
    })
}

/// The mean of the shares of all closed children, by importance; 1 if nothing has importance.
fn mean_share(shape: &[CopiedNode], mean: &[[f32; WIDTH]], share: &[[f32; WIDTH]]) -> f32 {
    let (mut all, mut kept) = (0.0, 0.0);
    for (importance, share) in closed_children(shape, mean, share) {
        all += importance;
        kept += importance * share;
    }
    if all > 0.0 { kept / all } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(values: &[f32]) -> [f32; WIDTH] {
        core::array::from_fn(|child| values.get(child).copied().unwrap_or(0.0))
    }

    /// A root whose third child is copied too.
    fn shape() -> [CopiedNode; 2] {
        let root = CopiedNode {
            opened: 1 << 2,
            first: 1,
        };
        [root, CopiedNode::default()]
    }

    #[test]
    fn what_is_opened_gets_the_sum_of_its_children() {
        let mean = [row(&[1.0, 2.0, 4.0]), row(&[2.0, 4.0])];
        let share = [row(&[0.5, 0.25, 1.0]), row(&[1.0, 0.5])];
        let codes = factors(&shape(), &mean, &share, 0.0);
        let expected = [row(&[0.5, 0.25, 1.0]), row(&[1.0, 0.5])];
        for (codes, expected) in codes.iter().zip(expected) {
            for child in 0..3 {
                let expected = encode_factor(expected[child]);
                assert_eq!(codes[child], expected, "child {child} of {codes:?}");
            }
        }
        // The root's third child is worth half as much as its own children.
        let mean = [row(&[1.0, 2.0, 2.0]), mean[1]];
        let codes = factors(&shape(), &mean, &share, 0.0);
        assert_eq!(codes[0][2], encode_factor(2.0), "corrected");
    }

    /// An eighth of the mean share, which is a half: that of the third child does not count.
    #[test]
    fn no_closed_child_gets_less_than_a_share_of_the_mean() {
        let mean = [row(&[1.0, 1.0, 9.0]), row(&[1.0, 1.0])];
        let share = [row(&[0.0, 1.0, 0.0]), row(&[1.0, 0.0])];
        let codes = factors(&shape(), &mean, &share, 0.125);
        let least = encode_factor(0.0625);
        assert_eq!([codes[0][0], codes[1][1]], [least; 2], "{codes:?}");
    }

    #[test]
    fn nothing_of_importance_counts_as_wholly_seen() {
        let codes = factors(&shape(), &[row(&[]); 2], &[row(&[]); 2], 0.25);
        assert_eq!(codes, [[encode_factor(0.25); WIDTH]; 2], "the floor of 1");
    }

    /// Its children have importance, so there is no ratio.
    #[test]
    fn a_copied_child_without_importance_counts_as_closed() {
        let mean = [row(&[4.0]), row(&[1.0])];
        let share = [row(&[0.5, 0.0, 0.25]), row(&[1.0])];
        let codes = factors(&shape(), &mean, &share, 0.0);
        assert_eq!(codes[0][2], encode_factor(0.25), "{codes:?}");
        assert_eq!(codes[0][0], encode_factor(0.5), "{codes:?}");
    }
}
