use core::num::NonZeroU32;
use core::ops::Range;
use core::str::FromStr;
use core::time::Duration;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use light_scene::Camera;
use lights::glam::Vec3;

/// One of some names, which the help lists.
pub(crate) fn named<T>(
    names: impl IntoIterator<Item = &'static str>,
) -> impl TypedValueParser<Value = T>
where
    T: FromStr<Err = String> + Clone + Send + Sync + 'static,
{
    PossibleValuesParser::new(names).try_map(|name| name.parse())
}

/// Position, target and up vector of the camera: `ex,ey,ez,tx,ty,tz,ux,uy,uz`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LookAt {
    /// Position of the camera.
    pub(crate) eye: Vec3,
    /// What it looks at.
    pub(crate) target: Vec3,
    /// What is up in the picture.
    pub(crate) up: Vec3,
}

impl FromStr for LookAt {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let [ex, ey, ez, tx, ty, tz, ux, uy, uz] = numbers(text)?;
        let eye = Vec3::new(ex, ey, ez);
        let target = Vec3::new(tx, ty, tz);
        let up = Vec3::new(ux, uy, uz);
        match Camera::look_at(eye, target, up, 1.0) {
            Ok(_) => Ok(Self { eye, target, up }),
            Err(error) => Err(error.to_string()),
        }
    }
}

/// A material to turn on, and its radiance: `MATERIAL=r,g,b`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Emit {
    /// The material's name.
    pub(crate) material: String,
    /// What its front emits, in W m^-2 sr^-1 a channel.
    pub(crate) radiance: Vec3,
}

impl FromStr for Emit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (material, radiance) = text.rsplit_once('=').ok_or("expected MATERIAL=r,g,b")?;
        let radiance = Vec3::from(numbers::<3>(radiance)?);
        if radiance.min_element() < 0.0 {
            return Err("expected a radiance of at least 0".into());
        }
        Ok(Self {
            material: material.into(),
            radiance,
        })
    }
}

/// A finite number above zero.
pub(crate) fn positive(text: &str) -> Result<f32, String> {
    let number: f32 = text
        .parse()
        .map_err(|_| String::from("expected a number"))?;
    if number > 0.0 && number.is_finite() {
        Ok(number)
    } else {
        Err("expected a finite number above 0".into())
    }
}

/// An angle of view in degrees, which is below half a turn.
pub(crate) fn angle_of_view(text: &str) -> Result<f32, String> {
    let degrees = text.parse().ok();
    let is_angle = |degrees: &f32| {
        let radians = degrees.to_radians();
        radians > 0.0 && radians < core::f32::consts::PI
    };
    degrees
        .filter(is_angle)
        .ok_or_else(|| "expected a number of degrees between 0 and 180".into())
}

/// A number that is neither infinite nor NaN.
pub(crate) fn finite(text: &str) -> Result<f32, String> {
    let number: Option<f32> = text.parse().ok();
    let number = number.filter(|number| number.is_finite());
    number.ok_or_else(|| "expected a finite number".into())
}

/// A time in seconds, above zero and at most [`MOST_SECONDS`].
pub(crate) fn seconds(text: &str) -> Result<Duration, String> {
    let seconds: f64 = text.parse().unwrap_or(f64::NAN);
    if seconds > 0.0 && seconds <= MOST_SECONDS {
        // A time that rounds to nothing would be none.
        Ok(Duration::from_secs_f64(seconds).max(Duration::from_nanos(1)))
    } else {
        Err(format!(
            "expected a number of seconds above 0, at most {MOST_SECONDS:e}"
        ))
    }
}

/// Thirty years: longer times mean a slip.
const MOST_SECONDS: f64 = 1e9;

/// A number of threads, at most [`MOST_THREADS`].
pub(crate) fn threads(text: &str) -> Result<usize, String> {
    let threads = text.parse().ok();
    threads
        .filter(|&threads| threads <= MOST_THREADS)
        .ok_or_else(|| format!("expected a whole number from 0 to {MOST_THREADS}"))
}

/// A number of things of which there is at least one.
pub(crate) fn count(text: &str) -> Result<NonZeroU32, String> {
    let count = text.parse();
    count.map_err(|_| format!("expected a whole number from 1 to {}", u32::MAX))
}

/// More threads than this would be started for minutes, and none would have work.
const MOST_THREADS: usize = 1024;

/// A finite number, zero or above.
pub(crate) fn not_negative(text: &str) -> Result<f64, String> {
    let number: f64 = text
        .parse()
        .map_err(|_| String::from("expected a number"))?;
    if number >= 0.0 && number.is_finite() {
        Ok(number)
    } else {
        Err("expected a finite number that is not negative".into())
    }
}

/// A range of samples: `A..B`, with A below B.
pub(crate) fn sample_range(text: &str) -> Result<Range<u32>, String> {
    let ends = text.split_once("..");
    let parsed = ends.and_then(|(start, end)| Some(start.parse().ok()?..end.parse().ok()?));
    parsed
        .filter(|range: &Range<u32>| !range.is_empty())
        .ok_or_else(|| "expected A..B, with whole numbers and A below B".into())
}

/// Column and row of a pixel: `X,Y`.
pub(crate) fn pixel(text: &str) -> Result<[u32; 2], String> {
    let parsed = text
        .split_once(',')
        .and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    parsed.ok_or_else(|| "expected X,Y, whole numbers from the top left corner".into())
}

/// Exactly `N` finite numbers with commas between.
pub(super) fn numbers<const N: usize>(text: &str) -> Result<[f32; N], String> {
    let parsed: Result<Vec<f32>, _> = text.split(',').map(|n| n.trim().parse()).collect();
    parsed
        .ok()
        .filter(|numbers| numbers.iter().all(|n: &f32| n.is_finite()))
        .and_then(|numbers| numbers.try_into().ok())
        .ok_or_else(|| format!("expected {N} finite numbers with commas between"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nine_numbers_look_at_something() {
        let look_at: LookAt = "0,1,2, 3,4,5, 0,1,0".parse().expect("nine numbers");
        assert_eq!(look_at.target, Vec3::new(3.0, 4.0, 5.0), "the middle three");
        for (bad, expected) in [
            ("", "9 finite numbers"),
            ("1,2,3", "9 finite numbers"),
            ("0,1,2,3,4,5,0,1,x", "9 finite numbers"),
            ("0,1,2,3,4,5,0,1,nan", "9 finite numbers"),
            ("0,1,2,0,1,2,0,1,0", "two different finite points"),
            ("1e30,0,0,0,0,0,0,1,0", "1e-19 to 1e19 apart"),
            ("0,3,0,0,0,0,0,1,0", "not along the view"),
        ] {
            let error = bad.parse::<LookAt>().expect_err(bad);
            assert!(error.contains(expected), "{bad}: {error}");
        }
    }

    #[test]
    fn angles_of_view_are_below_half_a_turn() {
        for good in ["1e-3", "40", "179.9"] {
            assert!(angle_of_view(good).is_ok(), "{good}");
        }
        for bad in ["0", "-1", "180", "nan", "inf", "wide", ""] {
            assert!(angle_of_view(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_material_is_turned_on() {
        let emit: Emit = "a=b=1,2,3".parse().expect("a material and a colour");
        assert_eq!(emit.material, "a=b", "the last sign divides");
        assert_eq!(emit.radiance, Vec3::new(1.0, 2.0, 3.0), "red, green, blue");
        for bad in ["lamp", "lamp=1,2", "lamp=1,2,x", "lamp=1,-1,1"] {
            assert!(bad.parse::<Emit>().is_err(), "{bad}");
        }
    }

    #[test]
    fn ranges_have_samples() {
        assert_eq!(sample_range("3..7"), Ok(3..7), "four samples");
        for bad in ["", "3", "7..3", "3..3", "-1..2", "a..b"] {
            assert!(sample_range(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn pixels_have_two_whole_numbers() {
        assert_eq!(pixel("3, 4"), Ok([3, 4]), "column and row");
        for bad in ["", "3", "3,4,5", "-1,0", "1.5,0", "a,b"] {
            assert!(pixel(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn times_are_longer_than_nothing_and_shorter_than_a_life() {
        assert_eq!(
            seconds("0.5"),
            Ok(Duration::from_millis(500)),
            "half a second"
        );
        assert_eq!(
            seconds("1e9"),
            Ok(Duration::from_secs(1_000_000_000)),
            "the longest"
        );
        assert_eq!(
            seconds("1e-30"),
            Ok(Duration::from_nanos(1)),
            "the shortest"
        );
        for bad in ["0", "-1", "1e30", "inf", "nan", "x", ""] {
            assert!(seconds(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn threads_are_counted() {
        assert_eq!(threads("0"), Ok(0), "one a core");
        assert_eq!(threads("1024"), Ok(1024), "many");
        for bad in ["1025", "100000", "-1", "1.5", "nan", "18446744073709551616"] {
            assert!(threads(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn counts_are_above_zero() {
        assert_eq!(count("1").map(NonZeroU32::get), Ok(1), "one");
        assert_eq!(
            count("4294967295").map(NonZeroU32::get),
            Ok(u32::MAX),
            "all"
        );
        for bad in ["0", "-1", "1.5", "4294967296", "x", ""] {
            assert!(
                count(bad).is_err_and(|words| words.contains("from 1")),
                "{bad}"
            );
        }
    }

    #[test]
    fn finite_numbers_are_finite() {
        assert_eq!(finite("-90"), Ok(-90.0), "a number");
        for bad in ["inf", "nan", "1e400", "x", ""] {
            assert!(finite(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn positive_numbers_are_positive() {
        assert_eq!(positive("0.5"), Ok(0.5), "a number");
        for bad in ["0", "-1", "inf", "nan", "x", ""] {
            assert!(positive(bad).is_err(), "{bad}");
        }
    }
}
