use light_math::glam::Vec3;

use crate::light_record::LightRecord;
use crate::scene_records::PointRecord;

/// The lights of a light-set file: a record `tri`, `point` or `spot` a line.
pub(crate) fn lights(text: &str) -> Result<Vec<LightRecord>, String> {
    each_line(text, |line| {
        let (kind, numbers) = line.split_once(' ').ok_or("expected a record")?;
        match (kind, &numbers_of(numbers)?[..]) {
            ("tri", &[ax, ay, az, bx, by, bz, cx, cy, cz, radiance, sides]) => Ok(LightRecord {
                kind: if sides == 0.0 {
                    LightRecord::ONE_SIDED_TRIANGLE
                } else {
                    LightRecord::TWO_SIDED_TRIANGLE
                },
                p: [[ax, ay, az], [bx, by, bz], [cx, cy, cz]],
                emission: radiance,
                ..LightRecord::default()
            }),
            ("point", &[x, y, z, intensity]) => Ok(LightRecord {
                kind: LightRecord::POINT,
                p: [[x, y, z]; 3],
                emission: intensity,
                ..LightRecord::default()
            }),
            ("spot", &[px, py, pz, tx, ty, tz, intensity, cone, delta]) => {
                let axis = (Vec3::new(tx, ty, tz) - Vec3::new(px, py, pz)).normalize();
                Ok(LightRecord {
                    kind: LightRecord::SPOT,
                    p: [[px, py, pz], axis.to_array(), [0.0; 3]],
                    emission: intensity,
                    angles: [cone.to_radians(), (cone - delta).to_radians()],
                })
            }
            _ => Err("expected a record tri, point or spot with all of its numbers".to_owned()),
        }
    })
}

/// The points of a light-set file: position and normal, six numbers a line.
pub(crate) fn points(text: &str) -> Result<Vec<PointRecord>, String> {
    each_line(text, |line| match numbers_of(line)?[..] {
        [x, y, z, nx, ny, nz] => Ok(PointRecord {
            p: [x, y, z],
            n: Vec3::new(nx, ny, nz).normalize().to_array(),
        }),
        _ => Err("expected six numbers".to_owned()),
    })
}

fn each_line<T>(text: &str, parse: impl Fn(&str) -> Result<T, String>) -> Result<Vec<T>, String> {
    let lines = text.lines().enumerate();
    let parse = |(i, line)| parse(line).map_err(|error| format!("{}: {error}", i + 1));
    lines.map(parse).collect()
}

fn numbers_of(text: &str) -> Result<Vec<f32>, String> {
    let number = |word: &str| word.parse().map_err(|_| format!("no number: {word}"));
    text.split_whitespace().map(number).collect()
}
