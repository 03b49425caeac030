use std::collections::HashMap;

use crate::Color;

/// The textures so far: numbers and colours have names of their own.
pub(super) type Textures = HashMap<(TextureKind, String), NamedTexture>;

/// A texture that a file has named.
#[derive(Clone, Copy, Debug)]
pub(super) struct NamedTexture {
    pub(super) color: Color,
    /// Whether it is grey because it, or one that it is made of, was not read.
    pub(super) is_stand_in: bool,
}

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
