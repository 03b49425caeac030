use core::fmt::Write as _;
use std::fs;
use std::path::Path;

use glam::Vec3;

use super::{LightSetError, LightSetFile, LightSetProblem, SetLight};

impl LightSetFile {
    /// Writes the set to `PREFIX.lights` and `PREFIX.points`, so that reading them gives the same bits.
    ///
    /// # Errors
    /// [`LightSetError`] with the file that could not be written.
    pub fn write(&self, prefix: &Path) -> Result<(), LightSetError> {
        let mut lights = String::new();
        for light in &self.lights {
            write_light(&mut lights, light);
        }
        let mut points = String::new();
        for point in &self.points {
            points.push_str(&number(point.p.x));
            for value in [point.p.y, point.p.z, point.n.x, point.n.y, point.n.z] {
                push(&mut points, value);
            }
            points.push('\n');
        }
        for (extension, text) in [("lights", lights), ("points", points)] {
            let mut path = prefix.as_os_str().to_owned();
            path.push(".");
            path.push(extension);
            replace_file(Path::new(&path), &text)?;
        }
        Ok(())
    }
}

fn write_light(out: &mut String, light: &SetLight) {
    match *light {
        SetLight::Triangle {
            vertices,
            radiance,
            two_sided,
        } => {
            out.push_str("tri");
            for v in vertices {
                push_vector(out, v);
            }
            push(out, radiance);
            push(out, f32::from(u8::from(two_sided)));
        }
        SetLight::Point { p, intensity } => {
            out.push_str("point");
            push_vector(out, p);
            push(out, intensity);
        }
        SetLight::Spot {
            p,
            target,
            intensity,
            cone_deg,
            delta_deg,
        } => {
            out.push_str("spot");
            push_vector(out, p);
            push_vector(out, target);
            for value in [intensity, cone_deg, delta_deg] {
                push(out, value);
            }
        }
    }
    out.push('\n');
}

fn push_vector(out: &mut String, v: Vec3) {
    for value in v.to_array() {
        push(out, value);
    }
}

fn push(out: &mut String, value: f32) {
    out.push(' ');
    out.push_str(&number(value));
}

/// Nine significant digits, which is what a `f32` needs to come back unchanged; small whole numbers stay short.
fn number(value: f32) -> String {
    let mut out = String::new();
    let written = if value.fract() == 0.0 && value.abs() < 1e6 {
        write!(out, "{value}")
    } else {
        write!(out, "{value:.8e}")
    };
    debug_assert!(written.is_ok(), "writing to a string cannot fail");
    out
}

/// Writes beside `path` and renames, so that the file appears whole or not at all.
fn replace_file(path: &Path, text: &str) -> Result<(), LightSetError> {
    let mut beside = path.as_os_str().to_owned();
    beside.push(".part");
    fs::write(&beside, text)
        .and_then(|()| fs::rename(&beside, path))
        .map_err(|error| LightSetError {
            path: path.to_owned(),
            line: 0,
            problem: LightSetProblem::Io(error),
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light_set::SetKind;

    #[test]
    fn what_is_written_reads_back_bit_for_bit() {
        let set = LightSetFile::generate(SetKind::Mixed, 60, 3);
        let dir = std::env::temp_dir().join(format!("light-set-{}", std::process::id()));
        fs::create_dir_all(&dir).expect("a temporary folder");
        let prefix = dir.join("mixed");
        set.write(&prefix).expect("written");
        let again = LightSetFile::read(&dir.join("mixed.lights"), &dir.join("mixed.points"))
            .expect("read back");
        fs::remove_dir_all(&dir).expect("cleaned");
        assert_eq!(set.lights, again.lights, "lights");
        for (a, b) in set.points.iter().zip(&again.points) {
            assert_eq!(a.p, b.p, "position");
            assert!(
                a.n.distance(b.n) < 1e-6,
                "normal, which the reader makes unit"
            );
        }
    }
}
