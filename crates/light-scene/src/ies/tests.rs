use core::f32::consts::PI;
use std::path::Path;

use super::*;
use crate::test_folder::TestFolder;
use glam::{Affine3A, Vec2, Vec3};
use lights::bounds::{LightId, LightSampleContext};
use lights::sources::{Light, LightDesc, LightSetBuilder, PdfCoverage, Rgb, SceneSphere};

/// Which planes a file holds, and the factor of the intensity around the vertical.
pub(super) type Case<Planes> = (Planes, fn(f32) -> f32);

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

fn parse(text: &str) -> Luminaire {
    parse_lm63(Path::new("a.ies"), text).expect("well-formed")
}

fn error(text: &str) -> String {
    let result = parse_lm63(Path::new("a.ies"), text);
    result.expect_err("malformed").to_string()
}

pub(super) fn near(value: f32, expected: f32, part: f32, what: &str) {
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
    let cases: [Case<core::ops::RangeInclusive<usize>>; 5] = [
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
fn tilt_is_included_or_beside() {
    let body = "1 1000 1 2 1 1 1 0 0 0\n1 1 12\n0 90\n0\n10 5\n";
    let tilt = "1\n3\n0 45 90\n1 0.9 0.7\n";
    let lamp = parse(&format!("IESNA91\nTILT=INCLUDE\n{tilt}{body}"));
    near(
        lamp.tilt.expect("a tilt").factor(67.5),
        0.8,
        1e-6,
        "included",
    );
    let folder = TestFolder::new("ies_tilt");
    std::fs::write(folder.path("lamp.tlt"), tilt).expect("written");
    std::fs::write(folder.path("a.ies"), format!("TILT=lamp.tlt\n{body}")).expect("written");
    let lamp = read_luminaire(&folder.path("a.ies")).expect("well-formed");
    near(lamp.tilt.expect("a tilt").factor(0.0), 1.0, 0.0, "beside");
    let missing = parse_lm63(&folder.path("b.ies"), "x\nTILT=none.tlt\n").expect_err("no file");
    assert!(
        missing
            .message
            .starts_with("TILT names `none.tlt`, which cannot be read"),
        "{missing}"
    );
}

#[test]
fn odd_files_are_warned_about() {
    let lamp = parse("IESNA91\nTILT=NONE\n1 10 1 2 1 1 1 0 0 0\n1 1 12\n0 180\n0\n10 10\n7\n");
    let warnings: Vec<String> = lamp.warnings.iter().map(ToString::to_string).collect();
    let expected = [
        "a.ies:7: what follows the last intensity was ignored",
        "a.ies: gives off 126 lm, more than the 10 lm of its lamps",
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
            "a.ies:2: expected a line `TILT=...`, found the end of the file",
        ),
        (
            "TILT=\n".to_owned(),
            "a.ies:1: expected `TILT=NONE`, `TILT=INCLUDE` or the name of a file",
        ),
        (
            body("0 90", "0", "1 x"),
            "a.ies:7: expected an intensity in candela, found `x`",
        ),
        (
            body("0 90", "0", "1"),
            "a.ies:7: expected an intensity in candela, found the end of the file",
        ),
        (
            body("0 90", "0", "1 -1"),
            "a.ies:7: expected a finite intensity of at least 0",
        ),
        (
            body("90 0", "0", "1 1"),
            "a.ies:5: expected ascending vertical angles",
        ),
        (
            body("0 90", "10", "1 1"),
            "a.ies:6: expected ascending horizontal angles",
        ),
        (
            "TILT=NONE\n1 -1 0 2 1".to_owned(),
            "a.ies:2: expected a multiplier above 0, found `0`",
        ),
        (
            "TILT=NONE\n1 -1 1\n2.5 1".to_owned(),
            "a.ies:3: expected the number of vertical angles from 1 to 7201, found `2.5`",
        ),
        (
            "TILT=NONE\n1 -1 1 2 1 4".to_owned(),
            "a.ies:2: expected the photometric type from 1 to 3, found `4`",
        ),
        (
            "TILT=INCLUDE\n1 2 0 0 1 1\n".to_owned(),
            "a.ies:2: expected ascending tilt angles",
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

#[test]
fn a_web_becomes_a_light_of_its_power_and_shape() {
    let steps: Vec<f32> = (0..=18u8).map(|i| 10.0 * f32::from(i)).collect();
    let turn: Vec<f32> = (0..=24u8).map(|i| 15.0 * f32::from(i)).collect();
    let web = parse(&lm63(1, &steps, &turn, |v, h| {
        (200.0 - v) * (2.0 + h.to_radians().sin())
    }))
    .web;
    let mut builder =
        LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere"));
    let desc = web.light::<Rgb>(Affine3A::IDENTITY, Vec3::ONE, 256);
    builder.add(LightDesc::Goniometric(desc)).expect("a light");
    let set = builder.build();
    let light = set.get(LightId(0)).expect("one");
    near(683.0 * light.phi(&()).x, web.total_lumens(), 1e-4, "lumens");
    for w in [
        Vec3::new(0.3, -0.8, 0.2),
        Vec3::new(-0.5, 0.1, 0.7),
        Vec3::new(0.1, 0.9, -0.3),
    ] {
        let w = w.normalize();
        let ctx = LightSampleContext::medium(w);
        let sample = light
            .sample_li(&ctx, Vec2::ZERO, &(), PdfCoverage::Complete)
            .expect("in sight");
        near(
            683.0 * sample.l.x,
            web.toward(w),
            0.03,
            "candela at 1 m are lux",
        );
    }
}
