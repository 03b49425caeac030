/// Which child of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The child that follows its parent.
    First,
    /// The other one.
    Second,
}

/// The way from the root to a light's leaf, in 4 bytes: one bit a level from the lowest bit up, 1
/// for the second child.
///
/// The bit above the last one of the way is set too, which says where the way ends.
/// [`NONE`](Self::NONE) is the trail of lights that are not in the tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(transparent)]
pub struct BitTrail(u32);

impl BitTrail {
    /// The longest way that fits: a tree is never deeper.
    pub const MAX_DEPTH: u32 = u32::BITS - 1;

    /// The trail of a light that is not in the tree.
    pub const NONE: Self = Self(0);

    /// The trail of a root that is a leaf.
    pub const ROOT: Self = Self(1);

    /// The trail one level further down; `None` if it does not fit, or if `self` is
    /// [`NONE`](Self::NONE).
    #[must_use]
    pub fn then(self, side: Side) -> Option<Self> {
        let depth = self.depth()?;
        if depth == Self::MAX_DEPTH {
            return None;
        }
        let mark = 1 << depth;
        Some(Self(match side {
            Side::First => self.0 + mark,
            Side::Second => self.0 + (mark << 1),
        }))
    }

    /// Number of levels below the root; `None` for [`NONE`](Self::NONE).
    #[inline]
    #[must_use]
    pub const fn depth(self) -> Option<u32> {
        self.0.checked_ilog2()
    }

    /// The way itself: bit `d` is 1 where the second child is taken at depth `d`.
    #[inline]
    #[must_use]
    pub fn bits(self) -> u32 {
        self.depth().map_or(0, |depth| self.0 - (1 << depth))
    }

    /// The children to take, from the root down; nothing for [`NONE`](Self::NONE).
    #[inline]
    pub fn sides(self) -> impl Iterator<Item = Side> {
        let mut rest = self.0;
        core::iter::from_fn(move || {
            if rest <= 1 {
                return None;
            }
            let side = if rest & 1 == 0 {
                Side::First
            } else {
                Side::Second
            };
            rest >>= 1;
            Some(side)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn ends() {
        assert_eq!(BitTrail::NONE.depth(), None, "leads nowhere");
        assert_eq!(BitTrail::NONE.then(Side::First), None, "nor further");
        assert_eq!(BitTrail::ROOT.depth(), Some(0), "the root itself");
        assert_eq!(BitTrail::ROOT.sides().count(), 0, "no level");
    }

    #[test]
    fn the_longest_trail_ends() {
        let longest =
            (0..BitTrail::MAX_DEPTH).try_fold(BitTrail::ROOT, |t, _| t.then(Side::Second));
        let longest = longest.expect("as many levels fit");
        assert_eq!(longest.depth(), Some(BitTrail::MAX_DEPTH), "all of them");
        assert_eq!(longest.then(Side::First), None, "no more");
    }

    proptest! {
        #[test]
        fn a_trail_repeats_the_way(way in prop::collection::vec(any::<bool>(), 0..=31)) {
            let sides = way.iter().map(|&b| if b { Side::Second } else { Side::First });
            let trail = sides.clone().try_fold(BitTrail::ROOT, BitTrail::then).expect("fits");
            prop_assert_eq!(trail.depth().map(|d| d as usize), Some(way.len()));
            prop_assert!(trail.sides().eq(sides));
            for (d, second) in way.into_iter().enumerate() {
                prop_assert_eq!(trail.bits() >> d & 1 == 1, second);
            }
        }
    }
}
