use core::str::{FromStr, SplitWhitespace};
use std::io;
use std::path::Path;

use glam::Vec3;
use light_sets::{BenchSet, SetLight, SetPoint};

use super::error::{LightSetError, LightSetProblem};
use crate::text::{read_all, shown, text_of};

/// The set in the files `lights` and `points`. A normal that is a unit vector but for the rounding
/// of single precision keeps its bits; others, within a thousandth of one, are made unit.
///
/// # Errors
/// [`LightSetError`] with the file and line of the first record that is wrong.
pub fn read_light_set(lights: &Path, points: &Path) -> Result<BenchSet, LightSetError> {
    Ok(BenchSet {
        lights: read_records(lights, |line| of_finite_power(parse_light(line)?))?,
        points: read_records(points, parse_point)?,
    })
}

fn read_records<T>(
    path: &Path,
    parse: impl Fn(&str) -> Result<T, LightSetProblem>,
) -> Result<Vec<T>, LightSetError> {
    let error = |line, problem| LightSetError {
        path: path.to_owned(),
        line,
        problem,
    };
    let refuse = |e: io::Error| {
        let words = format!("cannot be read: {e}");
        error(0, LightSetProblem::Io(io::Error::new(e.kind(), words)))
    };
    let bytes = read_all(path).map_err(refuse)?;
    let text = text_of(&bytes);
    let records: Vec<T> = text
        .lines()
        .enumerate()
        .map(|(i, line)| parse(line).map_err(|problem| error(i + 1, problem)))
        .collect::<Result<_, _>>()?;
    if records.is_empty() {
        return Err(error(0, LightSetProblem::Empty));
    }
    Ok(records)
}

fn of_finite_power(light: SetLight) -> Result<SetLight, LightSetProblem> {
    // A spot as if it had no cone: so its bounds have it.
    let whole = match light {
        SetLight::Spot { p, intensity, .. } => SetLight::Point { p, intensity },
        other => other,
    };
    let power = whole.power();
    if !(power <= f64::from(f32::MAX)) {
        return Err(LightSetProblem::Power { found: power });
    }
    Ok(light)
}

fn parse_light(line: &str) -> Result<SetLight, LightSetProblem> {
    let mut fields = line.split_whitespace();
    match fields.next() {
        Some("tri") => {
            let [x0, y0, z0, x1, y1, z1, x2, y2, z2, radiance, flag] = numbers(fields)?;
            if flag != 0.0 && flag != 1.0 {
                return Err(LightSetProblem::BadFlag { found: flag });
            }
            Ok(SetLight::Triangle {
                vertices: [
                    Vec3::new(x0, y0, z0),
                    Vec3::new(x1, y1, z1),
                    Vec3::new(x2, y2, z2),
                ],
                radiance: emission(radiance)?,
                two_sided: flag == 1.0,
            })
        }
        Some("point") => {
            let [x, y, z, intensity] = numbers(fields)?;
            Ok(SetLight::Point {
                p: Vec3::new(x, y, z),
                intensity: emission(intensity)?,
            })
        }
        Some("spot") => {
            let [px, py, pz, tx, ty, tz, intensity, cone_deg, delta_deg] = numbers(fields)?;
            if !(cone_deg > 0.0 && cone_deg <= 180.0 && delta_deg >= 0.0 && delta_deg <= cone_deg) {
                return Err(LightSetProblem::BadCone {
                    cone_deg,
                    delta_deg,
                });
            }
            let (p, target) = (Vec3::new(px, py, pz), Vec3::new(tx, ty, tz));
            if p == target {
                return Err(LightSetProblem::NoAxis);
            }
            Ok(SetLight::Spot {
                p,
                target,
                intensity: emission(intensity)?,
                cone_deg,
                delta_deg,
            })
        }
        other => Err(LightSetProblem::UnknownRecord {
            found: shown(other.unwrap_or_default()),
        }),
    }
}

fn parse_point(line: &str) -> Result<SetPoint, LightSetProblem> {
    /// How far from 1 the length of a normal may be that was normalised in single precision.
    const ROUNDING: f32 = 4.0 * f32::EPSILON;
    let [x, y, z, nx, ny, nz] = numbers(line.split_whitespace())?;
    let p = Vec3::new(x, y, z);
    let n = Vec3::new(nx, ny, nz);
    let found = n.length();
    let off = (found - 1.0).abs();
    if !(off < 1e-3) {
        return Err(LightSetProblem::NotUnit { found });
    }
    // Files carry nine digits, but their writers may have rounded harder.
    let n = if off <= ROUNDING { n } else { n.normalize() };
    Ok(SetPoint { p, n })
}

fn numbers<const N: usize>(fields: SplitWhitespace<'_>) -> Result<[f32; N], LightSetProblem> {
    let found = fields.clone().count();
    if found != N {
        return Err(LightSetProblem::FieldCount { expected: N, found });
    }
    let mut out = [0.0; N];
    for (slot, field) in out.iter_mut().zip(fields) {
        let number = f32::from_str(field)
            .ok()
            .filter(|number| number.is_finite());
        *slot = number.ok_or_else(|| LightSetProblem::BadNumber {
            found: shown(field),
        })?;
    }
    Ok(out)
}

fn emission(value: f32) -> Result<f32, LightSetProblem> {
    if !(value >= 0.0) {
        return Err(LightSetProblem::NegativeEmission { found: value });
    }
    Ok(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn good_lines_are_read() {
        let tri = parse_light("tri 0 0 0 1 0 0 0 1 0 2.5 1").expect("a triangle");
        assert!(
            matches!(
                tri,
                SetLight::Triangle {
                    radiance: 2.5,
                    two_sided: true,
                    ..
                }
            ),
            "all fields"
        );
        assert!(parse_light("point 1 2 3 4").is_ok(), "a point");
        assert!(parse_light("spot 0 0 1 0 0 0 4 30 5").is_ok(), "a spot");
        assert_eq!(
            parse_point("1 2 3 0 0 1").expect("a point").n,
            Vec3::Z,
            "position and normal"
        );
    }

    #[test]
    fn every_problem_is_reported() {
        use LightSetProblem as P;
        let light = |line| parse_light(line).expect_err("a bad line");
        for (line, expected) in [
            (
                "disk 1 2 3",
                "expected a record `tri`, `point` or `spot`, found `disk`",
            ),
            ("", "expected a record `tri`, `point` or `spot`, found ``"),
            ("point 1 2 3", "expected 4 numbers, found 3"),
            ("point 1 2 3 4 5", "expected 4 numbers, found 5"),
            ("point 1 2 x 4", "expected a finite number, found `x`"),
            ("point 1 2 inf 4", "expected a finite number, found `inf`"),
            (
                "point 1 2 3 -4",
                "expected a radiance or intensity that is not negative, found -4",
            ),
            (
                "tri 0 0 0 1 0 0 0 1 0 2.5 2",
                "expected `twosided` to be 0 or 1, found 2",
            ),
            (
                "spot 0 0 1 0 0 0 4 30 31",
                "expected 0 < cone_deg <= 180 and 0 <= delta_deg <= cone_deg, found 30 and 31",
            ),
            (
                "spot 0 0 0 0 0 0 1 30 10",
                "expected a target apart from the spot, found its position",
            ),
        ] {
            assert_eq!(light(line).to_string(), expected, "{line}");
        }
        let normal = parse_point("0 0 0 0 0 2").expect_err("a bad normal");
        let expected = "expected a normal of unit length, found 2";
        assert_eq!(normal.to_string(), expected);
        let missing = Path::new("no/such.lights");
        let folder = crate::test_folder::TestFolder::new("light_set_mark");
        let marked = folder.path("a.lights");
        std::fs::write(&marked, "\u{feff}point 1 2 3 4\n").expect("written");
        let read = read_records(&marked, parse_light).expect("after the mark");
        assert_eq!(read.len(), 1, "a byte order mark is passed over");
        std::fs::write(&marked, "point 1 2 3 4\npoint 1 2 3 3e38\n").expect("written");
        let error = read_light_set(&marked, missing).expect_err("too bright");
        let expected = format!(
            "{}:2: expected a light of finite power, found 3.8e39",
            marked.display()
        );
        assert_eq!(error.to_string(), expected);
        std::fs::write(&marked, b"point 1 2 3 4\n\xb5 1 2\n").expect("written");
        let error = read_light_set(&marked, missing).expect_err("no text");
        assert!(
            error.to_string().contains(":2: expected a record"),
            "{error}"
        );
        let huge = parse_light("tri 0 0 0 1e20 0 0 0 1e20 0 1 0").expect("a triangle");
        assert!(
            matches!(of_finite_power(huge), Err(P::Power { .. })),
            "area"
        );

        let error = read_light_set(missing, missing).expect_err("no file");
        assert!(matches!(error.problem, P::Io(_)), "missing file");
        assert!(
            error.to_string().starts_with("no/such.lights: "),
            "file first"
        );
    }
}
