use std::path::PathBuf;

use crate::Image;
use crate::glam::Vec3;
use crate::image::Encoding;

/// A file of texels and what is made of them: the key under which an image is stored
/// once.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct ImageKey {
    pub(super) path: PathBuf,
    pub(super) encoding: String,
    /// Whether all channels are their mean.
    pub(super) gray: bool,
    /// The bits of the factor before texels are taken from 1.
    pub(super) inverted: Option<u32>,
}

impl ImageKey {
    /// The colours of a file with its own encoding.
    pub(super) fn colors(path: PathBuf) -> Self {
        Self {
            path,
            encoding: "sRGB".to_owned(),
            gray: false,
            inverted: None,
        }
    }

    pub(super) fn encoding(&self) -> Option<Encoding> {
        match self.encoding.split_whitespace().collect::<Vec<_>>()[..] {
            ["sRGB"] => Some(Encoding::Srgb),
            ["linear"] => Some(Encoding::Linear),
            ["gamma", power] => {
                let power = power.parse().ok().filter(|power: &f32| *power > 0.0);
                power.map(Encoding::Gamma)
            }
            _ => None,
        }
    }

    pub(super) fn change(&self, image: Image) -> Image {
        let texel = |texel: Vec3| {
            let gray = Vec3::splat(texel.element_sum() / 3.0);
            let texel = if self.gray { gray } else { texel };
            self.inverted.map_or(texel, |factor| {
                (1.0 - f32::from_bits(factor) * texel).max(Vec3::ZERO)
            })
        };
        let (width, height) = (image.width(), image.height());
        let texels = image.into_texels().into_iter().map(texel).collect();
        Image::new(width, height, texels).expect("as many texels as before")
    }
}
