use super::*;
use crate::glam::DVec3;
use crate::test_folder::TestFolder;
use crate::{Image, parse_image, write_image};

fn file(header: &str, data: &[u8]) -> Vec<u8> {
    [b"#?RADIANCE\n", header.as_bytes(), data].concat()
}

fn parse(bytes: &[u8]) -> Result<ImageFile, Diagnostic> {
    parse_image(Path::new("a.hdr"), bytes)
}

fn image(header: &str, data: &[u8]) -> ImageFile {
    parse(&file(header, data)).expect("an image")
}

#[test]
fn every_exponent_is_exact() {
    let texels: Vec<[u8; 4]> = (0..=255).map(|e| [255, 128, 3, e]).collect();
    let read = image("\n-Y 256 +X 1\n", texels.as_flattened()).image;
    assert_eq!(read.texel(0, 0), Vec3::ZERO, "exponent 0");
    for exponent in 1..=255u8 {
        let found = read.texel(0, exponent.into()).as_dvec3();
        let scale = 2f64.powi(i32::from(exponent) - 136);
        let expected = DVec3::new(255.0, 128.0, 3.0) * scale;
        assert_eq!(found, expected, "exponent {exponent}");
    }
}

#[test]
fn exposures_are_divided_out_and_named() {
    let texel = [128, 128, 128, 129];
    let read = image(
        "EXPOSURE= 4\nVIEW= -vta\nEXPOSURE=.5\n\n-Y 1 +X 1\n",
        &texel,
    );
    assert_eq!(
        read.image.texel(0, 0),
        Vec3::splat(0.5),
        "of 1 that was doubled"
    );
    let warning = read.warning.expect("a warning").to_string();
    let expected = "a.hdr: texels were divided by 2, the exposure of the header: some programs \
                    leave this out";
    assert_eq!(warning, expected, "named");
    let read = image("EXPOSURE=2\nCOLORCORR= 1 2 .25\n\n-Y 1 +X 1\n", &texel);
    assert_eq!(
        read.image.texel(0, 0),
        Vec3::new(0.5, 0.25, 2.0),
        "and colours"
    );
    let read = image("EXPOSURE=1.0\n\n-Y 1 +X 1\n", &texel);
    assert_eq!(read.warning, None, "nothing to say");
}

#[test]
fn primaries_are_honoured() {
    let of_2020 = "PRIMARIES= .708 .292 .170 .797 .131 .046 .3127 .329\n\n-Y 1 +X 1\n";
    let read = image(of_2020, &[100, 128, 110, 129]).image.texel(0, 0);
    let [r, g, b] = [100.0, 128.0, 110.0f32].map(|n| n / 128.0);
    // The published matrix.
    let red = 1.6605 * r - 0.5876 * g - 0.0728 * b;
    assert!((read.x - red).abs() < 1e-3, "{read}");
}

#[test]
fn what_cannot_be_read_is_refused_by_name() {
    let texel = [9, 9, 9, 129];
    for (header, expected) in [
        (
            "FORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n",
            "a.hdr: expected a Radiance HDR file: The image format `32-bit_rle_xyze` is \
             not supported",
        ),
        (
            "\n+Y 1 +X 1\n",
            "a.hdr: expected a Radiance HDR file: no support for the format features Orientation \
             +Y +X",
        ),
        (
            "EXPOSURE=no\n\n-Y 1 +X 1\n",
            "a.hdr: expected a Radiance HDR file: Cannot parse \
             EXPOSURE value as f32: invalid float literal",
        ),
        (
            "EXPOSURE=0\n\n-Y 1 +X 1\n",
            "a.hdr: expected a product of exposures above 0, found 0",
        ),
        (
            "EXPOSURE=1e-30\nEXPOSURE=1e-30\n\n-Y 1 +X 1\n",
            "a.hdr: expected a product of exposures above 0, found 0",
        ),
        (
            "PRIMARIES=1 2\n\n-Y 1 +X 1\n",
            "a.hdr: expected `PRIMARIES=` and x, y of red, green, blue and white, found `1 2`",
        ),
        (
            "\n-Y 2 +X 1\n",
            "a.hdr: expected a Radiance HDR file: the end of the file is missing",
        ),
        (
            "\n-Y 2000000000 +X 2\n",
            "a.hdr: expected the texels of 2 x 2000000000, found 35 bytes in all",
        ),
    ] {
        let error = parse(&file(header, &texel)).expect_err(expected);
        assert_eq!(error.to_string(), expected, "{header:?}");
    }
}

/// Above the largest exponent the encoder writes black, and below the least the brightest light.
#[test]
fn brightness_beyond_the_exponents_is_refused_or_black() {
    let folder = TestFolder::new("hdr_range");
    let path = folder.path("a.hdr");
    let written = |texel: f32| {
        let image = Image::new(1, 1, vec![Vec3::splat(texel)]).expect("an image");
        write_image(&path, &image)?;
        let image = parse_image(&path, &std::fs::read(&path).expect("read"))?.image;
        Ok::<f32, Diagnostic>(image.texel(0, 0).x)
    };
    for texel in [2f32.powi(-128), 1e-30, 1e38, 255.0 * 2f32.powi(119)] {
        let read = written(texel).expect("an image");
        assert!((read - texel).abs() <= texel / 128.0, "{texel:e}: {read:e}");
    }
    assert_eq!(written(1e-39), Ok(0.0), "below the least");
    let largest = Ok(255.0 * 2f32.powi(119));
    assert_eq!(written(1.701_411e38), largest, "just beyond");
    for texel in [1.71e38, f32::MAX, f32::INFINITY] {
        let error = written(texel).expect_err("too bright").to_string();
        let expected = "a.hdr: pixel (0, 0): expected less than 1.7014118e38, the most that .hdr \
                        files hold, found ";
        assert!(error.contains(expected), "{error}");
    }
}
