use std::collections::HashMap;

use super::item::Item;
use super::reader::Reader;
use crate::glam::Vec3;
use crate::image::EncodedImage;
use crate::{Diagnostic, Image, ImageId};

/// The images of a document, each decoded and kept once.
#[derive(Debug, Default)]
pub(super) struct Textures {
    decoded: HashMap<usize, EncodedImage>,
    colors: HashMap<usize, ImageId>,
    alphas: HashMap<usize, Option<ImageId>>,
}

/// A texture that a material names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Texture {
    /// Which of the mesh's texture coordinates.
    pub(super) uv_set: usize,
    /// Place in the document's list of images.
    image: usize,
}

impl<'a> Reader<'a> {
    /// The texture that `owner` names, if its image is of a kind that is read.
    pub(super) fn texture(
        &mut self,
        owner: &Item<'a>,
        name: &str,
    ) -> Result<Option<Texture>, Diagnostic> {
        let Some(info) = owner.get(name)? else {
            return Ok(None);
        };
        let uv_set = info.whole_or("texCoord", 0)?;
        let (_, texture) = info.require("index")?.target("textures")?;
        if let Some(sampler) = texture.get("sampler")? {
            self.sampler(&sampler.target("samplers")?.1)?;
        }
        let Some(source) = texture.get("source")? else {
            self.warn(&texture, "was ignored: it has no PNG or JPEG image");
            return Ok(None);
        };
        let (image, item) = source.target("images")?;
        if !self.textures.decoded.contains_key(&image) {
            let bytes = match item.get("uri")? {
                Some(uri) => self.buffers.load(&uri)?,
                None => {
                    let view = self.buffers.view(&item.require("bufferView")?)?;
                    view.bytes().to_vec()
                }
            };
            // The bytes themselves say it too.
            item.get("mimeType")?;
            let decoded = EncodedImage::parse(self.document.path(), &bytes);
            let decoded = decoded.map_err(|error| item.error(&error.message))?;
            self.textures.decoded.insert(image, decoded);
        }
        Ok(Some(Texture { uv_set, image }))
    }

    /// Images repeat, and are smooth between texels.
    fn sampler(&mut self, sampler: &Item<'a>) -> Result<(), Diagnostic> {
        const REPEAT: usize = 10497;
        const LINEAR: usize = 9729;
        for (name, taken, message) in [
            ("wrapS", REPEAT, "was ignored: images repeat"),
            ("wrapT", REPEAT, "was ignored: images repeat"),
            ("magFilter", LINEAR, "was ignored: images are smooth"),
        ] {
            let Some(member) = sampler.get(name)? else {
                continue;
            };
            if member.whole()? != taken {
                self.warn(&member, message);
            }
        }
        Ok(())
    }

    /// The image of a texture as linear colours.
    pub(super) fn color_image(&mut self, texture: Texture) -> ImageId {
        let (textures, scene) = (&mut self.textures, &mut self.scene);
        let decoded = &textures.decoded[&texture.image];
        let known = textures.colors.entry(texture.image);
        *known.or_insert_with(|| scene.add_image(decoded.color()))
    }

    /// How opaque the image of a texture is, alike in all channels; none if it is so everywhere.
    pub(super) fn alpha_image(&mut self, texture: Texture) -> Option<ImageId> {
        let (textures, scene) = (&mut self.textures, &mut self.scene);
        let decoded = &textures.decoded[&texture.image];
        let known = textures.alphas.entry(texture.image);
        let add = |image: Image| scene.add_image(image);
        *known.or_insert_with(|| decoded.alpha().map(add))
    }

    /// The mean of an image's channels as they are written.
    pub(super) fn mean_of_data(&self, texture: Texture) -> Vec3 {
        self.textures.decoded[&texture.image].mean_of_data()
    }
}
