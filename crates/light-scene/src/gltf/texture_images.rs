use std::collections::HashMap;

use lights::sources::TextureMapping;

use super::item::Item;
use crate::glam::Vec3;
use crate::image::{EncodedImage, TexelBudget};
use crate::{ColorImage, Diagnostic, ImageId, UvSet};

/// The images of a document, each decoded and kept once.
#[derive(Debug, Default)]
pub(super) struct Textures {
    pub(super) decoded: HashMap<usize, EncodedImage>,
    pub(super) budget: TexelBudget,
    pub(super) colors: HashMap<usize, ImageId>,
    pub(super) alphas: HashMap<usize, Option<ImageId>>,
    /// Channels that stand for themselves.
    pub(super) data: HashMap<usize, ImageId>,
    /// The first image of each source: lists may name the same one over and over.
    pub(super) by_source: HashMap<String, usize>,
}

impl Textures {
    /// The first image that has the same source.
    pub(super) fn first_alike(
        &mut self,
        image: usize,
        item: &Item<'_>,
    ) -> Result<usize, Diagnostic> {
        let source = match item.get("uri")? {
            Some(uri) => uri.text()?.to_owned(),
            // No file name contains a line break.
            None => format!("\n{}", item.require("bufferView")?.whole()?),
        };
        Ok(*self.by_source.entry(source).or_insert(image))
    }
}

/// A texture that a material names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Texture {
    /// Which of the mesh's texture coordinates.
    pub(super) uv_set: UvSet,
    pub(super) mapping: TextureMapping,
    /// Index in the document's list of images.
    pub(super) image: usize,
}

impl Texture {
    /// The image with the mapping of this texture, times `scale`.
    pub(super) fn shown(&self, image: ImageId, scale: Vec3) -> ColorImage {
        ColorImage {
            image,
            scale,
            mapping: self.mapping,
            uv_set: self.uv_set,
        }
    }
}
