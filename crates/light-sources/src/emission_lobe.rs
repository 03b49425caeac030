use crate::glam::Vec3;
use crate::rgb_sum::{RgbSum, single};
use light_bounds::EmissionLobe;

/// The intensity in a small solid angle around a direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Emitted {
    /// Unit vector away from the light.
    pub(crate) w: Vec3,
    /// In W/sr.
    pub(crate) intensity: f32,
    /// In sr.
    pub(crate) solid_angle: f32,
}

/// The lobe of a light with the intensities `emitted`, which is iterated twice.
pub(crate) fn emission_lobe<I: Iterator<Item = Emitted>>(emitted: impl Fn() -> I) -> EmissionLobe {
    let weight = |e: &Emitted| f64::from(e.intensity) * f64::from(e.solid_angle);
    let (mut power, mut directions) = (0.0, RgbSum::default());
    for e in emitted() {
        power += weight(&e);
        directions.add(e.w, weight(&e));
    }
    let lobe = EmissionLobe {
        power: single(power).min(f32::MAX),
        mean: directions.over(power),
        spread: 0.0,
    };
    let line = lobe.line();
    if !(power > 0.0 && line.peak > 0.0) {
        return lobe;
    }
    let mut deviations = 0.0;
    for e in emitted() {
        let relative = f64::from(e.intensity) / f64::from(line.peak);
        let deviation = relative - f64::from(line.relative_intensity(e.w));
        deviations += deviation * deviation * weight(&e);
    }
    EmissionLobe {
        spread: light_math::float::sqrt(single(deviations / power).min(f32::MAX)),
        ..lobe
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_math::equal_area::square_to_sphere;
    use light_math::glam::Vec2;

    /// The sphere in cells of one solid angle, with an intensity for each.
    fn sphere(intensity: impl Fn(Vec3) -> f32) -> EmissionLobe {
        const N: u16 = 256;
        let cells = || (0..N).flat_map(|y| (0..N).map(move |x| [x, y]));
        emission_lobe(|| {
            cells().map(|cell| {
                let at = Vec2::from_array(cell.map(f32::from)) + 0.5;
                let w = square_to_sphere(at / f32::from(N));
                Emitted {
                    w,
                    intensity: intensity(w),
                    solid_angle: 4.0 * core::f32::consts::PI / f32::from(N) / f32::from(N),
                }
            })
        })
    }

    #[test]
    fn lights_that_are_lines_have_no_spread() {
        let all_around = sphere(|_| 3.0);
        assert!(
            (all_around.power - 12.0 * core::f32::consts::PI).abs() < 1e-2,
            "{all_around:?}"
        );
        assert!(all_around.mean.length() < 1e-5, "{all_around:?}");
        assert!(all_around.spread < 1e-4, "{all_around:?}");
        let lambert = sphere(|w| w.y.max(0.0));
        assert!(
            (lambert.power - core::f32::consts::PI).abs() < 1e-2,
            "{lambert:?}"
        );
        assert!(
            lambert.mean.distance(Vec3::Y * 2.0 / 3.0) < 1e-3,
            "{lambert:?}"
        );
        assert!(lambert.spread < 1e-2, "{lambert:?}");
    }

    #[test]
    fn a_disc_of_light_spreads_about_its_line() {
        // Within 60 degrees: the line falls from 4/3 of the intensity to 4/9 of it at the edge.
        let disc = sphere(|w| if w.z > 0.5 { 1.0 } else { 0.0 });
        assert!(disc.mean.distance(Vec3::Z * 0.75) < 2e-3, "{disc:?}");
        assert!((disc.line().peak - 4.0 / 3.0).abs() < 2e-2, "{disc:?}");
        // The deviation is uniform from -1/4 to 5/12 of the peak.
        let expected = (((5.0f32 / 12.0).powi(3) + 0.25f32.powi(3)) / 2.0).sqrt();
        assert!((disc.spread - expected).abs() < 1e-2, "{disc:?}");
    }

    #[test]
    fn darkness_has_a_lobe_too() {
        let dark = sphere(|_| 0.0);
        assert!(dark.is_valid() && dark.power == 0.0, "{dark:?}");
    }
}
