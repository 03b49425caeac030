use alloc::sync::Arc;

use crate::image::Image;
use crate::texture_means::TextureMeans;

/// An image on a surface that shines, with the means of its parts: how bright each triangle is follows from the texels that
/// it covers.
///
/// It is a third larger than the image, and shared: a clone costs a counter, however many meshes it lies on.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture(Arc<TextureMeans>);

impl Texture {
    /// The texture that shows `image`.
    #[must_use]
    pub fn new(image: Image) -> Self {
        Self(Arc::new(TextureMeans::new(image)))
    }

    /// What it shows.
    #[must_use]
    pub fn image(&self) -> &Image {
        self.0.image()
    }

    /// Bytes that clones share: the image and its means.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.0.bytes()
    }

    pub(crate) const fn means(&self) -> &Arc<TextureMeans> {
        &self.0
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for Texture {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // The means follow from the image.
        self.image().serialize(serializer)
    }
}

impl From<Image> for Texture {
    fn from(image: Image) -> Self {
        Self::new(image)
    }
}
