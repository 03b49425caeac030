use alloc::sync::Arc;

use crate::alpha_mask::MaskRule;
use crate::bilinear_cells::Shown;
use crate::block_means::BlockMeans;
use crate::color::ColorModel;
use crate::diffuse_emission_desc::{DiffuseEmissionDesc, EmissionMask, SurfaceColor};
use crate::floor::floor;
use crate::glam::{Vec2, Vec3};
use crate::image_behind::ImageBehind;
use crate::mask_share::MaskShare;
use crate::shape::{Shape, UvArea};
use crate::texture::Texture;
use crate::texture_integral;
use crate::texture_mapping::{TextureMapping, Wrap};

/// The texture of an emissive surface: an image, a mask, or their product.
#[derive(Clone, Debug)]
pub(crate) struct SurfaceTexture {
    /// Also the mask of a uniform colour, where it counts as it is.
    image: Option<Texture>,
    mask: Option<MaskLayer>,
    /// Of the image, or of the mask where there is no image.
    mapping: TextureMapping,
    /// Multiplies the mean.
    factor: f32,
}

#[derive(Clone, Debug)]
struct MaskLayer {
    texture: Texture,
    share: MaskShare,
    /// The means of the product with the image; those of the mask alone if it has a mapping of its
    /// own.
    blocks: Arc<BlockMeans>,
    own_mapping: Option<TextureMapping>,
}

/// The part of an image on a triangle, quantised to single precision: triangles with the same
/// footprint have the same mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Footprint(pub(crate) [i64; 7]);

impl SurfaceTexture {
    /// `None` without a texture.
    pub(crate) fn new<C: ColorModel>(desc: &DiffuseEmissionDesc<C>) -> Option<Self> {
        let image = match &desc.color {
            SurfaceColor::Image { texture, .. } => Some(texture),
            SurfaceColor::Uniform(_) => None,
        };
        let masked = match &desc.mask {
            EmissionMask::Alpha(mask) => mask.rule().map(|rule| (mask, rule)),
            EmissionMask::Opaque | EmissionMask::Invisible => None,
        };
        let alone = |image: &Texture, mapping, factor| Self {
            image: Some(image.clone()),
            mask: None,
            mapping,
            factor,
        };
        let Some((mask, MaskRule { share, factor })) = masked else {
            return image.map(|image| alone(image, desc.mapping, 1.0));
        };
        let mask_mapping = mask.mapping.unwrap_or(desc.mapping);
        if image.is_none() && share == MaskShare::Linear {
            return Some(alone(&mask.texture, mask_mapping, factor));
        }
        let is_apart = image.is_some() && mask_mapping != desc.mapping;
        let blocks = BlockMeans::new(&Shown {
            image: image.filter(|_| !is_apart).map(Texture::image),
            mask: Some((mask.texture.image(), share)),
            wrap: mask_mapping.wrap,
        });
        Some(Self {
            image: image.cloned(),
            mask: Some(MaskLayer {
                texture: mask.texture.clone(),
                share,
                blocks: Arc::new(blocks),
                own_mapping: is_apart.then_some(mask_mapping),
            }),
            mapping: image.map_or(mask_mapping, |_| desc.mapping),
            factor,
        })
    }

    /// The mean over the area of `shape`; above 0 if any visible texel is.
    pub(crate) fn mean(&self, shape: &impl Shape) -> Vec3 {
        self.factor * self.mean_of(&shape.uv_area())
    }

    fn mean_of(&self, area: &UvArea) -> Vec3 {
        let mapping = &self.mapping;
        let image = Shown {
            image: self.image.as_ref().map(Texture::image),
            mask: None,
            wrap: mapping.wrap,
        };
        let image_blocks = self.image.as_ref().map(Texture::blocks);
        let Some(layer) = &self.mask else {
            let mean = |blocks| texture_integral::mean(&image, blocks, mapping, None, area);
            return image_blocks.map_or(Vec3::ONE, mean);
        };
        let mask = Some((layer.texture.image(), layer.share));
        let (Some(own), Some(blocks)) = (&layer.own_mapping, image_blocks) else {
            let shown = Shown { mask, ..image };
            return texture_integral::mean(&shown, &layer.blocks, mapping, None, area);
        };
        let shown = Shown {
            image: None,
            mask,
            wrap: own.wrap,
        };
        let behind = ImageBehind {
            shown: &image,
            blocks,
            mapping,
        };
        texture_integral::mean(&shown, &layer.blocks, own, Some(behind), area)
    }

    /// The part of the image on a triangle with these surface parameters, shifted by whole periods
    /// of a repeated image.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        reason = "saturates, where places have no fraction"
    )]
    pub(crate) fn footprint(&self, uvs: [Vec2; 3]) -> Footprint {
        // Where two images lie differently, only triangles with the same parameters show the same.
        let is_apart = self
            .mask
            .as_ref()
            .is_some_and(|mask| mask.own_mapping.is_some());
        let mapping = if is_apart {
            TextureMapping::default()
        } else {
            self.mapping
        };
        let places = uvs.map(|uv| mapping.place(uv).as_dvec2());
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
            let origin = match mapping.wrap[axis] {
                // Numbers near a whole one are rounded the same way.
                Wrap::Repeat => floor(low[axis] + 0.25),
                Wrap::Mirror => 2.0 * floor(0.5 * low[axis] + 0.25),
                Wrap::Clamp | Wrap::Black => 0.0,
            };
            *number = floor((places[i / 2][axis] - origin) * steps + 0.5) as i64;
        }
        Footprint(numbers)
    }

    /// The textures, and the means that none of them contains.
    pub(crate) fn parts(&self) -> (impl Iterator<Item = &Texture>, Option<&Arc<BlockMeans>>) {
        let mask = self.mask.as_ref();
        let textures = self.image.iter().chain(mask.map(|mask| &mask.texture));
        (textures, mask.map(|mask| &mask.blocks))
    }
}
