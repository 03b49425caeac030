use lights::sources::{TextureMapping, Wrap};

use super::item::Item;
use super::reader::Reader;
use super::texture_images::Texture;
use super::uv_sets::UvSets;
use crate::glam::{Affine2, Mat2, Vec2, Vec3};
use crate::image::{EncodedImage, Encoding};
use crate::{ColorImage, Diagnostic, Image};

impl<'a> Reader<'a> {
    /// The texture that `owner` names, if its image is of a kind that is read.
    pub(super) fn texture(
        &mut self,
        owner: &Item<'a>,
        name: &str,
        uv_sets: &mut UvSets,
    ) -> Result<Option<Texture>, Diagnostic> {
        let Some(info) = owner.get(name)? else {
            return Ok(None);
        };
        let mut uv_set = info.whole_or("texCoord", 0)?;
        let mut mapping = TextureMapping::REPEAT;
        if let Some(moved) = info.extension("KHR_texture_transform")? {
            uv_set = moved.whole_or("texCoord", uv_set)?;
            mapping.transform = texture_transform(&moved)?;
        }
        let (_, texture) = info.require("index")?.target("textures")?;
        if let Some(sampler) = texture.get("sampler")? {
            mapping.wrap = self.sampler(&sampler.target("samplers")?.1)?;
        }
        let Some(source) = texture.get("source")? else {
            self.warn(&texture, "was ignored: it has no PNG or JPEG image");
            return Ok(None);
        };
        let Some(uv_set) = uv_sets.place(uv_set) else {
            self.warn(
                &info,
                "was ignored: a material uses two sets of texture coordinates at most",
            );
            return Ok(None);
        };
        let (image, item) = source.target("images")?;
        let image = self.textures.first_alike(image, &item)?;
        if !self.textures.decoded.contains_key(&image) {
            let bytes = match item.get("uri")? {
                Some(uri) => match self.buffers.find(&uri)? {
                    Ok(bytes) => bytes,
                    Err(error) => {
                        self.warn(&uri, &format!("was left out: {error}"));
                        return Ok(None);
                    }
                },
                None => {
                    let view = self.buffers.view(&item.require("bufferView")?)?;
                    view.bytes().to_vec()
                }
            };
            // The format is also known from the bytes.
            item.get("mimeType")?;
            let path = self.document.path();
            let decoded = EncodedImage::parse(path, &bytes).and_then(|decoded| {
                self.textures.budget.take(path, decoded.size())?;
                Ok(decoded)
            });
            let decoded = decoded.map_err(|error| item.error(&error.message))?;
            self.textures.decoded.insert(image, decoded);
        }
        Ok(Some(Texture {
            uv_set,
            mapping,
            image,
        }))
    }

    /// The sampler: the rule beyond the edges of an image. All sampling is bilinear.
    fn sampler(&mut self, sampler: &Item<'a>) -> Result<[Wrap; 2], Diagnostic> {
        const LINEAR: usize = 9729;
        if let Some(filter) = sampler.get("magFilter")? {
            if filter.whole()? != LINEAR {
                self.warn(&filter, "was ignored: images are smooth");
            }
        }
        Ok([wrap(sampler, "wrapS")?, wrap(sampler, "wrapT")?])
    }

    /// The image of a texture as linear colours times `scale`.
    pub(super) fn color_image(&mut self, texture: Texture, scale: Vec3) -> ColorImage {
        let (textures, scene) = (&mut self.textures, &mut self.scene);
        let decoded = &textures.decoded[&texture.image];
        let known = textures.colors.entry(texture.image);
        let image = *known.or_insert_with(|| scene.add_image(decoded.color(Encoding::Srgb)));
        texture.shown(image, scale)
    }

    /// How opaque the image of a texture is, alike in all channels, times `scale`; `None` if it is
    /// so everywhere.
    pub(super) fn alpha_image(&mut self, texture: Texture, scale: Vec3) -> Option<ColorImage> {
        let (textures, scene) = (&mut self.textures, &mut self.scene);
        let decoded = &textures.decoded[&texture.image];
        let known = textures.alphas.entry(texture.image);
        let add = |image: Image| scene.add_image(image);
        let image = *known.or_insert_with(|| decoded.alpha().map(add));
        image.map(|image| texture.shown(image, scale))
    }

    /// The image of a texture whose channels stand for themselves, times `scale`.
    pub(super) fn data_image(&mut self, texture: Texture, scale: Vec3) -> ColorImage {
        let (textures, scene) = (&mut self.textures, &mut self.scene);
        let decoded = &textures.decoded[&texture.image];
        let known = textures.data.entry(texture.image);
        let image = *known.or_insert_with(|| scene.add_image(decoded.color(Encoding::Linear)));
        texture.shown(image, scale)
    }
}

/// From our texture coordinates, of which (0, 0) is the lower left corner, to the moved ones.
///
/// The extension's own have (0, 0) in the upper left corner; a positive angle turns u away from v.
fn texture_transform(moved: &Item<'_>) -> Result<Affine2, Diagnostic> {
    let offset = Vec2::from(moved.numbers_or("offset", [0.0; 2])?);
    let angle = moved.number_or("rotation", 0.0)?;
    let scale = Vec2::from(moved.numbers_or("scale", [1.0; 2])?);
    let moved = Affine2::from_scale_angle_translation(scale, -angle, offset);
    let flip = Affine2::from_mat2_translation(Mat2::from_diagonal(Vec2::new(1.0, -1.0)), Vec2::Y);
    Ok(flip * moved * flip)
}

/// The rule beyond two edges of an image.
fn wrap(sampler: &Item<'_>, name: &str) -> Result<Wrap, Diagnostic> {
    let Some(mode) = sampler.get(name)? else {
        return Ok(Wrap::Repeat);
    };
    match mode.whole()? {
        10497 => Ok(Wrap::Repeat),
        33071 => Ok(Wrap::Clamp),
        33648 => Ok(Wrap::Mirror),
        _ => Err(mode.expected("10497 (repeat), 33071 (clamp) or 33648 (mirror)")),
    }
}
