use super::arrival::excess;
use super::model::Values;
use super::stratified::Stratified;
use crate::Rng;

/// The power of a light as the library has it.
pub(super) struct Power {
    /// At the wavelengths of a query.
    pub(super) phi: Values,
    /// Over the channels or the spectrum.
    pub(super) radiant: f64,
}

/// What leaves a light, by quadrature.
pub(super) struct Leaving {
    pub(super) phi: Values,
    /// The power of what has the value 1 in the middle of the beam.
    pub(super) etendue: f64,
    /// By how much chance may move it, as a part of it.
    pub(super) chance: f64,
}

/// Rows of cells of the first comparison, and of the one that confirms a difference.
const SIDES: [u32; 2] = [48, 512];

/// The power is what leaves the light: per wavelength, and as one number by `radiant`, the integral
/// of the spectrum with its error, of which the values are `values` at the wavelengths; NaN where
/// that is no part of the comparison.
pub(super) fn power_holds<const N: usize>(
    found: Power,
    [radiant, radiant_error]: [f64; 2],
    values: Values,
    rng: &mut Rng,
    leaving: impl Fn(u32, &mut Rng) -> Stratified<N>,
) -> Result<Leaving, String> {
    let mut fault = String::new();
    let brightest = (0..4).fold(0, |best, i| if values[i] > values[best] { i } else { best });
    for side in SIDES {
        let integral = leaving(side, rng);
        let margin = integral.margin(&Stratified::default());
        let expected: Values = core::array::from_fn(|i| integral.values()[i]);
        let margin: Values = core::array::from_fn(|i| margin[i]);
        // The beam has one shape at all wavelengths.
        let etendue = expected[brightest] / values[brightest];
        let off = excess(&found.phi, &expected, &margin);
        let most = radiant * etendue;
        let chance = margin[brightest] / values[brightest] * radiant;
        let slack = 1.001 * radiant_error * etendue + 1e-4 * most + chance;
        let is_radiant = !(most.is_finite()) || (found.radiant - most).abs() <= slack;
        let is_positive = found.radiant > 0.0 || expected == [0.0; 4];
        if off == [0.0; 4] && is_radiant && is_positive {
            return Ok(Leaving {
                phi: expected,
                etendue,
                chance: margin[brightest] / expected[brightest],
            });
        }
        fault = format!(
            "power {:?}, not {expected:?}, beyond chance by {off:?}; in total {}, not {most}",
            found.phi, found.radiant
        );
    }
    Err(fault)
}
