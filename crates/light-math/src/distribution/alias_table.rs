#[cfg(feature = "alloc")]
use alloc::{vec, vec::Vec};

use super::TableError;
use super::alias_bin::AliasBin;
use super::alias_sweep::fill;
use crate::discrete::{PARTS, SampledIndex};
use crate::fraction;

/// Indices in proportion to weights, in constant time however many there are.
///
/// `S` lends the bins: `Vec<AliasBin>`, `&[AliasBin]`, `[AliasBin; N]`. A sample reads two bins.
///
/// Probabilities are whole multiples of `2^-16 / n` for `n` weights, at least one for a positive
/// weight: exactly those with which the bins are chosen, rounded to an `f32` only to be stated.
///
/// ```
/// # use light_math::{distribution::AliasTable, fraction};
/// let table = AliasTable::new(&[1.0, 0.0, 3.0])?;
/// let chosen = table.sample(fraction::from_f64(0.9));
/// assert_eq!(chosen.index, 2);
/// assert!((chosen.pmf - 0.75).abs() < 1e-5);
/// # Ok::<(), light_math::distribution::TableError>(())
/// ```
///
/// # Source
/// `[Walker1974]`; built by the sweep of `[Huebschle2022]`, section 4.2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AliasTable<S> {
    bins: S,
}

#[cfg(feature = "alloc")]
impl AliasTable<Vec<AliasBin>> {
    /// The table of `weights`; index `i` is the position of a weight. One pass over the weights.
    ///
    /// # Errors
    /// [`TableError`] if there are no weights, all are zero, or one is negative or not finite.
    pub fn new(weights: &[f32]) -> Result<Self, TableError> {
        let mut bins = vec![AliasBin::default(); weights.len()];
        fill(weights, &mut bins)?;
        Ok(Self { bins })
    }
}

impl<const N: usize> AliasTable<[AliasBin; N]> {
    /// Like [`new`](AliasTable::new), in an array; usable in a `const` or `static`.
    ///
    /// # Errors
    /// As for [`new`](AliasTable::new).
    pub const fn in_array(weights: &[f32; N]) -> Result<Self, TableError> {
        const EMPTY: AliasBin = AliasBin {
            own: 0,
            alias: 0,
            pmf: 0.0,
        };
        let mut bins = [EMPTY; N];
        match fill(weights, &mut bins) {
            Ok(()) => Ok(Self { bins }),
            Err(error) => Err(error),
        }
    }
}

impl<'a> AliasTable<&'a [AliasBin]> {
    /// Like [`new`](AliasTable::new), in a buffer of as many bins as there are weights.
    ///
    /// # Errors
    /// As for [`new`](AliasTable::new), and [`TableError::SizeMismatch`].
    pub fn build_into(weights: &[f32], bins: &'a mut [AliasBin]) -> Result<Self, TableError> {
        fill(weights, bins)?;
        Ok(Self { bins })
    }
}

impl<S: AsRef<[AliasBin]>> AliasTable<S> {
    /// A table whose bins were built earlier, for example on another machine.
    ///
    /// # Errors
    /// [`TableError::Empty`] without bins, [`TableError::Malformed`] if an alias or a probability
    /// is out of range or a bin leads to an index of probability 0.
    pub fn from_bins(bins: S) -> Result<Self, TableError> {
        let slice = bins.as_ref();
        if slice.is_empty() {
            return Err(TableError::Empty);
        }
        // By bits, which are in the order of the numbers from 0 to 1; NaN and -0 are beyond.
        let is_positive = |bin: &AliasBin| bin.pmf.to_bits() > 0;
        let is_valid = |bin: &AliasBin| {
            let rest_is_reachable = slice
                .get(bin.alias as usize)
                .is_some_and(|other| bin.own == PARTS || is_positive(other));
            let own_is_reachable = bin.own == 0 || is_positive(bin);
            let in_range = bin.own <= PARTS && bin.pmf.to_bits() <= 1.0f32.to_bits();
            in_range && own_is_reachable && rest_is_reachable
        };
        if slice.iter().all(is_valid) {
            Ok(Self { bins })
        } else {
            Err(TableError::Malformed)
        }
    }

    /// An index chosen by `u`, a fraction of 2^64, with what is left of `u`.
    #[inline]
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a table has less than 2^32 bins; the upper 16 bits"
    )]
    pub fn sample(&self, u: u64) -> SampledIndex {
        let bins = self.bins.as_ref();
        let (bin, u) = fraction::choose(bins.len() as u32, u);
        let place = (u >> 48) as u32;
        let AliasBin { own, alias, .. } = bins[bin as usize];
        let (index, place, parts) = if place < own {
            (bin as usize, place, own)
        } else {
            (alias as usize, place - own, PARTS - own)
        };
        SampledIndex {
            index,
            pmf: bins[index].pmf,
            u: fraction::divide(place, u << 16, parts),
        }
    }

    /// The probability of `index`; 0 for one that is out of range. The same bits as in a sample.
    #[inline]
    #[must_use]
    pub fn pmf(&self, index: usize) -> f32 {
        self.bins.as_ref().get(index).map_or(0.0, |bin| bin.pmf)
    }

    /// The bins, one for each weight.
    #[inline]
    #[must_use]
    pub fn bins(&self) -> &[AliasBin] {
        self.bins.as_ref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The parts that the bins really give each index.
    fn given(bins: &[AliasBin]) -> Vec<u64> {
        let mut parts = vec![0; bins.len()];
        for (index, bin) in bins.iter().enumerate() {
            parts[index] += u64::from(bin.own);
            parts[bin.alias as usize] += u64::from(PARTS - bin.own);
        }
        parts
    }

    #[test]
    fn bins_give_the_stated_probabilities() {
        let ramp: Vec<f32> = (0..1000u16).map(f32::from).collect();
        let wild: Vec<f32> = (0..1000u16)
            .map(|i| ((i * 37 % 101) as f32 - 50.0).exp2())
            .collect();
        let falling: Vec<f32> = ramp.iter().rev().copied().collect();
        // Its parts take more than 32 bits.
        let mut dominant = vec![1.0; 70_000];
        dominant[7] = 1e9;
        for weights in [
            &ramp[..],
            &wild[..],
            &falling[..],
            &dominant[..],
            &[5.0],
            &[0.0, 0.0, 1.0, 0.0],
            &[f32::MAX, 1e-45],
            &[1e-45, f32::MAX],
        ] {
            let table = AliasTable::new(weights).expect("valid weights");
            let all = weights.len() as f64 * f64::from(PARTS);
            let total: f64 = weights.iter().map(|&w| f64::from(w)).sum();
            for (index, parts) in given(table.bins()).into_iter().enumerate() {
                let weight = weights[index];
                assert_eq!(parts > 0, weight > 0.0, "{index}: {parts}");
                let error = f64::from(table.pmf(index)) / (parts as f64 / all).max(1e-30) - 1.0;
                assert!(parts == 0 || error.abs() < 6e-8, "{index}: {error}");
                let exact = f64::from(weight) / total * all;
                // One for each positive weight, the others in proportion, and one by rounding.
                let low = exact * (1.0 - 1.0 / f64::from(PARTS)) - 1.0;
                assert!(
                    (low..=exact + 2.0).contains(&(parts as f64)),
                    "{parts} {exact}"
                );
            }
            AliasTable::from_bins(table.bins()).expect("its own bins are well-formed");
        }
    }

    #[test]
    fn a_million_weights_are_all_reached_and_u_is_left_over() {
        let weights = vec![1.0; 1_000_000];
        let table = AliasTable::new(&weights).expect("valid weights");
        for index in [0u32, 1, 499_999, 999_998, 999_999] {
            let s = table.sample(fraction::stratum(index, 1_000_000, 1 << 62));
            assert_eq!(s.index, index as usize, "every bin is its own");
            let u = fraction::to_f64(s.u);
            assert!((u - 0.25).abs() < 1e-6, "what is left: {u}");
        }
    }

    #[test]
    fn zero_weights_are_never_returned() {
        let table = AliasTable::new(&[0.0, 1.0, 0.0, 0.1, 0.0]).expect("valid weights");
        for i in 0..=1000 {
            let s = table.sample(fraction::stratum(i, 1001, 1 << 63));
            assert!(s.pmf > 0.0, "sample {i}: {s:?}");
        }
        assert_eq!(table.pmf(9), 0.0, "out of range");
    }

    #[test]
    fn array_and_buffer_hold_the_same_bins() {
        const WEIGHTS: [f32; 3] = [1.0, 2.0, 5.0];
        static TABLE: AliasTable<[AliasBin; 3]> = match AliasTable::in_array(&WEIGHTS) {
            Ok(table) => table,
            Err(_) => panic!("valid weights"),
        };
        let mut buffer = [AliasBin::default(); 3];
        let borrowed = AliasTable::build_into(&WEIGHTS, &mut buffer).expect("valid weights");
        assert_eq!(TABLE.bins(), borrowed.bins(), "same builder");
    }

    #[test]
    fn refuses() {
        let mut short = [AliasBin::default(); 1];
        let mismatch = TableError::SizeMismatch {
            expected: 2,
            found: 1,
        };
        let built = AliasTable::build_into(&[1.0, 1.0], &mut short);
        assert_eq!(built, Err(mismatch), "short buffer");
        assert_eq!(
            AliasTable::new(&[0.0]),
            Err(TableError::AllZero),
            "all zero"
        );
        let empty: [AliasBin; 0] = [];
        assert_eq!(
            AliasTable::from_bins(empty),
            Err(TableError::Empty),
            "no bins"
        );
        let stray = AliasBin {
            own: PARTS / 2,
            alias: 1,
            pmf: 1.0,
        };
        assert_eq!(
            AliasTable::from_bins([stray]),
            Err(TableError::Malformed),
            "stray alias"
        );
        let bin = |own, alias, pmf| AliasBin { own, alias, pmf };
        for (bins, what) in [
            ([bin(1, 1, 1.0), bin(0, 0, 0.0)], "leads to nothing"),
            ([bin(PARTS, 0, 1.0), bin(1, 0, 0.0)], "has nothing"),
            ([bin(PARTS + 1, 0, 1.0), bin(0, 0, 0.0)], "too many parts"),
            ([bin(PARTS, 0, 1.5), bin(0, 0, 0.0)], "too likely"),
            ([bin(PARTS, 0, 1.0), bin(0, 0, -1.0)], "below zero"),
            ([bin(PARTS, 0, 1.0), bin(0, 0, f32::NAN)], "no number"),
            ([bin(PARTS, 0, f32::NAN), bin(0, 0, 0.0)], "no number"),
        ] {
            let built = AliasTable::from_bins(bins);
            assert_eq!(built, Err(TableError::Malformed), "{what}");
        }
        let good = [bin(PARTS, 0, 1.0), bin(0, 0, 0.0)];
        assert!(AliasTable::from_bins(good).is_ok(), "one index of two");
    }
}
