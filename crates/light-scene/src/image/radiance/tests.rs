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

/// A texel of the grey level `level` / 128.
const fn grey(level: u8) -> [u8; 4] {
    [level, level, level, 129]
}

/// The red mantissas of an image of [`grey`] texels.
fn levels(file: &ImageFile) -> Vec<f32> {
    let texels = file.image.texels().iter();
    texels.map(|texel| texel.x * 128.0).collect()
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
fn lines_lie_in_all_eight_ways() {
    // Two rows of three, and as columns.
    let rows = [[1, 2, 3], [4, 5, 6]];
    let in_order = |indices: [u8; 6]| indices.map(|n| grey(10 * n));
    for (size, order) in [
        ("-Y 2 +X 3", [1, 2, 3, 4, 5, 6]),
        ("-Y 2 -X 3", [3, 2, 1, 6, 5, 4]),
        ("+Y 2 +X 3", [4, 5, 6, 1, 2, 3]),
        ("+Y 2 -X 3", [6, 5, 4, 3, 2, 1]),
        ("+X 3 -Y 2", [1, 4, 2, 5, 3, 6]),
        ("-X 3 -Y 2", [3, 6, 2, 5, 1, 4]),
        ("+X 3 +Y 2", [4, 1, 5, 2, 6, 3]),
        ("-X 3 +Y 2", [6, 3, 5, 2, 4, 1]),
    ] {
        let read = image(&format!("\n{size}\n"), in_order(order).as_flattened());
        let expected = rows
            .as_flattened()
            .iter()
            .map(|&n: &u8| 10.0 * f32::from(n));
        assert_eq!(levels(&read), expected.collect::<Vec<f32>>(), "{size}");
    }
}

#[test]
fn runs_of_both_kinds_are_unpacked() {
    // Repeated three times, and 256 + 2 times.
    let old = [grey(9), [1, 1, 1, 3], grey(7), [1, 1, 1, 2], [1, 1, 1, 1]];
    let read = image("\n-Y 1 +X 263\n", old.as_flattened());
    let expected = [vec![9.0; 4], vec![7.0; 259]].concat();
    assert_eq!(levels(&read), expected, "of texels");

    let component = |value| [5, 1, 2, 3, 4, 5, 128 + 3, value];
    let exponents = [128 + 8, 129];
    let new = [&[2, 2, 0, 8][..], &[component(6); 3].concat(), &exponents].concat();
    let read = image("\n-Y 1 +X 8\n", &new);
    let expected = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 6.0, 6.0];
    assert_eq!(levels(&read), expected, "of components");
}

/// What marks a packed line is a texel where lines are too short or too long to be packed.
#[test]
fn marks_are_texels_where_no_line_is_packed() {
    let mark = [2, 2, 0, 1];
    let read = image("\n-Y 1 +X 1\n", &mark).image;
    assert_eq!(
        read.texel(0, 0),
        Vec3::new(2.0, 2.0, 0.0) * 2f32.powi(-135),
        "1"
    );
    let wide = vec![mark; 0x8000];
    let read = image("\n-Y 1 +X 32768\n", wide.as_flattened()).image;
    assert_eq!(read.width(), 32768, "too wide to be packed");
    let read = image("\n-Y 1 +X 8\n", [[2, 2, 200, 129]; 8].as_flattened()).image;
    assert_eq!(
        read.texel(7, 0).z * 128.0,
        200.0,
        "no mark: its third byte is above 127"
    );
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
    let read = image(
        "EXPOSURE=2\r\nCOLORCORR= 1 2 .25\r\n\r\n-Y 1 +X 1\r\n",
        &texel,
    );
    assert_eq!(
        read.image.texel(0, 0),
        Vec3::new(0.5, 0.25, 2.0),
        "and colours"
    );
    let read = image("EXPOSURE=1.0\n\n-Y 1 +X 1\n", &texel);
    assert_eq!(read.warning, None, "nothing to say");
}

/// As `ra_xyze` of Radiance writes a white texel.
#[test]
fn xyz_becomes_colours() {
    let header = "FORMAT=32-bit_rle_xyze\nEXPOSURE=5.586592e-03\n\n-Y 1 +X 1\n";
    let read = image(header, &[128, 128, 128, 129]);
    let white = read.image.texel(0, 0);
    assert!(white.abs_diff_eq(Vec3::ONE, 1e-4), "{white}");
    assert_eq!(read.warning, None, "watts as they were");
    let read = image(
        "FORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n",
        &[128, 128, 128, 136],
    );
    let white = read.image.texel(0, 0);
    assert!(
        white.abs_diff_eq(Vec3::splat(128.0 / 179.0), 1e-4),
        "{white}"
    );
    assert!(
        read.warning
            .expect("a warning")
            .message
            .contains("179 lm/W"),
        "named"
    );
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
fn broken_files_name_line_or_byte() {
    let texel = grey(9);
    for (header, data, expected) in [
        (
            "FORMAT=16-bit\n\n-Y 1 +X 1\n",
            &texel[..],
            "a.hdr:2: expected `FORMAT=32-bit_rle_rgbe` or `FORMAT=32-bit_rle_xyze`, found `16-bit`",
        ),
        (
            "EXPOSURE=0\n\n-Y 1 +X 1\n",
            &texel,
            "a.hdr:2: expected `EXPOSURE=` and a number above 0, found `0`",
        ),
        (
            "COLORCORR=1 2\n\n-Y 1 +X 1\n",
            &texel,
            "a.hdr:2: expected `COLORCORR=` and three numbers above 0, found `1 2`",
        ),
        (
            "EXPOSURE=1e-30\nEXPOSURE=1e-30\n\n-Y 1 +X 1\n",
            &texel,
            "a.hdr: expected a product of exposures above 0, found 0",
        ),
        (
            "\n-Y 1 +Y 1\n",
            &texel,
            "a.hdr:3: expected the size of the picture, as `-Y HEIGHT +X WIDTH`, found `-Y 1 +Y 1`",
        ),
        (
            "\n-Y 0 +X 1\n",
            &texel,
            "a.hdr:3: expected the size of the picture, as `-Y HEIGHT +X WIDTH`, found `-Y 0 +X 1`",
        ),
        (
            "\n-Y 2 +X 1\n",
            &texel,
            "a.hdr: byte 26: scanline 1: expected more of the file: the end of the file is missing",
        ),
        (
            "\n-Y 1 +X 1\n",
            &[1, 1, 1, 1],
            "a.hdr: byte 22: scanline 0: expected a run behind a texel that ends with the line",
        ),
        (
            "\n-Y 1 +X 8\n",
            &[2, 2, 0, 9],
            "a.hdr: byte 22: scanline 0: expected the length that the header says",
        ),
        (
            "\n-Y 1 +X 8\n",
            &[2, 2, 0, 8, 129 + 8, 0],
            "a.hdr: byte 26: scanline 0: expected a run that ends with the line",
        ),
    ] {
        let error = parse(&file(header, data)).expect_err(expected);
        assert_eq!(error.to_string(), expected, "{header:?}");
    }
    let huge = file("\n-Y 2000000000 +X 2000000000\n", &texel);
    let error = parse(&huge).expect_err("too much for 45 bytes");
    let expected = "a.hdr: expected the texels of 2000000000 x 2000000000, found 44 bytes in all";
    assert_eq!(error.to_string(), expected, "before memory is taken");
}

/// The largest exponent is followed by none: the encoder wrote black there, and the brightest light
/// for the least.
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
