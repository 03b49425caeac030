use core::fmt::Write as _;
use std::io;
use std::path::{Path, PathBuf};

use glam::Vec3;
use light_sets::{BenchSet, SetLight};

use super::error::{LightSetError, LightSetProblem};
use crate::atomic_file::StagedFile;

/// Writes the set to `PREFIX.lights` and `PREFIX.points`, so that reading them gives the same
/// bits.
///
/// # Errors
/// [`LightSetError`] with the file that could not be written.
pub fn write_light_set(set: &BenchSet, prefix: &Path) -> Result<(), LightSetError> {
    let mut lights = String::new();
    for light in &set.lights {
        write_light(&mut lights, light);
    }
    let mut points = String::new();
    for point in &set.points {
        points.push_str(&number(point.p.x));
        for value in [point.p.y, point.p.z, point.n.x, point.n.y, point.n.z] {
            push(&mut points, value);
        }
        points.push('\n');
    }
    let staged = [("lights", lights), ("points", points)].map(|(extension, text)| {
        let mut path = prefix.as_os_str().to_owned();
        path.push(".");
        path.push(extension);
        let path = PathBuf::from(path);
        StagedFile::new(&path, text.as_bytes())
            .map(|file| (path.clone(), file))
            .map_err(|error| cannot_be_written(path, error))
    });
    // One file without the other is not a set: both are complete before either is published.
    let [lights, points] = staged;
    for (path, file) in [lights?, points?] {
        file.publish()
            .map_err(|error| cannot_be_written(path, error))?;
    }
    Ok(())
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

/// Nine significant digits, which is what a `f32` needs to come back unchanged; small whole numbers
/// stay short.
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

fn cannot_be_written(path: PathBuf, error: io::Error) -> LightSetError {
    LightSetError {
        path,
        line: 0,
        problem: LightSetProblem::Io(io::Error::new(
            error.kind(),
            format!("cannot be written: {error}"),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light_set::read_light_set;
    use crate::test_folder::TestFolder;
    use light_sets::SetKind;
    use std::fs;

    #[test]
    fn what_is_written_reads_back_bit_for_bit() {
        let folder = TestFolder::new("light-set-bits");
        for kind in SetKind::all() {
            let (set, name) = (BenchSet::generate(kind, 60, 3), kind.name());
            write_light_set(&set, &folder.path(name)).expect("written");
            let [lights, points] =
                ["lights", "points"].map(|ending| folder.path(format!("{name}.{ending}")));
            let again = read_light_set(&lights, &points).expect("read back");
            assert_eq!(set.lights, again.lights, "lights of {name}");
            assert_eq!(set.points, again.points, "points of {name}");
        }
    }

    #[test]
    fn a_set_is_written_whole_or_not_at_all() {
        let folder = TestFolder::new("light-set-whole");
        fs::create_dir(folder.path("set.points")).expect("a folder in the way");
        let set = BenchSet::generate(SetKind::Uniform, 10, 1);
        let error = write_light_set(&set, &folder.path("set")).expect_err("no file");
        assert!(error.to_string().contains("set.points"), "{error}");
        assert_eq!(folder.names(), ["set.points"], "no lights without points");
    }
}
