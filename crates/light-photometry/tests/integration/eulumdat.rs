//! EULUMDAT texts and what they mean.

use light_photometry::parse_eulumdat;

/// Which planes a file holds, and the factor of the intensity around the vertical.
type Case = (Vec<usize>, fn(f32) -> f32);

fn near(value: f32, expected: f32, part: f32, what: &str) {
    let error = (value - expected).abs();
    assert!(
        error <= part * expected.abs(),
        "{what}: {value} for {expected}"
    );
}

/// A EULUMDAT file of one set of lamps of 2000 lm.
fn ldt(symmetry: usize, planes: &[usize], cd_per_klm: impl Fn(f32, f32) -> f32) -> String {
    let mut lines = vec!["A maker", "1"]
        .into_iter()
        .map(str::to_owned)
        .collect::<Vec<_>>();
    let numbers = |n: &[f32]| n.iter().map(ToString::to_string).collect::<Vec<_>>();
    let gamma = [0.0, 45.0, 90.0];
    lines.extend([
        symmetry.to_string(),
        "8".into(),
        "45".into(),
        "3".into(),
        "45".into(),
    ]);
    lines.extend(["report", "A lamp", "1", "a.ldt", "today"].map(str::to_owned));
    lines.extend((0..9).map(|_| "0".to_owned()));
    lines.extend(
        [
            "100", "0", "1,0", "0", "1", "1", "LED", "2000", "830", "80", "20",
        ]
        .map(str::to_owned),
    );
    lines.extend((0..10).map(|_| "0.5".to_owned()));
    let angle = |plane: usize| [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0][plane % 8];
    lines.extend(numbers(&(0..8).map(angle).collect::<Vec<_>>()));
    lines.extend(numbers(&gamma));
    for &plane in planes {
        lines.extend(numbers(&gamma.map(|g| cd_per_klm(angle(plane), g))));
    }
    lines.join("\r\n")
}

#[test]
fn eulumdat_has_five_symmetries() {
    let cases: [Case; 5] = [
        ((0..8).collect(), |c| 3.0 + (c + 0.5).sin()),
        (vec![0], |_| 3.0),
        ((0..5).collect(), |c| 3.0 + c.cos()),
        ((6..11).collect(), |c| 3.0 + c.sin()),
        ((0..3).collect(), |c| 3.0 + (2.0 * c).cos()),
    ];
    for (symmetry, (planes, around)) in cases.into_iter().enumerate() {
        let text = ldt(symmetry, &planes, |c, g| {
            around(c.to_radians()) * (100.0 - g)
        });
        let lamp = parse_eulumdat(&text).expect("well-formed");
        assert_eq!(
            (lamp.lamp_lumens, lamp.input_watts),
            (Some(2000.0), 20.0),
            "{symmetry}"
        );
        for c in (0..=8u8).map(|i| 45.0 * f32::from(i)) {
            let expected = 2.0 * around(c.to_radians()) * 55.0;
            near(lamp.web.at(45.0, c), expected, 1e-5, "2000 lm are 2 klm");
        }
        assert!(lamp.warnings.is_empty(), "no ratio is stated");
    }
}

#[test]
fn eulumdat_errors_and_warnings() {
    let text = ldt(1, &[0], |_, _| 100.0);
    let message = |text: &str| parse_eulumdat(text).expect_err("bad").to_string();
    let lines: Vec<&str> = text.lines().collect();
    let with = |index: usize, line: &str| {
        let mut lines = lines.clone();
        lines[index] = line;
        lines.join("\n")
    };
    assert_eq!(
        message(&with(2, "5")),
        "line 3: expected the symmetry, 0 to 4, at most 4, found `5`",
        "symmetry"
    );
    assert_eq!(
        message(&with(28, "x")),
        "line 29: expected the lumens of the lamps, found `x`",
        "lumens"
    );
    assert_eq!(
        message(&with(25, "0")),
        "line 26: expected at least one set of lamps",
        "no lamps"
    );
    let short = lines[..lines.len() - 1].join("\n");
    assert_eq!(
        message(&short),
        "line 55: expected an intensity in cd/klm, found the end of the file",
        "cut"
    );
    // 100 cd/klm over the half space below are 628 lm of 1000.
    let lamp = |ratio| parse_eulumdat(&with(22, ratio)).expect("well-formed");
    assert!(lamp("63").warnings.is_empty(), "as stated");
    let warnings = lamp("80").warnings;
    assert_eq!(
        warnings[0].to_string(),
        "gives off 1257 lm, not the 1600 lm of its light output ratio",
        "not as stated"
    );
}

/// More numbers than the header says: most likely it is wrong.
#[test]
fn what_follows_the_last_intensity_is_named() {
    let text = ldt(1, &[0], |_, _| 100.0);
    let lines = text.lines().count();
    let warnings = |end: &str| {
        let lamp = parse_eulumdat(&format!("{text}{end}")).expect("well-formed");
        let warnings = lamp.warnings.iter();
        warnings.map(ToString::to_string).collect::<Vec<String>>()
    };
    assert_eq!(warnings("\r\n \r\n"), [""; 0], "blank lines");
    let expected = format!(
        "line {}: what follows the last intensity was ignored",
        lines + 2
    );
    assert_eq!(warnings("\r\n\r\n7\r\n8"), [expected], "numbers");
}
