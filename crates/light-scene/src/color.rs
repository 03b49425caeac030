use lights::sources::TextureMapping;

use crate::ImageId;
use crate::glam::Vec3;

/// A colour over a surface: linear RGB, one value or an image.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub enum Color {
    /// The same everywhere.
    Constant(Vec3),
    /// From an image, by the mesh's texture coordinates.
    Image(ColorImage),
}

/// An image over texture coordinates, times a factor.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ColorImage {
    /// The image.
    pub image: ImageId,
    /// Multiplies every texel.
    pub scale: Vec3,
    /// From texture coordinates to the image, with the rule beyond its edges.
    pub mapping: TextureMapping,
    /// Which texture coordinates of the mesh. Emission, and the alpha mask of a surface that emits,
    /// always use the first.
    pub uv_set: UvSet,
}

/// One of the texture coordinates of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub enum UvSet {
    /// [`Mesh::uvs`](crate::Mesh::uvs).
    #[default]
    First,
    /// [`Mesh::second_uvs`](crate::Mesh::second_uvs).
    Second,
}

impl ColorImage {
    /// The image without scaling, repeated.
    #[must_use]
    pub const fn new(image: ImageId) -> Self {
        Self {
            image,
            scale: Vec3::ONE,
            mapping: TextureMapping::REPEAT,
            uv_set: UvSet::First,
        }
    }
}
