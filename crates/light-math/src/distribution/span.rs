/// How an interval covers equal texels: `first..=last`, the ends in part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub(super) first: usize,
    pub(super) last: usize,
    /// Ends of the interval in texels, from 0 to their number.
    pub(super) start: f64,
    pub(super) end: f64,
}

impl Span {
    /// The interval from `min` to `max`, of `[0, 1]`, on `texels` texels.
    #[inline]
    pub(super) fn new(min: f32, max: f32, texels: usize) -> Self {
        // Exact: 24 bits times 24 bits.
        let (start, end) = (
            f64::from(min) * texels as f64,
            f64::from(max) * texels as f64,
        );
        let (first, last) = (texel(start, texels), texel(end, texels));
        Self {
            first,
            last,
            start,
            end,
        }
    }

    /// The sum over the covered part, given the sum over whole texels.
    #[inline]
    pub(super) fn sum(&self, whole: impl Fn(usize, usize) -> f64) -> f64 {
        self.sum_before(self.last, &whole)
            + self.covered(self.last) * whole(self.last, self.last + 1)
    }

    /// The same before texel `texel`, which is one of `first..=last`.
    #[inline]
    pub(super) fn sum_before(&self, texel: usize, whole: impl Fn(usize, usize) -> f64) -> f64 {
        if texel == self.first {
            return 0.0;
        }
        let middle = self.first + 1;
        self.covered(self.first) * whole(self.first, middle) + whole(middle, texel)
    }

    /// The covered part of a texel, from 0 to 1.
    #[inline]
    pub(super) fn covered(&self, texel: usize) -> f64 {
        self.end.min((texel + 1) as f64) - self.start.max(texel as f64)
    }
}

/// The texel at `position`, counted in texels.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the integer part of a number from 0 to the number of texels"
)]
pub(super) fn texel(position: f64, texels: usize) -> usize {
    (position as usize).min(texels - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn covers_texels_in_part() {
        // Texel i weighs i + 1.
        let whole = |a: usize, b: usize| (a..b).map(|i| (i + 1) as f64).sum();
        let span = Span::new(0.125, 0.875, 4);
        assert_eq!((span.first, span.last), (0, 3), "texels");
        assert_eq!(span.sum(whole), 0.5 + 2.0 + 3.0 + 0.5 * 4.0, "in part");
        assert_eq!(span.sum_before(2, whole), 2.5, "before the third");
        assert_eq!(Span::new(0.25, 0.375, 4).sum(whole), 1.0, "within one");
        assert_eq!(Span::new(0.0, 1.0, 4).sum(whole), 10.0, "all");
    }

    #[test]
    fn positions_and_texels() {
        assert_eq!(
            (texel(0.0, 4), texel(3.999, 4), texel(4.0, 4)),
            (0, 3, 3),
            "closed at the end"
        );
    }
}
