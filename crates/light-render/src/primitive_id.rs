/// Which primitive a ray met: the number under which it is stored and, for what stands in several
/// places, in which of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PrimitiveId {
    number: u32,
    /// `NOWHERE_ELSE` for what stands where it is stored.
    placement: u32,
}

const NOWHERE_ELSE: u32 = u32::MAX;

impl PrimitiveId {
    /// A primitive that stands where it is stored.
    #[inline]
    #[must_use]
    pub const fn new(number: u32) -> Self {
        Self {
            number,
            placement: NOWHERE_ELSE,
        }
    }

    /// A primitive of a prototype in one of its places.
    #[inline]
    #[must_use]
    pub(crate) const fn placed(number: u32, placement: u32) -> Self {
        Self { number, placement }
    }

    /// Its number among the stored primitives; those of different placements share it.
    #[inline]
    #[must_use]
    pub const fn number(self) -> u32 {
        self.number
    }

    /// The number of its placement; `None` for what stands where it is stored.
    #[inline]
    #[must_use]
    pub const fn placement(self) -> Option<u32> {
        if self.placement == NOWHERE_ELSE {
            None
        } else {
            Some(self.placement)
        }
    }
}
