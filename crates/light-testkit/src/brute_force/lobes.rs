use light_bounds::LightExtent;
use light_sources::{Light, LightRef};

use super::model::Model;
use super::point_truth::PointTruth;
use super::stratified::Stratified;
use crate::Rng;

/// Rows of cells.
const SIDE: u32 = 192;

/// By how much the mean direction of a lobe may be off, which takes one direction for each part of a
/// picture, and its spread, as a part of it.
const COARSENESS: [f64; 2] = [4e-3, 2e-2];

/// The moments of the emission of a light that has a lobe.
pub(super) fn lobe_holds<M: Model>(
    light: &LightRef<'_, M>,
    truth: &PointTruth,
    rng: &mut Rng,
) -> Result<(), String> {
    let LightExtent::Lobe(_, lobe) = light.extent() else {
        return Ok(());
    };
    // The brightest channel counts; at wavelengths all parts of a picture have one shape.
    let brightest = |values: [f64; 4]| values.into_iter().fold(0.0, f64::max);
    let line = lobe.line();
    let sums = Stratified::<5>::over_square(truth.rows(SIDE), rng, |at, _| {
        let (w, solid_angle) = truth.direction(at);
        let intensity = brightest(truth.intensity(w));
        let [x, y, z] = (w * intensity * solid_angle).to_array();
        [x, y, z, intensity * solid_angle, 0.0]
    });
    let [x, y, z, power, _] = sums.values();
    let margin = sums.margin(&Stratified::default());
    if !(power > 0.0) {
        return Ok(());
    }
    let chance = margin[..4].iter().copied().fold(0.0, f64::max) / power;
    let mean = [x, y, z].map(|sum| sum / power);
    let off = (0..3).map(|i| (mean[i] - f64::from(lobe.mean[i])).abs());
    let off = off.fold(0.0, f64::max);
    if !(off <= COARSENESS[0] + 2.0 * chance) {
        return Err(format!(
            "the mean direction is {mean:?}, not that of {lobe:?}"
        ));
    }
    let is_power = (f64::from(lobe.power) - power).abs() <= (1e-4 + chance) * power;
    if M::is_linear() && !is_power {
        return Err(format!("the power is {power}, not that of {lobe:?}"));
    }
    // Intensities of a lobe are up to its own factor.
    let factor = f64::from(lobe.power) / power;
    let deviations = Stratified::<4>::over_square(truth.rows(SIDE), rng, |at, _| {
        let (w, solid_angle) = truth.direction(at);
        let intensity = brightest(truth.intensity(w));
        let relative = intensity * factor / f64::from(line.peak);
        let deviation = relative - f64::from(line.relative_intensity(w.as_vec3()));
        [
            deviation * deviation * intensity * solid_angle / power,
            0.0,
            0.0,
            0.0,
        ]
    });
    let [expected, ..] = deviations.values().map(f64::sqrt);
    let [slack, ..] = deviations.margin(&Stratified::default()).map(f64::sqrt);
    let off = (f64::from(lobe.spread) - expected).abs();
    if off <= COARSENESS[1] * (1.0 + expected) + slack + 2.0 * chance * expected {
        return Ok(());
    }
    Err(format!("the spread is {expected}, not that of {lobe:?}"))
}
