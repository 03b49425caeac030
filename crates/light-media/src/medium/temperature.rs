use super::grid::Grid;
use alloc::vec::Vec;
use light_math::glam::Vec3;
use light_math::spectrum::{Blackbody, RgbColorSpace, cie};
use light_sources::{ColorModel, Radiance, Rgb, Spectral, SpectralEmission};

/// Temperature, in kelvin, below which visible emission is negligible.
const COLDEST: f32 = 100.0;

/// A colour model with the emission of black bodies.
pub trait Incandescence: ColorModel {
    /// The emission of a black body at `kelvin` above zero, 1 at the wavelength where it is
    /// brightest.
    fn blackbody(kelvin: f32) -> Option<Self::Emission>;
}

impl Incandescence for Rgb {
    /// In linear sRGB, where the constant spectrum 1 has luminance 1; colours are clamped to
    /// the gamut.
    fn blackbody(kelvin: f32) -> Option<Vec3> {
        let xyz = cie::xyz(&Blackbody::new(kelvin).ok()?);
        Some((RgbColorSpace::srgb().rgb_from_xyz() * xyz).max(Vec3::ZERO))
    }
}

impl<const N: usize> Incandescence for Spectral<N> {
    fn blackbody(kelvin: f32) -> Option<SpectralEmission> {
        Blackbody::new(kelvin).ok().map(SpectralEmission::Blackbody)
    }
}

/// Temperatures over the unit cube, with a table of their colours.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize, S: serde::Serialize")
)]
pub struct TemperatureGrid<C: ColorModel, S> {
    kelvin: Grid<S>,
    colors: Vec<C::Emission>,
    inv_step: f32,
}

impl<C: Incandescence, S: AsRef<[f32]>> TemperatureGrid<C, S> {
    /// Entries of the table of colours: interpolation has a relative error below 1 % for every
    /// emission above 1e-6 of the brightest.
    const STEPS: u16 = 1024;

    /// The emission of temperatures in kelvin. Colours are tabulated up to the hottest sample.
    #[must_use]
    pub fn new(kelvin: Grid<S>) -> Self {
        let step = kelvin.max_value().max(COLDEST) / f32::from(Self::STEPS);
        let color = |i: u16| C::blackbody(step * f32::from(i));
        Self {
            colors: (1..=Self::STEPS).filter_map(color).collect(),
            inv_step: 1.0 / step,
            kelvin,
        }
    }
}

impl<C: ColorModel, S: AsRef<[f32]>> TemperatureGrid<C, S> {
    /// An upper bound of the emission over the cube, for all wavelengths.
    pub(super) fn max_value(&self) -> f32 {
        self.colors.iter().map(C::maximum).fold(0.0, f32::max)
    }

    /// The emission at `p` of the unit cube.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at least 1 and at most the number of steps"
    )]
    pub(super) fn at(&self, p: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        let [kelvin] = self.kelvin.lookup(p);
        // Entry i of the table is for the temperature of i + 1 steps.
        let place = kelvin * self.inv_step - 1.0;
        if kelvin < COLDEST || !(place >= 0.0) {
            return C::Radiance::BLACK;
        }
        let below = place as usize;
        let emit = |i: usize| {
            let color = self.colors.get(i).or(self.colors.last());
            color.map_or(C::Radiance::BLACK, |color| C::emit(color, wavelengths))
        };
        let f = place - below as f32;
        emit(below) * (1.0 - f) + emit(below + 1) * f
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_math::spectrum::{SampledWavelengths, Spectrum};

    fn uniform(kelvin: f32, hottest: f32) -> Grid<[f32; 2]> {
        Grid::new([2, 1, 1], [kelvin, hottest]).expect("valid")
    }

    #[test]
    fn the_table_is_as_good_as_the_law() {
        let middle = Vec3::new(0.25, 0.5, 0.5);
        for kelvin in [900.0, 1500.0, 2856.0, 6504.0] {
            let rgb = TemperatureGrid::<Rgb, _>::new(uniform(kelvin, 9000.0)).at(middle, &());
            let expected = Rgb::blackbody(kelvin).expect("a temperature");
            let error = (rgb - expected).abs().max_element() / expected.max_element();
            assert!(error < 1e-2, "{kelvin} K: {rgb}, expected {expected}");

            let wavelengths = SampledWavelengths::<4>::visible(0.3);
            let grid = TemperatureGrid::<Spectral<4>, _>::new(uniform(kelvin, 9000.0));
            let glow = grid.at(middle, &wavelengths);
            let law = Blackbody::new(kelvin).expect("a temperature");
            for (i, lambda) in wavelengths.lambda().iter().enumerate() {
                let expected = law.eval(*lambda);
                assert!(
                    (glow[i] - expected).abs() < 1e-2 * expected + 1e-6,
                    "{kelvin} K at {lambda} nm: {} for {expected}",
                    glow[i]
                );
            }
        }
    }

    #[test]
    fn the_cold_does_not_glow() {
        let grid = TemperatureGrid::<Rgb, _>::new(uniform(99.0, 2000.0));
        assert_eq!(grid.at(Vec3::new(0.25, 0.5, 0.5), &()), Vec3::ZERO, "cold");
        let outside = grid.at(Vec3::splat(3.0), &());
        assert_eq!(outside, Vec3::ZERO, "outside");
    }
}
