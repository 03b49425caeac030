use lights::glam::Vec3;

use crate::ExactSum;
use crate::exact_sum::LARGEST_TERM;

/// The sums of a row of pixels, with as many bits as they need: 24 bytes a pixel while no sum of
/// the row reaches 65536, 30 while none reaches 2^31, and 48 then.
#[derive(Clone, Debug)]
pub struct FilmRow {
    /// The lower 64 bits of each channel's steps.
    low: Vec<[u64; 3]>,
    high: HighWords,
    /// Which pixels have samples above the largest term of a sum; empty where none has.
    clipped: Vec<bool>,
}

/// The upper 64 bits of each channel's steps.
#[derive(Clone, Debug)]
enum HighWords {
    /// All are 0.
    Zero,
    /// All fit into 16 bits.
    Narrow(Vec<[i16; 3]>),
    /// They need all bits.
    Wide(Vec<[i64; 3]>),
}

impl FilmRow {
    /// Black pixels.
    pub(crate) fn new(width: usize) -> Self {
        Self {
            low: vec![[0; 3]; width],
            high: HighWords::Zero,
            clipped: Vec::new(),
        }
    }

    /// Adds a sample to pixel `x`; of channels above 2^46 that much.
    ///
    /// # Panics
    /// Panics if there is no such pixel.
    #[inline]
    pub fn add(&mut self, x: usize, radiance: Vec3) {
        self.add_sum(x, radiance.into());
        if radiance.abs().max_element() > LARGEST_TERM {
            self.set_clipped(x);
        }
    }

    /// Adds several samples to pixel `x`.
    #[inline]
    pub(crate) fn add_sum(&mut self, x: usize, sum: ExactSum) {
        let mut high = [0; 3];
        for ((low, high), term) in self.low[x].iter_mut().zip(&mut high).zip(sum.steps()) {
            let (term_low, term_high) = words(term);
            let (total, carry) = low.overflowing_add(term_low);
            *low = total;
            *high = term_high.saturating_add(carry.into());
        }
        if high != [0; 3] {
            let sum = self.high.get(x);
            let sum = core::array::from_fn(|i| sum[i].saturating_add(high[i]));
            self.high.set(x, sum, self.low.len());
        }
    }

    /// Notes that pixel `x` has less than its samples.
    #[cold]
    fn set_clipped(&mut self, x: usize) {
        self.clipped.resize(self.low.len(), false);
        self.clipped[x] = true;
    }

    /// Takes over which pixels of a row of the same length are clipped.
    pub(crate) fn add_clipped(&mut self, other: &Self) {
        let clipped = other.clipped.iter().enumerate();
        for (x, _) in clipped.filter(|(_, is_so)| **is_so) {
            self.set_clipped(x);
        }
    }

    /// How many pixels are clipped.
    pub(crate) fn clipped(&self) -> usize {
        self.clipped.iter().filter(|is_so| **is_so).count()
    }

    /// The sum of pixel `x`.
    pub(crate) fn sum(&self, x: usize) -> ExactSum {
        let (low, high) = (self.low[x], self.high.get(x));
        let steps = |i: usize| i128::from(high[i]) << 64 | i128::from(low[i]);
        ExactSum::from_steps([steps(0), steps(1), steps(2)])
    }

    /// The sums of all pixels.
    pub(crate) fn sums(&self) -> impl Iterator<Item = ExactSum> {
        (0..self.low.len()).map(|x| self.sum(x))
    }
}

impl HighWords {
    #[inline]
    fn get(&self, x: usize) -> [i64; 3] {
        match self {
            Self::Zero => [0; 3],
            Self::Narrow(words) => words[x].map(i64::from),
            Self::Wide(words) => words[x],
        }
    }

    /// Sets the words of pixel `x` of `width`, with wider storage for all where these do not fit.
    #[cold]
    fn set(&mut self, x: usize, high: [i64; 3], width: usize) {
        let narrow = narrowed(high);
        match (&mut *self, narrow) {
            (Self::Wide(words), _) => words[x] = high,
            (Self::Narrow(words), Some(narrow)) => words[x] = narrow,
            (Self::Zero, Some(narrow)) => {
                let mut words = vec![[0; 3]; width];
                words[x] = narrow;
                *self = Self::Narrow(words);
            }
            (_, None) => {
                let mut words: Vec<_> = (0..width).map(|x| self.get(x)).collect();
                words[x] = high;
                *self = Self::Wide(words);
            }
        }
    }
}

fn narrowed([x, y, z]: [i64; 3]) -> Option<[i16; 3]> {
    Some([x.try_into().ok()?, y.try_into().ok()?, z.try_into().ok()?])
}

/// The lower and the upper half of a number.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the halves of a number"
)]
const fn words(steps: i128) -> (u64, i64) {
    (steps as u64, (steps >> 64) as i64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact_sum::tests::terms;

    #[test]
    fn sums_are_exact_whatever_room_they_need() {
        let large = [1e4, -3e4, 7e4, 1e9, 3e9, -1e10, 7e13, 1e30, -1e30, f32::NAN];
        let large = large.map(|x| Vec3::new(x, 0.5 * x, -x));
        for terms in [
            terms(),
            large.into(),
            terms().into_iter().chain(large).collect(),
        ] {
            let mut row = FilmRow::new(3);
            let mut expected = ExactSum::default();
            for &term in &terms {
                row.add(1, term);
                expected = expected + term.into();
                assert_eq!(row.sum(1), expected, "after {term}");
            }
            let others = [row.sum(0), row.sum(2)];
            assert_eq!(others, [ExactSum::default(); 2], "nothing beside");
        }
    }

    #[test]
    fn rows_grow_only_where_they_must() {
        let mut row = FilmRow::new(2);
        row.add(0, Vec3::splat(65_535.0));
        assert!(matches!(row.high, HighWords::Zero), "24 bytes");
        row.add(0, Vec3::ONE);
        assert!(matches!(row.high, HighWords::Narrow(_)), "30 bytes");
        row.add(1, Vec3::splat(2e9));
        assert!(matches!(row.high, HighWords::Narrow(_)), "still");
        row.add(1, Vec3::splat(2e9));
        assert!(matches!(row.high, HighWords::Wide(_)), "48 bytes");
        assert_eq!(row.sum(0), Vec3::splat(65_536.0).into(), "kept");
    }
}
