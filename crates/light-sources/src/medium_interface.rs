use core::num::NonZeroU32;

/// The index of a participating medium in a list of the caller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MediumId(NonZeroU32);

impl MediumId {
    /// The medium at position `index`; `None` for the one index, `u32::MAX`, that has no id.
    #[must_use]
    pub const fn new(index: u32) -> Option<Self> {
        match index.checked_add(1) {
            None => None,
            Some(n) => match NonZeroU32::new(n) {
                None => None,
                Some(n) => Some(Self(n)),
            },
        }
    }

    /// The position in the caller's list.
    #[must_use]
    pub const fn index(self) -> u32 {
        self.0.get() - 1
    }
}

/// The media on both sides of a light's surface, 8 bytes; a light without a surface lies in
/// `outside`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MediumInterface {
    /// Behind the surface, opposite to its normal; `None` for vacuum.
    pub inside: Option<MediumId>,
    /// In front of the surface; `None` for vacuum.
    pub outside: Option<MediumId>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_keep_their_index_and_cost_nothing_extra() {
        for index in [0, 1, u32::MAX - 1] {
            assert_eq!(
                MediumId::new(index).map(MediumId::index),
                Some(index),
                "round trip"
            );
        }
        assert_eq!(MediumId::new(u32::MAX), None, "the one that has no room");
        assert_eq!(size_of::<MediumInterface>(), 8, "two niches");
    }
}
