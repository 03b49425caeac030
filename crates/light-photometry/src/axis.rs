/// Ascending angles in degrees of measured values, with linear interpolation between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axis<'a>(&'a [f32]);

/// Weights of linear interpolation: `1 - t` for the value at index `below`, `t` for the one at
/// index `above`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Between {
    pub(super) below: usize,
    pub(super) above: usize,
    pub(super) t: f32,
}

impl<'a> Axis<'a> {
    /// An axis of at least one angle; `None` if they do not ascend.
    pub(super) fn new(angles: &'a [f32]) -> Option<Self> {
        let ascend = angles.windows(2).all(|pair| pair[0] < pair[1]);
        (ascend && !angles.is_empty()).then_some(Self(angles))
    }

    /// Of ascending angles.
    #[cfg(feature = "alloc")]
    pub(super) const fn of_valid(angles: &'a [f32]) -> Self {
        Self(angles)
    }

    pub(super) const fn angles(&self) -> &'a [f32] {
        self.0
    }

    #[cfg(feature = "alloc")]
    pub(super) fn first(&self) -> f32 {
        self.0[0]
    }

    #[cfg(feature = "alloc")]
    pub(super) fn last(&self) -> f32 {
        self.0[self.0.len() - 1]
    }

    /// The interpolation at `degrees`; `None` beyond the ends, with a margin for rounding.
    pub(super) fn place(&self, degrees: f32) -> Option<Between> {
        const ROUNDING: f32 = 1e-3;
        let (&first, &end) = (self.0.first()?, self.0.last()?);
        if !(degrees >= first - ROUNDING && degrees <= end + ROUNDING) {
            return None;
        }
        let last = self.0.len() - 1;
        let above = self
            .0
            .partition_point(|&angle| angle <= degrees)
            .clamp(1.min(last), last);
        let below = above.saturating_sub(1);
        let step = self.0[above] - self.0[below];
        let t = if step > 0.0 {
            ((degrees - self.0[below]) / step).clamp(0.0, 1.0)
        } else {
            0.0
        };
        Some(Between { below, above, t })
    }
}

/// The same angle in `[0, 360)` degrees.
pub(super) fn full_turn(degrees: f32) -> f32 {
    let rest = degrees % 360.0;
    if rest < 0.0 { rest + 360.0 } else { rest }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_between_or_nowhere() {
        let axis = Axis::new(&[0.0, 10.0, 40.0]).expect("ascending");
        let at = |degrees| axis.place(degrees).map(|p| (p.below, p.above, p.t));
        assert_eq!(at(0.0), Some((0, 1, 0.0)), "the first");
        assert_eq!(at(25.0), Some((1, 2, 0.5)), "between");
        assert_eq!(at(40.0), Some((1, 2, 1.0)), "the last");
        assert_eq!(at(41.0), None, "beyond");
        assert_eq!(at(f32::NAN), None, "nowhere");
        let single = Axis::new(&[0.0]).expect("one");
        assert_eq!(single.place(0.0).map(|p| p.above), Some(0), "one angle");
        assert_eq!(Axis::new(&[1.0, 1.0]), None, "equal");
    }
}
