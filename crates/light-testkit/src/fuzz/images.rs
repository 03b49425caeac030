//! Images that an input describes.

use light_sources::{Channels, EnvironmentMap, Image};

use super::input::Input;

/// An image of a few texels, many of them black.
pub(super) fn image(input: &mut Input<'_>) -> Image {
    let size = [input.below(4) + 1, input.below(4) + 1];
    let channels = if input.byte() % 2 == 0 {
        Channels::Gray
    } else {
        Channels::Rgb
    };
    texels(input, size, channels)
}

pub(super) fn square(input: &mut Input<'_>, channels: Channels) -> Image {
    let side = input.below(4) + 1;
    texels(input, [side, side], channels)
}

pub(super) fn texels(
    input: &mut Input<'_>,
    [width, height]: [usize; 2],
    channels: Channels,
) -> Image {
    let count = width * height * channels.count();
    let texel = |byte: u8| {
        if byte < 128 {
            0.0
        } else {
            f32::from(byte - 127) / 128.0
        }
    };
    let numbers: Vec<f32> = (0..count).map(|_| texel(input.byte())).collect();
    Image::from_f32([width as u32, height as u32], channels, numbers).expect("texels of light")
}

pub(super) fn environment(input: &mut Input<'_>) -> EnvironmentMap {
    match input.byte() % 2 {
        0 => EnvironmentMap::EqualArea(square(input, Channels::Rgb)),
        _ => EnvironmentMap::LatLong(image(input)),
    }
}
