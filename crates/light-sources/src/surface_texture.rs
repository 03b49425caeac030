use alloc::sync::Arc;

use crate::block_means::BlockMeans;
use crate::color::ColorModel;
use crate::diffuse_emission_desc::{DiffuseEmissionDesc, EmissionMask, SurfaceColor};
use crate::floor::floor;
use crate::glam::{Vec2, Vec3};
use crate::shape::Shape;
use crate::texel_cells::Shown;
use crate::texture::Texture;
use crate::texture_integral;
use crate::texture_mapping::{TextureMapping, Wrap};

/// What varies over a surface that shines: an image, an alpha mask, or their product.
#[derive(Clone, Debug)]
pub(crate) struct SurfaceTexture {
    image: Texture,
    /// The mask of the image, and the means of both together.
    masked: Option<(Texture, Arc<BlockMeans>)>,
    mapping: TextureMapping,
}

/// Which part of an image a triangle shows, in steps as small as single precision makes them:
/// triangles with the same footprint have the same mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Footprint(pub(crate) [i64; 7]);

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

    /// The part of the image that a triangle with these surface parameters shows, moved to where
    /// the image repeats itself.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        reason = "saturates, where places have no fraction"
    )]
    pub(crate) fn footprint(&self, uvs: [Vec2; 3]) -> Footprint {
        let places = uvs.map(|uv| self.mapping.place(uv).as_dvec2());
        let [a, b, c] = places;
        let farthest = [a, b, c].map(|p| p.abs().max_element());
        let farthest = farthest.into_iter().fold(1.0, f64::max);
        // A few roundings of the largest number, as a power of two.
        let exponent = u64::from((farthest as f32).to_bits() >> 23) - 127;
        let steps = f64::from_bits((1023 + 21 - exponent) << 52);
        let low = a.min(b).min(c);
        let mut numbers = [exponent as i64; 7];
        for (i, number) in numbers[1..].iter_mut().enumerate() {
            let axis = i % 2;
            let origin = match self.mapping.wrap[axis] {
                // Numbers near a whole one go the same way.
                Wrap::Repeat => floor(low[axis] + 0.25),
                Wrap::Mirror => 2.0 * floor(0.5 * low[axis] + 0.25),
                Wrap::Clamp | Wrap::Black => 0.0,
            };
            *number = floor((places[i / 2][axis] - origin) * steps + 0.5) as i64;
        }
        Footprint(numbers)
    }

    /// The textures, and the means that belong to none of them.
    pub(crate) fn parts(&self) -> (impl Iterator<Item = &Texture>, Option<&Arc<BlockMeans>>) {
        let masked = self.masked.as_ref();
        let alpha = masked.map(|(alpha, _)| alpha);
        let product = masked.map(|(_, product)| product);
        (core::iter::once(&self.image).chain(alpha), product)
    }
}
