use alloc::sync::Arc;

use crate::block_means::BlockMeans;
use crate::color::ColorModel;
use crate::diffuse_emission::{DiffuseEmissionDesc, EmissionMask, SurfaceColor};
use crate::glam::Vec3;
use crate::shape::Shape;
use crate::texel_cells::Shown;
use crate::texture::Texture;
use crate::texture_integral;
use crate::texture_mapping::TextureMapping;

/// What varies over a surface that shines: an image, an alpha mask, or their product.
#[derive(Clone, Debug)]
pub(crate) struct SurfaceTexture {
    image: Texture,
    /// The mask of the image, and the means of both together.
    masked: Option<(Texture, Arc<BlockMeans>)>,
    mapping: TextureMapping,
}

impl SurfaceTexture {
    /// `None` where nothing varies.
    pub(crate) fn new<C: ColorModel>(desc: &DiffuseEmissionDesc<C>) -> Option<Self> {
        let mapping = desc.mapping;
        let (image, alpha) = match (&desc.color, &desc.mask) {
            (SurfaceColor::Image { texture, .. }, EmissionMask::Alpha(alpha)) => {
                (texture, Some(alpha))
            }
            (SurfaceColor::Image { texture, .. }, _) => (texture, None),
            (SurfaceColor::Uniform(_), EmissionMask::Alpha(alpha)) => (alpha, None),
            (SurfaceColor::Uniform(_), _) => return None,
        };
        let product = |alpha: &Texture| {
            let blocks = BlockMeans::new(&Shown {
                image: image.image(),
                alpha: Some(alpha.image()),
                wrap: mapping.wrap,
            });
            (alpha.clone(), Arc::new(blocks))
        };
        Some(Self {
            image: image.clone(),
            masked: alpha.map(product),
            mapping,
        })
    }

    /// The mean over the area of `shape`; above 0 wherever the shape shows any light.
    pub(crate) fn mean(&self, shape: &impl Shape) -> Vec3 {
        let (alpha, blocks) = match &self.masked {
            Some((alpha, blocks)) => (Some(alpha.image()), &**blocks),
            None => (None, self.image.blocks()),
        };
        let shown = Shown {
            image: self.image.image(),
            alpha,
            wrap: self.mapping.wrap,
        };
        texture_integral::mean(&shown, blocks, &self.mapping, &shape.uv_area())
    }

    /// The textures, and the means that belong to none of them.
    pub(crate) fn parts(&self) -> (impl Iterator<Item = &Texture>, Option<&Arc<BlockMeans>>) {
        let masked = self.masked.as_ref();
        let alpha = masked.map(|(alpha, _)| alpha);
        let product = masked.map(|(_, product)| product);
        (core::iter::once(&self.image).chain(alpha), product)
    }
}
