use std::fs;
use std::path::Path;

use super::*;
use crate::glam::Vec3;
use crate::test_folder::TestFolder;

fn picture() -> Image {
    let texel = |i: u16| Vec3::new(f32::from(i) * 0.1, 1.0 / 3.0, f32::from(i) * 1e-4);
    Image::new(3, 2, (0..6).map(texel).collect()).expect("3 x 2")
}

/// The bytes of a PNG file.
pub(crate) fn png(image: impl Into<::image::DynamicImage>) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let written = image.into().write_to(&mut bytes, ::image::ImageFormat::Png);
    written.expect("a PNG file");
    bytes.into_inner()
}

#[test]
fn sizes_must_fit() {
    let texels = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE, Vec3::ZERO];
    let image = Image::new(3, 2, texels.clone()).expect("3 x 2");
    assert_eq!(image.texel(1, 1), Vec3::ONE, "row by row");
    assert_eq!(
        Image::new(2, 2, texels),
        Err(ImageError::TexelCount),
        "six texels are not 2 x 2"
    );
    assert_eq!(Image::new(0, 2, vec![]), Err(ImageError::Empty), "empty");
}

#[test]
fn hdr_keeps_eight_bits_of_a_wide_range() {
    let folder = TestFolder::new("hdr");
    let path = folder.path("a.hdr");
    let texels = vec![Vec3::new(1e4, 2e3, 8e3), Vec3::ZERO, Vec3::splat(1e-3)];
    let image = Image::new(3, 1, texels).expect("an image");
    write_image(&path, &image).expect("written");
    let read = read_image(&path).expect("an image").image;
    for (&a, &b) in image.texels().iter().zip(read.texels()) {
        let off = (a - b).abs().max_element();
        assert!(off <= a.max_element() / 128.0, "{a} came back as {b}");
    }
}

#[test]
fn exr_keeps_every_bit_and_writes_the_same_bytes() {
    let folder = TestFolder::new("exr");
    let (a, b) = (folder.path("a.exr"), folder.path("b.EXR"));
    write_image(&a, &picture()).expect("written");
    write_image(&b, &picture()).expect("written");
    let bytes = |path| fs::read(path).expect("a file");
    assert_eq!(bytes(&a), bytes(&b), "same image, same bytes");
    let file = read_image(&a).expect("an image");
    assert_eq!(file.image, picture(), "the same texels");
    assert_eq!(file.warning, None, "nothing repaired");
}

#[test]
fn png_is_srgb() {
    let folder = TestFolder::new("png");
    let path = folder.path("a.png");
    write_image(&path, &picture()).expect("written");
    let image = read_image(&path).expect("an image").image;
    for (read, written) in image.texels().iter().zip(picture().texels()) {
        // Half a step of 1/255 is at most 0.0045 in linear values.
        assert!(read.abs_diff_eq(*written, 0.0045), "{read} for {written}");
    }
}

#[test]
fn hdr_is_read() {
    let folder = TestFolder::new("hdr");
    let path = folder.path("a.hdr");
    let head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    let texels = [128, 64, 0, 129, 128, 0, 0, 132];
    fs::write(&path, [&head[..], &texels[..]].concat()).expect("written");
    let image = read_image(&path).expect("an image").image;
    let expected = [Vec3::new(1.0, 0.5, 0.0), Vec3::new(8.0, 0.0, 0.0)];
    assert_eq!(
        image.texels(),
        expected,
        "mantissa times 2^(exponent - 136)"
    );
}

/// Of luminance and chroma, the luminance would be a grey picture of a coloured one.
#[test]
fn luminance_with_chroma_is_no_grey_image() {
    let file = |names: &[&str]| {
        let channels = names.iter().map(|&name| (name.to_owned(), vec![0.5]));
        let file = ChannelFile {
            width: 1,
            height: 1,
            channels: channels.collect(),
            ..ChannelFile::default()
        };
        file.into_bytes(Path::new("a.exr")).expect("bytes")
    };
    let read = |names: &[&str]| parse_image(Path::new("a.exr"), &file(names));
    for names in [&["Y"][..], &["A", "Y"]] {
        let grey = read(names).expect("an image").image;
        assert_eq!(grey.texels(), [Vec3::splat(0.5)], "{names:?}");
    }
    let refused = read(&["BY", "RY", "Y"]).expect_err("chroma");
    assert!(refused.message.contains("Y without chroma"), "{refused}");
    assert!(refused.message.ends_with("found BY, RY, Y"), "{refused}");
}

/// The first line names the program that wrote the file.
#[test]
fn hdr_of_other_programs_is_read() {
    let file = |first: &str| {
        let header = format!("{first}\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n");
        [header.as_bytes(), &[128, 64, 0, 129, 0, 0, 128, 130]].concat()
    };
    let read = |first: &str| parse_image(Path::new("a.hdr"), &file(first));
    let radiance = read("#?RADIANCE").expect("an image").image;
    assert_eq!(radiance.texels()[0], Vec3::new(1.0, 0.5, 0.0), "a texel");
    for first in ["#?RGBE", "#?AUTOPANO", "#?"] {
        assert_eq!(read(first).expect(first).image, radiance, "{first}");
    }
    for (first, name) in [("RGBE", "no mark"), ("", "nothing")] {
        let refused = read(first).expect_err(name);
        assert!(refused.message.contains("signature"), "{name}: {refused}");
    }
    for cut in [b"#?RGBE".as_slice(), b"#?"] {
        assert!(parse_image(Path::new("a.hdr"), cut).is_err(), "no header");
    }
}

#[test]
fn broken_files_give_one_clear_line() {
    let folder = TestFolder::new("broken_images");
    let good = folder.path("good.exr");
    write_image(&good, &picture()).expect("written");
    let bytes = fs::read(&good).expect("a file");
    let cases = [
        (
            "a.gif",
            &b"x"[..],
            ": expected an image: .exr, .hdr, .pfm, .png, .tga or .jpg",
        ),
        ("a.exr", &b"no image"[..], ": expected an OpenEXR file: "),
        (
            "cut.exr",
            &bytes[..bytes.len() - 9],
            ": expected an OpenEXR file: ",
        ),
        (
            "a.hdr",
            &b"#?RADIANCE\n"[..],
            ": expected a Radiance HDR file: ",
        ),
        ("a.png", &b"\x89PNG"[..], ": expected a PNG file: "),
        ("a.jpg", &b"\xff\xd8\xff"[..], ": expected a JPEG file: "),
    ];
    for (name, bytes, expected) in cases {
        let path = folder.path(name);
        fs::write(&path, bytes).expect("written");
        let shown = read_image(&path).expect_err("an error").to_string();
        assert!(shown.contains(expected), "{shown}");
        assert_eq!(shown.lines().count(), 1, "{shown}");
    }
    let missing = read_image(&folder.path("missing.exr")).expect_err("an error");
    assert!(missing.message.starts_with("cannot be read: "), "{missing}");
    let error = write_image(Path::new("a.gif"), &picture()).expect_err("an error");
    assert_eq!(
        error.message, "expected an image to write: .exr, .hdr or .png",
        "ending"
    );
}

#[test]
fn exr_without_colour_channels_names_what_it_has() {
    use exr::prelude::{Image as ExrImage, SpecificChannels, Vec2, WritableImage};
    let folder = TestFolder::new("exr_channels");
    let write = |name: &str, channel: &str| {
        let channels = SpecificChannels::build().with_channel(channel);
        let channels = channels.with_pixel_fn(|at: Vec2<usize>| (at.0 as f32 - 1.0,));
        let path = folder.path(name);
        let image = ExrImage::from_channels((3, 1), channels);
        image.write().to_file(&path).expect("written");
        path
    };
    let error = read_image(&write("z.exr", "Z")).expect_err("an error");
    assert_eq!(
        error.message, "expected channels R, G and B, found Z",
        "depth"
    );
    let grey = read_image(&write("y.exr", "Y")).expect("an image");
    let expected = [Vec3::ZERO, Vec3::ZERO, Vec3::ONE];
    assert_eq!(grey.image.texels(), expected, "luminance, clamped");
    assert!(grey.warning.is_some(), "one was negative");
}

/// Files of a few bytes that say they are too large for any memory: refused before any of it is
/// taken.
#[test]
fn sizes_are_checked_before_memory_is_taken() {
    let huge = 0x7fff_ffffu32.to_be_bytes();
    let mut png = png(::image::GrayImage::new(2, 2));
    png[16..20].copy_from_slice(&huge);
    png[20..24].copy_from_slice(&huge);
    // The check sum of the header.
    let sum = crc(&png[12..29]).to_be_bytes();
    png[29..33].copy_from_slice(&sum);
    let tga = [
        &[0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0][..],
        &[255; 4],
        &[32, 0],
    ]
    .concat();
    for (name, bytes) in [("a.png", png), ("a.tga", tga)] {
        let error = parse_image(Path::new(name), &bytes).expect_err(name);
        let shown = error.to_string();
        assert!(shown.contains("emory") || shown.contains("imit"), "{shown}");
    }
}

/// The check sum of a part of a PNG file.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |sum, &byte| {
        (0..8).fold(sum ^ u32::from(byte), |sum, _| {
            sum >> 1 ^ (0xedb8_8320 * (sum & 1))
        })
    })
}

/// A file of some hundred bytes that says it has 2^26 texels: nothing is allocated for them.
#[test]
fn sizes_that_the_bytes_cannot_hold_are_refused() {
    let folder = TestFolder::new("exr_claims");
    let path = folder.path("a.exr");
    write_exr(&path, &picture()).expect("written");
    let mut bytes = fs::read(&path).expect("read");
    let name = b"dataWindow\0box2i\0";
    let at = bytes.windows(name.len()).position(|part| part == name);
    // After its size, the least x and y, then the largest.
    let largest = at.expect("a window") + name.len() + 4 + 8;
    for corner in 0..2 {
        let from = largest + 4 * corner;
        bytes[from..from + 4].copy_from_slice(&8191i32.to_le_bytes());
    }
    let error = parse_exr(&path, &bytes).expect_err("too little");
    let count = bytes.len();
    let expected = format!("expected the texels of 8192 x 8192, found {count} bytes in all");
    assert_eq!(error.message, expected, "refused");
    // A picture of one colour is packed as tightly as any.
    let white = Image::new(2048, 2048, vec![Vec3::ONE; 1 << 22]).expect("an image");
    write_exr(&path, &white).expect("written");
    let bytes = fs::read(&path).expect("read");
    assert!(parse_exr(&path, &bytes).is_ok(), "{} bytes", bytes.len());
}

/// A file of green primaries for all: its numbers are converted, as long as there are three.
#[test]
fn chromaticities_of_a_file_are_honoured() {
    use exr::meta::attribute::Chromaticities;
    use exr::prelude::*;

    let folder = TestFolder::new("chromaticities");
    let path = folder.path("a.exr");
    let at = |x, y| Vec2(x, y);
    let wide = Chromaticities {
        red: at(0.708, 0.292),
        green: at(0.17, 0.797),
        blue: at(0.131, 0.046),
        white: at(0.3127, 0.329),
    };
    let write = |chromaticities: Option<Chromaticities>| {
        let texel = |_: Vec2<usize>| (0.2f32, 0.5f32, 0.3f32);
        let mut image = Image::from_channels((2, 1), SpecificChannels::rgb(texel));
        image.attributes.chromaticities = chromaticities;
        image.write().to_file(&path).expect("written");
        read_image(&path).expect("an image").image.texel(1, 0)
    };
    let plain = Vec3::new(0.2, 0.5, 0.3);
    assert_eq!(
        write(None),
        plain,
        "Rec. 709 unless the file says otherwise"
    );
    // The published matrix from Rec. 2020.
    let expected = Vec3::new(
        1.6605 * 0.2 - 0.5876 * 0.5 - 0.0728 * 0.3,
        -0.1246 * 0.2 + 1.1329 * 0.5 - 0.0083 * 0.3,
        -0.0182 * 0.2 - 0.1006 * 0.5 + 1.1187 * 0.3,
    );
    let found = write(Some(wide));
    assert!(found.distance(expected) < 1e-3, "{found}, not {expected}");
}
