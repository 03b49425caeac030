use crate::lane_math::{LaneMask, larger};
use crate::node::wide_node::WIDTH;
use crate::query::weights::{Weights, total};
use crate::visibility::factor_code::{UNIT, decode_scaled};

/// The factor of the unit of length that makes products irradiances again: the root of one over the
/// unit of factors.
const SHORTER: f32 = 16.0;

const _: () = assert!(SHORTER * SHORTER * UNIT == 1.0, "the unit of factors");

/// The share of the mixture that is the tree's choice without factors. It bounds the variance where
/// the few rays of a cell missed a light. Chosen by the variance V: see `docs/occlusion.md`.
const DEFENSIVE_SHARE: f32 = 1.0 / 16.0;

/// Multiplies the weights of the children of a node by their factors, each mixed with the mean of
/// all.
///
/// A weight of 0 stays 0, a positive one positive, also where the product underflows. The mixture
/// does not change the sum. Factors of 1 scale all weights by a power of two: choices keep their
/// bits.
///
/// # Source
/// A mixture with a density that is nowhere far too small bounds the variance: `[Hesterberg1995]`.
#[inline(always)]
pub(super) fn multiply(weights: &mut Weights, factors: &[u8; WIDTH]) {
    let factors = factors.map(decode_scaled);
    let products = core::array::from_fn(|k| weights.lanes[k] * factors[k]);
    // Not a number if all weights are 0, which they stay.
    let by_tree = DEFENSIVE_SHARE * (total(&products) / weights.total);
    for (weight, factor) in weights.lanes.iter_mut().zip(factors) {
        let mixed = (1.0 - DEFENSIVE_SHARE) * factor + by_tree;
        let product = larger(*weight * mixed, f32::MIN_POSITIVE);
        *weight = LaneMask::when(*weight > 0.0).keep(product);
    }
    weights.total = total(&weights.lanes);
    weights.inv_unit *= SHORTER;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::visibility::factor_code::{LARGEST, LEAST, ONE};

    fn weights(lanes: [f32; WIDTH]) -> Weights {
        Weights {
            lanes,
            total: total(&lanes),
            ..Weights::NONE
        }
    }

    #[test]
    fn no_factor_changes_which_children_can_be_chosen() {
        let lanes = core::array::from_fn(|k| [0.0, 1e-38, 1.0, 2e37][k % 4]);
        for code in 0..=u8::MAX {
            let mut product = weights(lanes);
            multiply(&mut product, &[code; WIDTH]);
            assert!(product.total.is_finite(), "{code}: {}", product.total);
            for (child, &lane) in lanes.iter().enumerate() {
                let is_there = product.probability(child) > 0.0;
                assert_eq!(is_there, lane > 0.0, "{code}: child {child}");
            }
        }
    }

    /// A child with the least factor among children with the largest.
    #[test]
    fn no_child_loses_more_than_the_tree_keeps() {
        let lanes = core::array::from_fn(|k| 0.5 + k as f32);
        let plain = weights(lanes);
        for child in 0..WIDTH {
            let mut codes = [LARGEST; WIDTH];
            codes[child] = LEAST;
            let mut product = plain;
            multiply(&mut product, &codes);
            let kept = product.probability(child) / plain.probability(child);
            let of_tree = DEFENSIVE_SHARE * (1.0 - plain.probability(child));
            assert!(kept > 0.98 * of_tree && kept < 0.1, "{child}: {kept}");
        }
    }

    #[test]
    fn factors_of_one_keep_choices_and_irradiances() {
        let lanes = core::array::from_fn(|k| 1e-12 + 3.7 * k as f32);
        let (plain, mut product) = (weights(lanes), weights(lanes));
        multiply(&mut product, &[ONE; WIDTH]);
        for child in 0..WIDTH {
            assert_eq!(
                product.probability(child),
                plain.probability(child),
                "{child}"
            );
        }
        let node = crate::WideNode {
            gain: 0x3f80,
            ..crate::WideNode::EMPTY
        };
        assert_eq!(
            product.irradiance(&node),
            plain.irradiance(&node),
            "irradiance"
        );
    }

    /// Products of a node as every vector width computes them.
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    #[derive(Clone, Copy)]
    struct Product([f32; WIDTH], [u8; WIDTH]);

    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    impl crate::simd::VectorWork for Product {
        type Output = [u32; WIDTH + 1];

        #[inline(always)]
        fn run(self) -> Self::Output {
            let mut product = weights(self.0);
            multiply(&mut product, &self.1);
            let bits = |k| product.lanes.get(k).copied().unwrap_or(product.total);
            core::array::from_fn(|k| bits(k).to_bits())
        }
    }

    /// Trivially true where the machine has no wider vectors than the build's target.
    #[test]
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    fn wide_vectors_give_the_bits_of_narrow_ones() {
        for code in 0..=u8::MAX {
            let lanes = core::array::from_fn(|k| [0.0, 1e-37, 3.1, 7e30][k % 4] * k as f32);
            let codes = core::array::from_fn(|k| code.wrapping_mul(k.to_le_bytes()[0]));
            let results = crate::simd::run_with_each_width(Product(lanes, codes));
            assert!(results.iter().all(|bits| *bits == results[0]), "{code}");
        }
    }
}
