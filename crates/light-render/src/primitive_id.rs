/// Identifies a primitive: the number under which it is stored and, for a primitive of a prototype,
/// the instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PrimitiveId {
    number: u32,
    /// `WORLD` for a primitive in world space.
    instance: u32,
}

const WORLD: u32 = u32::MAX;

impl PrimitiveId {
    /// A primitive in world space.
    #[inline]
    #[must_use]
    pub const fn new(number: u32) -> Self {
        Self {
            number,
            instance: WORLD,
        }
    }

    /// A primitive of a prototype in one of its instances.
    #[inline]
    #[must_use]
    pub(crate) const fn in_instance(number: u32, instance: u32) -> Self {
        Self { number, instance }
    }

    /// Its number among the stored primitives; all instances share it.
    #[inline]
    #[must_use]
    pub const fn number(self) -> u32 {
        self.number
    }

    /// The number of its instance; `None` in world space.
    #[inline]
    #[must_use]
    pub const fn instance(self) -> Option<u32> {
        if self.instance == WORLD {
            None
        } else {
            Some(self.instance)
        }
    }
}
