//! Images in memory and in files.

mod broken_texels;
mod channels;
mod checked;
mod cut_off;
mod display;
mod encoded;
mod file;
mod image_file;
mod openexr;
mod pfm;
mod primaries;
mod radiance;
mod rgb_image;
mod srgb;
mod texel_budget;

pub use channels::ChannelFile;
pub use display::{encode_png, write_png};
pub(crate) use encoded::{EncodedImage, Encoding};
pub(crate) use file::{
    IMAGE_ENDINGS, expect_image_name, is_image_name, parse_encoded, parse_opacity,
    read_environment_from,
};
pub use file::{parse_image, read_environment, read_image, read_signed_image, write_image};
pub use image_file::ImageFile;
pub use openexr::{parse_exr, write_exr, write_exr_half};
pub(crate) use radiance::write_hdr;
pub use rgb_image::{Image, ImageError};
pub(crate) use texel_budget::TexelBudget;

#[cfg(test)]
mod openexr_tests;
#[cfg(test)]
pub(crate) mod tests;
