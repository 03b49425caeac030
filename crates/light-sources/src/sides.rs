use crate::glam::Vec3;

/// Which sides of a surface emit. The front is the side to which the geometric normal points: for a triangle the one
/// from which its vertices run counter-clockwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Sides {
    /// The front alone.
    #[default]
    Front,
    /// The back alone.
    Back,
    /// Front and back alike.
    Both,
}

impl Sides {
    /// How many sides emit, 1 or 2.
    #[must_use]
    pub const fn count(self) -> f32 {
        match self {
            Self::Front | Self::Back => 1.0,
            Self::Both => 2.0,
        }
    }

    /// Whether a surface with normal `n` emits toward `w`.
    #[must_use]
    pub fn emit_toward(self, n: Vec3, w: Vec3) -> bool {
        match self {
            Self::Front => n.dot(w) > 0.0,
            Self::Back => n.dot(w) < 0.0,
            Self::Both => true,
        }
    }

    /// The normal on the side that emits, for the geometric normal `n`; `n` itself when both do.
    #[must_use]
    pub fn emitting_normal(self, n: Vec3) -> Vec3 {
        match self {
            Self::Front | Self::Both => n,
            Self::Back => -n,
        }
    }
}
