#[cfg(feature = "alloc")]
use alloc::{vec, vec::Vec};

use super::TableError;
use super::alias_bin::AliasBin;
use super::alias_sweep::fill;
use crate::discrete::{SampledIndex, unit};

/// Indices in proportion to weights, in constant time however many there are.
///
/// `S` lends the bins: `Vec<AliasBin>`, `&[AliasBin]`, `[AliasBin; N]`. A sample reads two bins.
///
/// ```
/// # use light_math::distribution::AliasTable;
/// let table = AliasTable::new(&[1.0, 0.0, 3.0])?;
/// let chosen = table.sample(0.9);
/// assert_eq!((chosen.index, chosen.pmf), (2, 0.75));
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
            q: 0.0,
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
        let is_valid = |bin: &AliasBin| {
            let rest_is_reachable = slice
                .get(bin.alias as usize)
                .is_some_and(|other| bin.q == 1.0 || other.pmf > 0.0);
            let own_is_reachable = bin.q == 0.0 || bin.pmf > 0.0;
            let in_range = (0.0..=1.0).contains(&bin.q) && (0.0..=1.0).contains(&bin.pmf);
            in_range && own_is_reachable && rest_is_reachable
        };
        if slice.iter().all(is_valid) {
            Ok(Self { bins })
        } else {
            Err(TableError::Malformed)
        }
    }

    /// An index chosen by `u` in `[0, 1)`, with what is left of `u`.
    ///
    /// `u` is an `f64`: the 24 bits of an `f32` cannot address a million bins, much less a place
    /// within one.
    #[inline]
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the integer part of a product below the number of bins"
    )]
    pub fn sample(&self, u: f64) -> SampledIndex {
        let bins = self.bins.as_ref();
        let scaled = unit(u) * bins.len() as f64;
        let own = (scaled as usize).min(bins.len() - 1);
        let place = scaled - own as f64;
        let bin = &bins[own];
        let q = f64::from(bin.q);
        let (index, u) = if place < q {
            (own, place / q)
        } else {
            (bin.alias as usize, (place - q) / (1.0 - q))
        };
        SampledIndex {
            index,
            pmf: bins[index].pmf,
            u: unit(u),
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

    /// The probability of each index that the bins really give.
    fn realised(bins: &[AliasBin]) -> Vec<f64> {
        let mut mass = vec![0.0; bins.len()];
        for (index, bin) in bins.iter().enumerate() {
            mass[index] += f64::from(bin.q) / bins.len() as f64;
            mass[bin.alias as usize] += (1.0 - f64::from(bin.q)) / bins.len() as f64;
        }
        mass
    }

    #[test]
    fn bins_give_the_stated_probabilities() {
        let ramp: Vec<f32> = (0..1000u16).map(f32::from).collect();
        let wild: Vec<f32> = (0..1000u16)
            .map(|i| ((i * 37 % 101) as f32 - 50.0).exp2())
            .collect();
        // Each of the bins that feed an index rounds its share to an f32.
        for weights in [
            &ramp[..],
            &wild[..],
            &[5.0],
            &[0.0, 0.0, 1.0, 0.0],
            &[f32::MAX, 1e-45],
        ] {
            let table = AliasTable::new(weights).expect("valid weights");
            for (index, mass) in realised(table.bins()).into_iter().enumerate() {
                let pmf = f64::from(table.pmf(index));
                assert!((mass - pmf).abs() <= 1e-6 * pmf, "{index}: {mass} {pmf}");
            }
            AliasTable::from_bins(table.bins()).expect("its own bins are well-formed");
        }
    }

    #[test]
    fn a_million_weights_are_all_reached_and_u_is_left_over() {
        let weights = vec![1.0; 1_000_000];
        let table = AliasTable::new(&weights).expect("valid weights");
        for index in [0, 1, 499_999, 999_998, 999_999] {
            let s = table.sample((index as f64 + 0.25) / 1e6);
            assert_eq!(s.index, index, "every bin is its own");
            assert!((s.u - 0.25).abs() < 1e-6, "what is left: {}", s.u);
        }
    }

    #[test]
    fn zero_weights_are_never_returned() {
        let table = AliasTable::new(&[0.0, 1.0, 0.0, 0.1, 0.0]).expect("valid weights");
        for i in 0..=1000 {
            let s = table.sample(f64::from(i) / 1000.0);
            assert!(
                s.pmf > 0.0 && (0.0..1.0).contains(&s.u),
                "sample {i}: {s:?}"
            );
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
            q: 0.5,
            alias: 1,
            pmf: 1.0,
        };
        assert_eq!(
            AliasTable::from_bins([stray]),
            Err(TableError::Malformed),
            "stray alias"
        );
    }
}
