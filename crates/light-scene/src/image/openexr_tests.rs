//! Files of other programs: several parts, and pixels that are not to be shown.

use std::io::Cursor;
use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds, Layer,
    LayerAttributes, Layers, Vec2, WritableImage,
};

use super::{ImageFile, parse_exr};
use crate::glam::Vec3;

/// A part of 4 x 2 pixels at `position`, all alike: names of channels and their values.
fn part(
    name: &str,
    position: Vec2<i32>,
    channels: &[(&str, f32)],
) -> Layer<AnyChannels<FlatSamples>> {
    let channels = channels
        .iter()
        .map(|&(name, value)| AnyChannel::new(name, FlatSamples::F32(vec![value; 8])));
    let attributes = LayerAttributes {
        layer_position: position,
        ..LayerAttributes::named(name)
    };
    let channels = AnyChannels::sort(channels.collect());
    Layer::new((4, 2), attributes, Encoding::UNCOMPRESSED, channels)
}

/// An image of these parts with this display window.
fn read(
    window: IntegerBounds,
    parts: Vec<Layer<AnyChannels<FlatSamples>>>,
) -> Result<ImageFile, String> {
    let parts: Layers<AnyChannels<FlatSamples>> = parts.into_iter().collect();
    let image = Image::new(ImageAttributes::new(window), parts);
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).expect("written");
    parse_exr(Path::new("a.exr"), bytes.get_ref()).map_err(|error| error.to_string())
}

const COLOR: [(&str, f32); 3] = [("R", 0.1), ("G", 0.2), ("B", 0.3)];

#[test]
fn colour_may_come_in_a_later_part() {
    let window = IntegerBounds::new((0, 0), (4, 2));
    let of = |channels: &[(&str, f32)]| part("first", Vec2(0, 0), channels);
    let color = || part("second", Vec2(0, 0), &COLOR);
    let behind_depth = read(window, vec![of(&[("Z", 9.0)]), color()]).expect("an image");
    assert_eq!(
        behind_depth.image.texel(3, 1),
        Vec3::new(0.1, 0.2, 0.3),
        "depth"
    );
    let behind_grey = read(window, vec![of(&[("Y", 0.5)]), color()]).expect("an image");
    assert_eq!(
        behind_grey.image.texel(3, 1),
        Vec3::splat(0.5),
        "the first image"
    );
    let none = read(window, vec![of(&[("Z", 9.0)])]).expect_err("no colour");
    assert_eq!(
        none, "a.exr: expected channels R, G and B, found Z",
        "depth alone"
    );
}

#[test]
fn pixels_that_are_not_shown_are_named() {
    let warning = |window, position| {
        let file = read(window, vec![part("a", position, &COLOR)]).expect("an image");
        assert_eq!(
            [file.image.width(), file.image.height()],
            [4, 2],
            "all pixels"
        );
        file.warning.map(|warning| warning.to_string())
    };
    let same = IntegerBounds::new((5, 6), (4, 2));
    assert_eq!(warning(same, Vec2(5, 6)), None, "the same");
    let larger = IntegerBounds::new((0, 0), (8, 4));
    let expected = "a.exr: all 4 x 2 pixels of the data window at (2, 1) were taken, not the 8 x 4 \
                    of the display window at (0, 0)";
    assert_eq!(
        warning(larger, Vec2(2, 1)),
        Some(expected.to_owned()),
        "a part"
    );
}
