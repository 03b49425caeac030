use super::TableError;
use crate::float::{next_down, next_up};

/// The most bins along an axis: an `f32` cannot count more.
const MOST_BINS: usize = 1 << 24;

/// Equal bins along an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axis {
    bins: usize,
    min: f32,
    width: f32,
}

impl Axis {
    /// `bins` bins over `[0, 1]`.
    pub(super) const fn unit(bins: usize) -> Result<Self, TableError> {
        if bins == 0 {
            return Err(TableError::Empty);
        }
        if bins > MOST_BINS {
            return Err(TableError::TooLarge);
        }
        let (min, width) = (0.0, 1.0);
        Ok(Self { bins, min, width })
    }

    /// The same bins over `[min, max]`.
    pub(super) fn over(self, min: f32, max: f32) -> Result<Self, TableError> {
        let width = max - min;
        if !(width > 0.0 && width.is_finite()) {
            return Err(TableError::Domain);
        }
        Ok(Self { min, width, ..self })
    }

    pub(super) const fn bins(&self) -> usize {
        self.bins
    }

    pub(super) const fn width(&self) -> f32 {
        self.width
    }

    /// The bin of `x` and the place in it, in `[0, 1]`; `None` outside the interval.
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the integer part of a number from 0 to the number of bins"
    )]
    pub(super) fn locate(&self, x: f32) -> Option<(usize, f32)> {
        let t = (x - self.min) / self.width;
        if !(0.0..=1.0).contains(&t) {
            return None;
        }
        let scaled = t * self.bins as f32;
        let bin = (scaled as usize).min(self.bins - 1);
        Some((bin, scaled - bin as f32))
    }

    /// The point at `place` in `[0, 1]` of `bin`, moved by roundings until [`locate`](Self::locate)
    /// finds it there.
    #[inline]
    pub(super) fn place(&self, bin: usize, place: f32) -> f32 {
        let t = (bin as f32 + place) / self.bins as f32;
        let mut x = self.min + self.width * t;
        // Two steps suffice on the unit interval; far from zero a bin may hold no float at all.
        for _ in 0..4 {
            match self.locate(x) {
                Some((found, _)) if found == bin => break,
                Some((found, _)) if found < bin => x = next_up(x),
                _ => x = next_down(x),
            }
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_found_in_their_bin() {
        for bins in [1, 3, 7, 1000, 4096, 1 << 20] {
            let axis = Axis::unit(bins).expect("bins");
            for bin in [0, 1, bins / 3, bins / 2, bins - 1] {
                let bin = bin.min(bins - 1);
                for place in [0.0, 0.5, 0.999_999, 0.999_999_94, 1.0] {
                    let found = axis.locate(axis.place(bin, place)).map(|f| f.0);
                    assert_eq!(found, Some(bin), "{place} of bin {bin} of {bins}");
                }
            }
        }
    }

    #[test]
    fn domain() {
        let axis = Axis::unit(4)
            .and_then(|a| a.over(-2.0, 6.0))
            .expect("domain");
        assert_eq!(axis.locate(3.0), Some((2, 0.5)), "inside");
        assert_eq!(axis.locate(6.0), Some((3, 1.0)), "upper end");
        assert_eq!(
            (axis.locate(6.1), axis.locate(f32::NAN)),
            (None, None),
            "outside"
        );
        assert_eq!(axis.over(1.0, 1.0), Err(TableError::Domain), "empty");
        assert_eq!(
            axis.over(-f32::MAX, f32::MAX),
            Err(TableError::Domain),
            "too wide"
        );
        assert_eq!(Axis::unit(0), Err(TableError::Empty), "no bins");
        assert_eq!(
            Axis::unit(MOST_BINS + 1),
            Err(TableError::TooLarge),
            "too many"
        );
    }
}
