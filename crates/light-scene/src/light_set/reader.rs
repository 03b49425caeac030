use core::fmt;
use core::str::{FromStr, SplitWhitespace};
use std::io;
use std::path::{Path, PathBuf};

use glam::Vec3;

use super::{LightSetFile, SetLight, SetPoint};
use crate::text::read_all;

/// Why a light-set file was refused: which file, which line, and what was expected there.
#[derive(Debug)]
pub struct LightSetError {
    /// The file.
    pub path: PathBuf,
    /// Line number, from 1; 0 when the file as a whole is meant.
    pub line: usize,
    /// What is wrong.
    pub problem: LightSetProblem,
}

/// What is wrong with a line of a light-set file.
#[derive(Debug)]
#[non_exhaustive]
pub enum LightSetProblem {
    /// The file cannot be read or written.
    Io(io::Error),
    /// The record is neither `tri`, `point` nor `spot`.
    UnknownRecord,
    /// The line has too few or too many fields.
    FieldCount {
        /// How many numbers the record needs.
        expected: usize,
    },
    /// A field is not a finite number.
    BadNumber,
    /// The flag `twosided` is neither 0 nor 1.
    BadFlag,
    /// A radiance or intensity is negative.
    NegativeEmission,
    /// The cone is not within 0 and 180 degrees, or its soft edge is wider than the cone.
    BadCone,
    /// A normal is not of unit length.
    NotUnit,
    /// The file has no records.
    Empty,
}

impl LightSetFile {
    /// The set in the files `lights` and `points`.
    ///
    /// # Errors
    /// [`LightSetError`] with the file and line of the first record that is wrong.
    pub fn read(lights: &Path, points: &Path) -> Result<Self, LightSetError> {
        Ok(Self {
            lights: read_records(lights, parse_light)?,
            points: read_records(points, parse_point)?,
        })
    }
}

impl fmt::Display for LightSetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        if self.line > 0 {
            write!(f, ":{}", self.line)?;
        }
        write!(f, ": {}", self.problem)
    }
}

impl fmt::Display for LightSetProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => write!(f, "{error}"),
            Self::UnknownRecord => f.write_str("expected a record `tri`, `point` or `spot`"),
            Self::FieldCount { expected } => write!(f, "expected {expected} numbers"),
            Self::BadNumber => f.write_str("expected a finite number"),
            Self::BadFlag => f.write_str("expected `twosided` to be 0 or 1"),
            Self::NegativeEmission => {
                f.write_str("expected a radiance or intensity that is not negative")
            }
            Self::BadCone => {
                f.write_str("expected 0 < cone_deg <= 180 and 0 <= delta_deg <= cone_deg")
            }
            Self::NotUnit => f.write_str("expected a normal of unit length"),
            Self::Empty => f.write_str("expected at least one record"),
        }
    }
}

impl core::error::Error for LightSetError {}

fn read_records<T>(
    path: &Path,
    parse: impl Fn(&str) -> Result<T, LightSetProblem>,
) -> Result<Vec<T>, LightSetError> {
    let error = |line, problem| LightSetError {
        path: path.to_owned(),
        line,
        problem,
    };
    let text = read_all(path)
        .and_then(|bytes| String::from_utf8(bytes).map_err(io::Error::other))
        .map_err(|e| error(0, LightSetProblem::Io(e)))?;
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

fn parse_light(line: &str) -> Result<SetLight, LightSetProblem> {
    let mut fields = line.split_whitespace();
    match fields.next() {
        Some("tri") => {
            let [x0, y0, z0, x1, y1, z1, x2, y2, z2, radiance, flag] = numbers(fields)?;
            if flag != 0.0 && flag != 1.0 {
                return Err(LightSetProblem::BadFlag);
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
                return Err(LightSetProblem::BadCone);
            }
            Ok(SetLight::Spot {
                p: Vec3::new(px, py, pz),
                target: Vec3::new(tx, ty, tz),
                intensity: emission(intensity)?,
                cone_deg,
                delta_deg,
            })
        }
        _ => Err(LightSetProblem::UnknownRecord),
    }
}

fn parse_point(line: &str) -> Result<SetPoint, LightSetProblem> {
    let [x, y, z, nx, ny, nz] = numbers(line.split_whitespace())?;
    let n = Vec3::new(nx, ny, nz);
    // Files carry nine digits, but their writers may have rounded harder.
    if !((n.length() - 1.0).abs() < 1e-3) {
        return Err(LightSetProblem::NotUnit);
    }
    Ok(SetPoint {
        p: Vec3::new(x, y, z),
        n: n.normalize(),
    })
}

fn numbers<const N: usize>(mut fields: SplitWhitespace<'_>) -> Result<[f32; N], LightSetProblem> {
    let count = LightSetProblem::FieldCount { expected: N };
    let mut out = [0.0; N];
    for slot in &mut out {
        let Some(field) = fields.next() else {
            return Err(count);
        };
        *slot = f32::from_str(field).map_err(|_| LightSetProblem::BadNumber)?;
        if !slot.is_finite() {
            return Err(LightSetProblem::BadNumber);
        }
    }
    if fields.next().is_some() {
        return Err(count);
    }
    Ok(out)
}

fn emission(value: f32) -> Result<f32, LightSetProblem> {
    if !(value >= 0.0) {
        return Err(LightSetProblem::NegativeEmission);
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
    fn every_problem_is_told() {
        use LightSetProblem as P;
        let light = |line| parse_light(line).expect_err("a bad line");
        assert!(matches!(light("disk 1 2 3"), P::UnknownRecord), "kind");
        assert!(matches!(light(""), P::UnknownRecord), "blank line");
        assert!(
            matches!(light("point 1 2 3"), P::FieldCount { expected: 4 }),
            "few"
        );
        assert!(
            matches!(light("point 1 2 3 4 5"), P::FieldCount { expected: 4 }),
            "many"
        );
        assert!(
            matches!(light("point 1 2 x 4"), P::BadNumber),
            "not a number"
        );
        assert!(
            matches!(light("point 1 2 inf 4"), P::BadNumber),
            "not finite"
        );
        assert!(
            matches!(light("point 1 2 3 -4"), P::NegativeEmission),
            "negative"
        );
        assert!(
            matches!(light("tri 0 0 0 1 0 0 0 1 0 2.5 2"), P::BadFlag),
            "flag"
        );
        assert!(
            matches!(light("spot 0 0 1 0 0 0 4 30 31"), P::BadCone),
            "edge"
        );
        assert!(
            matches!(parse_point("0 0 0 0 0 2"), Err(P::NotUnit)),
            "normal"
        );
        let missing = Path::new("no/such.lights");
        let error = LightSetFile::read(missing, missing).expect_err("no file");
        assert!(matches!(error.problem, P::Io(_)), "missing file");
        assert!(
            error.to_string().starts_with("no/such.lights: "),
            "file first"
        );
    }
}
