use core::ops::BitOr;

/// A set of up to 32 light groups: those of a light, or those that a context is limited to.
///
/// Groups link lights to objects, and split a picture by lights. A light belongs to any number of
/// groups; a context reaches the lights of which at least one group is among its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(transparent)]
pub struct LightGroups(pub u32);

impl LightGroups {
    /// No group: such a light is chosen only for contexts of [all](Self::ALL) lights.
    pub const NONE: Self = Self(0);

    /// All groups, and lights without any: the default of a context.
    pub const ALL: Self = Self(u32::MAX);

    /// The one group of number `index`; none for numbers from 31 on.
    ///
    /// Thirty-one groups have numbers: a set of all of them differs from [`ALL`](Self::ALL).
    #[must_use]
    pub const fn of(index: u32) -> Self {
        if index < 31 {
            Self(1 << index)
        } else {
            Self::NONE
        }
    }

    /// Whether a light of these groups is among those that a context `wanted`.
    #[inline]
    #[must_use]
    pub const fn is_wanted(self, wanted: Self) -> bool {
        wanted.0 == Self::ALL.0 || self.0 & wanted.0 != 0
    }
}

/// A light is in all groups by default.
impl Default for LightGroups {
    fn default() -> Self {
        Self::ALL
    }
}

/// The groups of either.
impl BitOr for LightGroups {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_light_is_wanted_for_one_of_its_groups() {
        let (a, b, c) = (LightGroups::of(0), LightGroups::of(1), LightGroups::of(30));
        assert!((a | b).is_wanted(b | c), "in common");
        assert!(!(a | b).is_wanted(c), "nothing in common");
        assert_eq!((a | b) | (b | c), a | b | c, "a group twice is a group");
        assert!(!LightGroups::NONE.is_wanted(a | b | c), "in no group");
        assert!(LightGroups::NONE.is_wanted(LightGroups::ALL), "all lights");
        assert!(LightGroups::ALL.is_wanted(c), "in every group");
        assert_eq!(LightGroups::default(), LightGroups::ALL, "if none is named");
        assert!(!a.is_wanted(LightGroups::NONE), "none wanted");
        assert_eq!(LightGroups::of(31), LightGroups::NONE, "no such group");
    }
}
