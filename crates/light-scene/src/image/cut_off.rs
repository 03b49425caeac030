use core::fmt::Display;

/// What decoders say of a file whose end is missing.
const OF_DECODERS: [&str; 5] = [
    "reference to missing bytes",
    "unexpected end of file",
    "failed to fill whole buffer",
    "EOF in header",
    "Not enough bytes",
];

/// The error of a decoder, without the name of the format; of a file that was cut off, what is
/// missing.
pub(super) fn in_words(error: &impl Display) -> String {
    let message = error.to_string();
    if OF_DECODERS.iter().any(|words| message.contains(words)) {
        return "the end of the file is missing".to_owned();
    }
    if let Some((_, what)) = message.split_once(" does not support ") {
        return format!("no support for {}", what.trim_end_matches('.'));
    }
    // The message says which format that is already.
    let reason = message.strip_prefix("Format error decoding ");
    let reason = reason.and_then(|reason| reason.split_once(": "));
    let reason = reason.map_or(&*message, |(_, reason)| reason);
    reason.trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use ::image::RgbImage;

    use crate::glam::Vec3;
    use crate::test_folder::TestFolder;
    use crate::{Image, parse_image, write_image};

    #[test]
    fn files_of_other_content_say_what_they_are_not() {
        for (name, bytes, expected) in [
            ("a.png", "no picture", "a PNG file: Invalid PNG signature"),
            (
                "a.jpg",
                "no picture",
                "a JPEG file: Error parsing image. Illegal start",
            ),
            (
                "a.hdr",
                "no picture",
                "a Radiance HDR file: Radiance HDR signature not found",
            ),
            (
                "a.tga",
                "\u{1}\u{7}\u{1}no picture, but long enough",
                "a TGA file: ",
            ),
        ] {
            let error = parse_image(Path::new(name), bytes.as_bytes()).expect_err(name);
            let found = error.to_string();
            assert!(
                found.starts_with(&format!("{name}: expected {expected}")),
                "{found}"
            );
            for word in ["Format error", "encoder"] {
                assert!(!found.contains(word), "{found}");
            }
        }
    }

    #[test]
    fn files_that_were_cut_off_say_so() {
        let folder = TestFolder::new("cut_off");
        let texels = (0..256).map(|n: u16| Vec3::splat(f32::from(n) / 255.0));
        let picture = Image::new(16, 16, texels.collect()).expect("an image");
        let [exr, hdr, png] = ["a.exr", "a.hdr", "a.png"].map(|name| folder.path(name));
        for path in [&exr, &hdr, &png] {
            write_image(path, &picture).expect("written");
        }
        let [jpg, tga] = ["a.jpg", "a.tga"].map(|name| folder.path(name));
        for path in [&jpg, &tga] {
            let noise =
                |x, y| ::image::Rgb([x * 37, y * 91, x * y].map(|n: u32| n.to_le_bytes()[0]));
            RgbImage::from_fn(16, 16, noise)
                .save(path)
                .expect("written");
        }
        for path in [exr, hdr, png, jpg, tga] {
            let bytes = fs::read(&path).expect("read");
            let cut = &bytes[..bytes.len() / 2];
            let error = parse_image(Path::new(&path), cut).expect_err("half a file");
            let expected = " file: the end of the file is missing";
            assert!(error.message.ends_with(expected), "{error}");
        }
    }
}
