use alloc::sync::Arc;

use crate::bilinear_cells::Shown;
use crate::block_means::BlockMeans;
use crate::glam::Vec3;
use crate::image::Image;
use crate::texture_mapping::Wrap;

/// An image of an emissive surface, with the means of its parts, from which the power of each
/// triangle follows.
///
/// It is a little larger than the image, and shared by clones.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture(Arc<Shared>);

#[derive(Clone, Debug, PartialEq)]
struct Shared {
    image: Image,
    blocks: BlockMeans,
    /// The largest value of each channel.
    brightest: Vec3,
}

impl Texture {
    /// The texture of `image`.
    #[must_use]
    pub fn new(image: Image) -> Self {
        let blocks = BlockMeans::new(&Shown {
            image: Some(&image),
            mask: None,
            wrap: [Wrap::Clamp; 2],
        });
        let brightest = image.texels().fold(Vec3::ZERO, Vec3::max);
        Self(Arc::new(Shared {
            image,
            blocks,
            brightest,
        }))
    }

    /// The image.
    #[must_use]
    pub fn image(&self) -> &Image {
        &self.0.image
    }

    /// Bytes that clones share: the image and its means.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.0.image.bytes() + self.0.blocks.bytes()
    }

    pub(crate) fn blocks(&self) -> &BlockMeans {
        &self.0.blocks
    }

    pub(crate) fn brightest(&self) -> Vec3 {
        self.0.brightest
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
