use std::collections::HashMap;

use crate::Color;

/// The textures so far: numbers and colours have names of their own.
pub(super) type Textures = HashMap<(TextureKind, String), Color>;

/// The value type of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum TextureKind {
    /// A number: of a colour the first channel counts.
    Float,
    Spectrum,
}

impl TextureKind {
    pub(super) const fn other(self) -> Self {
        match self {
            Self::Float => Self::Spectrum,
            Self::Spectrum => Self::Float,
        }
    }
}
