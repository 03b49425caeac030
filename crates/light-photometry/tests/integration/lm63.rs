//! LM-63 texts and what they mean.

use core::f32::consts::PI;

use light_photometry::glam::Vec3;
use light_photometry::{Luminaire, LuminaireFormat, parse_lm63};

/// Which planes a file holds, and the factor of the intensity around the vertical.
type Case = (core::ops::RangeInclusive<usize>, fn(f32) -> f32);

/// A file of the 2002 edition, with one value for each direction that the angles say.
fn lm63(
    web_type: u8,
    vertical: &[f32],
    horizontal: &[f32],
    candela: impl Fn(f32, f32) -> f32,
) -> String {
    let words = |numbers: &[f32]| numbers.iter().map(|n| format!("{n} ")).collect::<String>();
    let planes = horizontal.iter().map(|&h| {
        let plane: Vec<f32> = vertical.iter().map(|&v| candela(v, h)).collect();
        words(&plane) + "\n"
    });
    format!(
        "IESNA:LM-63-2002\n[TEST] 1\n[LUMINAIRE] A lamp\n[MORE] and its shade\nTILT=NONE\n\
         1 -1 1 {} {} {web_type} 2 0.1, 0.1, 0\n1 1 10\n{}\n{}\n{}",
        vertical.len(),
        horizontal.len(),
        words(vertical),
        words(horizontal),
        planes.collect::<String>()
    )
}

/// For texts that name no file.
fn no_file(name: &str) -> Result<String, String> {
    Err(format!("is {name}: not allowed"))
}

fn parse(text: &str) -> Luminaire {
    parse_lm63(text, no_file).expect("well-formed")
}

fn error(text: &str) -> String {
    let result = parse_lm63(text, no_file);
    result.expect_err("malformed").to_string()
}

fn near(value: f32, expected: f32, part: f32, what: &str) {
    let error = (value - expected).abs();
    assert!(
        error <= part * expected.abs(),
        "{what}: {value} for {expected}"
    );
}

#[test]
fn lumens_are_integrals() {
    let steps: Vec<f32> = (0..=18u8).map(|i| 10.0 * f32::from(i)).collect();
    let all = parse(&lm63(1, &steps, &[0.0], |_, _| 100.0));
    near(all.web.total_lumens(), 400.0 * PI, 1e-6, "4 pi sr");
    let half = parse(&lm63(1, &steps[..10], &[0.0, 45.0, 90.0], |_, _| 100.0));
    near(half.web.total_lumens(), 200.0 * PI, 1e-6, "2 pi sr");
    let lambert = parse(&lm63(1, &steps[..10], &[0.0], |v, _| {
        100.0 * v.to_radians().cos().max(0.0)
    }));
    near(
        lambert.web.total_lumens(),
        100.0 * PI,
        4e-3,
        "pi sr, in steps",
    );
    let forward = [-90.0, -30.0, 0.0, 30.0, 90.0];
    for web_type in [2, 3] {
        let web = parse(&lm63(web_type, &forward, &forward, |_, _| 100.0)).web;
        near(web.total_lumens(), 200.0 * PI, 1e-6, "a half space");
        let web = parse(&lm63(web_type, &forward[2..], &forward[2..], |_, _| 100.0)).web;
        near(
            web.total_lumens(),
            200.0 * PI,
            1e-6,
            "a quarter of it, mirrored",
        );
    }
}

#[test]
fn directions_are_those_of_the_standard() {
    let full = [0.0, 90.0, 180.0, 270.0];
    let web = parse(&lm63(1, &[0.0, 90.0, 180.0], &full, |v, h| {
        if v == 90.0 { h } else { 500.0 + v }
    }))
    .web;
    let toward = [
        (-Vec3::Y, 500.0),
        (Vec3::Y, 680.0),
        (Vec3::X, 0.0),
        (-Vec3::Z, 90.0),
    ];
    for (w, candela) in toward
        .into_iter()
        .chain([(-Vec3::X, 180.0), (Vec3::Z, 270.0)])
    {
        assert!(
            (web.toward(w) - candela).abs() < 1e-2,
            "type C {w}: {}",
            web.toward(w)
        );
    }
    let angles = [-90.0, 0.0, 90.0];
    let value = |v: f32, h: f32| 1000.0 + 2.0 * v + h;
    let b = parse(&lm63(2, &angles, &angles, value)).web;
    for (w, candela) in [(-Vec3::Y, 1000.0), (Vec3::X, 1180.0), (Vec3::Z, 1090.0)] {
        near(b.toward(w), candela, 1e-3, "type B");
    }
    assert_eq!(b.toward(Vec3::Y), 0.0, "behind");
    let a = parse(&lm63(3, &angles, &angles, value)).web;
    let half = Vec3::new(1.0, 0.0, 1.0).normalize();
    for (w, candela) in [(Vec3::X, 1000.0), (half, 1045.0)] {
        near(a.toward(w), candela, 1e-3, "type A");
    }
    assert_eq!(a.toward(-Vec3::X), 0.0, "behind");
}

#[test]
fn symmetry_fills_in_what_is_left_out() {
    let vertical = [0.0, 60.0, 90.0];
    let turn: Vec<f32> = (0..=24u8).map(|i| 15.0 * f32::from(i)).collect();
    let cases: [Case; 5] = [
        (0..=6, |h| 3.0 + (2.0 * h).cos()),
        (0..=12, |h| 3.0 + h.cos()),
        (6..=18, |h| 3.0 + h.sin()),
        (0..=24, |h| 3.0 + (h + 0.5).sin()),
        (0..=23, |h| 3.0 + (h + 0.5).sin()),
    ];
    for (used, around) in cases {
        let candela = |v: f32, h: f32| v * around(h.to_radians());
        let web = parse(&lm63(1, &vertical, &turn[used.clone()], candela)).web;
        assert_eq!(web.horizontal().first(), Some(&0.0), "{used:?}");
        assert_eq!(web.horizontal().last(), Some(&360.0), "{used:?}");
        for &h in &turn {
            assert!(
                (web.at(60.0, h) - candela(60.0, h)).abs() < 1e-3,
                "{used:?}, {h}"
            );
        }
    }
}

#[test]
fn editions_factors_and_words() {
    let body = "1 1000 2 2 1 1 1 0 0 0\n0.5 0.8 12\n0 90\n0\n10 5\n";
    for (first, format, factor) in [
        ("IESNA:LM-63-1995\n", 1995, 1.0),
        ("IES:LM-63-2019\r\n", 2019, 1.0),
        ("IESNA91\n", 1991, 0.8),
        ("a lamp of 1986\n", 1986, 0.8),
    ] {
        let lamp = parse(&format!("{first}[MANUFAC] none\nTILT=NONE\n{body}"));
        assert_eq!(lamp.format, LuminaireFormat::Lm63(format), "{first}");
        near(lamp.web.peak_candelas(), 10.0 * factor, 1e-6, first);
        assert_eq!(
            (lamp.lamp_lumens, lamp.input_watts),
            (Some(1000.0), 12.0),
            "{first}"
        );
        assert!(lamp.warnings.is_empty(), "{:?}", lamp.warnings);
    }
    let lamp = parse(&lm63(1, &[0.0, 90.0], &[0.0], |_, _| 1.0));
    let keyword = ("LUMINAIRE".to_owned(), "A lamp and its shade".to_owned());
    assert_eq!(lamp.keywords[1], keyword, "continued");
    assert_eq!(lamp.lamp_lumens, None, "absolute photometry");
}

#[test]
fn tilt_is_included_or_in_a_file() {
    let body = "1 1000 1 2 1 1 1 0 0 0\n1 1 12\n0 90\n0\n10 5\n";
    let tilt = "1\n3\n0 45 90\n1 0.9 0.7\n";
    let lamp = parse(&format!("IESNA91\nTILT=INCLUDE\n{tilt}{body}"));
    near(
        lamp.tilt.expect("a tilt").factor(67.5),
        0.8,
        1e-6,
        "included",
    );
    let text = format!("TILT=lamp.tlt\n{body}");
    let lamp = parse_lm63(&text, |name| {
        assert_eq!(name, "lamp.tlt", "as the text has it");
        Ok(tilt.into())
    });
    let factor = lamp.expect("well-formed").tilt.expect("a tilt").factor(0.0);
    near(factor, 1.0, 0.0, "beside");
    let missing = parse_lm63(&text, |_| Err("cannot be read".into())).expect_err("no file");
    assert_eq!(
        missing.to_string(),
        "line 1: TILT names `lamp.tlt`: cannot be read",
        "the caller's reason"
    );
    let broken = parse_lm63(&text, |_| Ok("1\n2\n0 0\n1 1\n".into())).expect_err("no tilt");
    assert_eq!(
        broken.to_string(),
        "lamp.tlt: line 4: expected ascending tilt angles",
        "the file that is wrong"
    );
}

#[test]
fn odd_files_are_warned_about() {
    let lamp = parse("IESNA91\nTILT=NONE\n1 10 1 2 1 1 1 0 0 0\n1 1 12\n0 180\n0\n10 10\n7\n");
    let warnings: Vec<String> = lamp.warnings.iter().map(ToString::to_string).collect();
    let expected = [
        "line 7: what follows the last intensity was ignored",
        "gives off 126 lm, more than the 10 lm of its lamps",
    ];
    assert_eq!(warnings, expected, "both");
}

#[test]
fn errors_name_line_and_expectation() {
    let body = |v: &str, h: &str, c: &str| {
        format!("IESNA91\nTILT=NONE\n1 -1 1 2 1 1 1 0 0 0\n1 1 9\n{v}\n{h}\n{c}\n")
    };
    let cases = [
        (
            "IESNA91\n[A] b\n".to_owned(),
            "line 2: expected a line `TILT=...`, found the end of the file",
        ),
        (
            "TILT=\n".to_owned(),
            "line 1: expected `TILT=NONE`, `TILT=INCLUDE` or the name of a file",
        ),
        (
            body("0 90", "0", "1 x"),
            "line 7: expected an intensity in candela, found `x`",
        ),
        (
            body("0 90", "0", "1"),
            "line 7: expected an intensity in candela, found the end of the file",
        ),
        (
            body("0 90", "0", "1 -1"),
            "line 7: expected a finite intensity of at least 0",
        ),
        (
            body("90 0", "0", "1 1"),
            "line 5: expected ascending vertical angles",
        ),
        (
            body("0 90", "10", "1 1"),
            "line 6: expected ascending horizontal angles",
        ),
        (
            "TILT=NONE\n1 -1 0 2 1".to_owned(),
            "line 2: expected a multiplier above 0, found `0`",
        ),
        (
            "TILT=NONE\n1 -1 1e30 2 1 1 2 0 0 0\n1e9 1".to_owned(),
            "line 3: expected multiplier and ballast factors of a product that is finite and \
             above 0, found 1e30 and 1e9",
        ),
        (
            "TILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n0 1".to_owned(),
            "line 3: expected a ballast factor above 0, found `0`",
        ),
        (
            "TILT=NONE\n1 -1 1\n2.5 1".to_owned(),
            "line 3: expected the number of vertical angles from 1 to 7201, found `2.5`",
        ),
        (
            "TILT=NONE\n1 -1 1\n99999999 1".to_owned(),
            "line 3: expected the number of vertical angles from 1 to 7201, found `99999999`",
        ),
        (
            "TILT=NONE\n1 -1 1 2 1 4".to_owned(),
            "line 2: expected the photometric type from 1 to 3, found `4`",
        ),
        (
            "TILT=INCLUDE\n1 2 0 0 1 1\n".to_owned(),
            "line 2: expected ascending tilt angles",
        ),
    ];
    for (text, message) in cases {
        assert!(
            error(&text).starts_with(message),
            "{}\nnot\n{message}",
            error(&text)
        );
    }
}
