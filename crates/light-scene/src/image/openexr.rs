//! OpenEXR.

use std::io::Cursor;
use std::path::Path;

use exr::meta::header::Header;
use exr::prelude::{
    Encoding, Error, FlatSamples, IntoSample, Layer, LayerAttributes, MetaData, ReadChannels,
    ReadLayers, SpecificChannels, Text, Vec2, WritableImage, f16, read,
};

use super::broken_texels::BrokenTexels;
use super::checked::checked;
use super::cut_off::in_words;
use super::{Image, ImageFile, primaries};
use crate::glam::Vec3;
use crate::{Diagnostic, write_atomically};

/// More texels than this are refused: 16384 by 8192 is the largest environment map that is sold.
const MAX_TEXELS: usize = 1 << 27;

/// The largest compression ratio: that of deflate, above all other methods.
const MOST_EXPANDED: usize = 1032;

/// The image in the bytes of an OpenEXR file: the channels R, G and B of the first part that has
/// them, or Y alone of the first, of half or float samples, with a warning where the data window is
/// not the display window. Chromaticities that the file states are honoured: the image is of Rec.
/// 709.
///
/// `path` names the file in messages.
///
/// # Errors
/// As for [`read_image`](crate::read_image).
pub fn parse_exr(path: &Path, bytes: &[u8]) -> Result<ImageFile, Diagnostic> {
    parse_exr_with(path, bytes, BrokenTexels::Refuse)
}

/// As [`parse_exr`], with texels that are not finite as `broken` says.
pub(super) fn parse_exr_with(
    path: &Path,
    bytes: &[u8],
    broken: BrokenTexels,
) -> Result<ImageFile, Diagnostic> {
    let refuse = |error: Error| Diagnostic::file(path, message(&error));
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(refuse)?;
    let mut flat = meta.headers.iter().filter(|header| !header.deep);
    let first = flat.clone().next();
    let first =
        first.ok_or_else(|| Diagnostic::file(path, "expected an image, found deep data only"))?;
    // Other parts may come before, as depth.
    let header = if has(first, "Y") {
        first
    } else {
        flat.find(|part| has_color(part)).unwrap_or(first)
    };
    let [width, height] = [header.layer_size.0, header.layer_size.1];
    if width.checked_mul(height).is_none_or(|n| n > MAX_TEXELS) {
        let message = format!("expected at most {MAX_TEXELS} texels, found {width} x {height}");
        return Err(Diagnostic::file(path, message));
    }
    let claimed = width * height * header.channels.bytes_per_pixel;
    if claimed > bytes.len().saturating_mul(MOST_EXPANDED) {
        let count = bytes.len();
        let message =
            format!("expected the texels of {width} x {height}, found {count} bytes in all");
        return Err(Diagnostic::file(path, message));
    }
    let names: Vec<_> = header
        .channels
        .list
        .iter()
        .map(|c| c.name.to_string())
        .collect();
    let has = |name: &str| has(header, name);
    let wanted = if has_color(header) {
        ["R", "G", "B"]
    } else if has("Y") && (has("RY") || has("BY")) {
        // Y alone would be a grey picture of a coloured one.
        let message = format!(
            "expected channels R, G and B, or Y without chroma, found {}",
            names.join(", ")
        );
        return Err(Diagnostic::file(path, message));
    } else if has("Y") {
        ["Y"; 3]
    } else {
        let message = format!("expected channels R, G and B, found {}", names.join(", "));
        return Err(Diagnostic::file(path, message));
    };
    let mut texels = decode(bytes, wanted).map_err(refuse)?;
    if texels.len() != width * height {
        return Err(Diagnostic::file(path, "expected all of the image's rows"));
    }
    let chromaticities = header.shared_attributes.chromaticities;
    if let Some(matrix) = chromaticities.and_then(|file| primaries::to_rec_709(&file)) {
        if wanted[0] != wanted[1] {
            primaries::convert(&mut texels, &matrix);
        }
    }
    let mut file = checked(path, [width, height], texels, broken)?;
    if let Some(mut message) = doubt_of_windows(header) {
        if let Some(warning) = file.warning {
            message = format!("{message}; {}", warning.message);
        }
        file.warning = Some(Diagnostic::file(path, message));
    }
    Ok(file)
}

/// Whether a part has a channel.
fn has(part: &Header, name: &str) -> bool {
    part.channels
        .list
        .iter()
        .any(|channel| channel.name == *name)
}

fn has_color(part: &Header) -> bool {
    ["R", "G", "B"].into_iter().all(|name| has(part, name))
}

/// What is said of an image that has more or fewer pixels than are to be shown.
fn doubt_of_windows(part: &Header) -> Option<String> {
    let shown = part.shared_attributes.display_window;
    let position = part.own_attributes.layer_position;
    let (data, size) = (part.layer_size, shown.size);
    (size != data || shown.position != position).then(|| {
        format!(
            "all {} x {} pixels of the data window at ({}, {}) were taken, not the {} x {} of the \
             display window at ({}, {})",
            data.0,
            data.1,
            position.0,
            position.1,
            size.0,
            size.1,
            shown.position.0,
            shown.position.1
        )
    })
}

/// The texels of the first layer that has the wanted channels.
fn decode(bytes: &[u8], wanted: [&str; 3]) -> Result<Vec<Vec3>, Error> {
    if wanted[0] == wanted[1] {
        return decode_grey(bytes);
    }
    type Rows = (usize, Vec<[f32; 3]>);
    let reader = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size, _| (size.0, vec![[0.0; 3]; size.0 * size.1]),
            |(width, texels): &mut Rows, at, (r, g, b): (f32, f32, f32)| {
                texels[at.1 * *width + at.0] = [r, g, b];
            },
        )
        .first_valid_layer()
        .all_attributes();
    let image = reader.from_buffered(Cursor::new(bytes))?;
    let (_, texels) = image.layer_data.channel_data.pixels;
    Ok(texels.into_iter().map(Vec3::from).collect())
}

/// The texels of channel Y of the first layer, alike in all three channels.
fn decode_grey(bytes: &[u8]) -> Result<Vec<Vec3>, Error> {
    let reader = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes();
    let image = reader.from_buffered(Cursor::new(bytes))?;
    let channels = image.layer_data.channel_data.list;
    let grey = channels.into_iter().find(|channel| channel.name == *"Y");
    let grey = grey.ok_or(Error::Invalid("channel Y is missing".into()))?;
    Ok(match grey.sample_data {
        FlatSamples::F16(samples) => samples.iter().map(|y| Vec3::splat(y.to_f32())).collect(),
        FlatSamples::F32(samples) => samples.into_iter().map(Vec3::splat).collect(),
        FlatSamples::U32(_) => return Err(Error::Invalid("channel Y holds integers".into())),
    })
}

/// Writes a float32 linear RGB OpenEXR file, compressed without loss; the same image gives the same
/// bytes.
///
/// # Errors
/// When the file cannot be written; nothing is left behind then.
pub fn write_exr(path: &Path, image: &Image) -> Result<(), Diagnostic> {
    write(path, image, |texel| texel.to_array())
}

/// Writes an OpenEXR file of half floats, half the size: numbers keep 11 bits, those above 65504
/// become that.
///
/// # Errors
/// When the file cannot be written; nothing is left behind then.
pub fn write_exr_half(path: &Path, image: &Image) -> Result<(), Diagnostic> {
    let half = |x: f32| f16::from_f32(x.min(f16::MAX.to_f32()));
    write(path, image, |texel| texel.to_array().map(half))
}

fn write<T: IntoSample>(
    path: &Path,
    image: &Image,
    sample: impl Fn(Vec3) -> [T; 3] + Sync,
) -> Result<(), Diagnostic> {
    let size = Vec2(image.width() as usize, image.height() as usize);
    let texels = image.texels();
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| {
        let [r, g, b] = sample(texels[at.1 * size.0 + at.0]);
        (r, g, b)
    });
    let attributes = LayerAttributes {
        software_name: Some(Text::from("lights")),
        ..LayerAttributes::default()
    };
    let layer = Layer::new(size, attributes, Encoding::SMALL_FAST_LOSSLESS, channels);
    let mut bytes = Cursor::new(Vec::new());
    // One thread, so that blocks come in the same order every time.
    let written = exr::prelude::Image::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut bytes);
    written.map_err(|error| Diagnostic::file(path, message(&error)))?;
    write_atomically(path, bytes.get_ref())
}

pub(super) fn message(error: &Error) -> String {
    match error {
        Error::NotSupported(what) => format!("this kind of OpenEXR file is not supported: {what}"),
        Error::Invalid(what) => format!("expected an OpenEXR file: {}", in_words(what)),
        other => format!("expected an OpenEXR file: {}", in_words(other)),
    }
}
