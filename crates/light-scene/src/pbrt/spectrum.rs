//! Spectra of pbrt files as linear sRGB.

use lights::math::spectrum::{Blackbody, Daylight, PiecewiseLinear, RgbColorSpace, Spectrum, cie};

use super::tokens::number_of;
use crate::glam::Vec3;

/// The share that a surface of this spectrum (wavelength in nm and value by turns) reflects of
/// daylight.
pub(super) fn reflectance(pairs: &[f32]) -> Option<Vec3> {
    unbounded(pairs).map(|rgb| rgb.min(Vec3::ONE))
}

/// The colour of this spectrum seen by daylight, without a bound above.
pub(super) fn unbounded(pairs: &[f32]) -> Option<Vec3> {
    let (reflectance, light) = (piecewise(pairs)?, RgbColorSpace::srgb().illuminant());
    // Straight between its own wavelengths and whole nanometres, so that narrow features count.
    let own = reflectance.lambdas();
    let ends = *own.first()?..=*own.last()?;
    let whole = (0u16..)
        .map(|i| cie::LAMBDA_MIN + f32::from(i))
        .take_while(|lambda| *lambda <= cie::LAMBDA_MAX)
        .filter(|lambda| ends.contains(lambda));
    let mut lambdas: Vec<f32> = own.iter().copied().chain(whole).collect();
    lambdas.sort_unstable_by(f32::total_cmp);
    lambdas.dedup();
    let value = |&lambda: &f32| reflectance.eval(lambda) * light.eval(lambda);
    let values = lambdas.iter().map(value).collect();
    color_of_lit(&PiecewiseLinear::new(lambdas, values).ok()?)
}

/// The colour, seen by daylight, of a surface that reflects as a black body of this temperature in
/// kelvin emits: all of the light at its brightest wavelength.
pub(super) fn blackbody_share(kelvin: f32) -> Option<Vec3> {
    by_daylight(Blackbody::new(kelvin).ok()?)
}

fn by_daylight(reflectance: impl Spectrum) -> Option<Vec3> {
    let lit = Lit {
        reflectance,
        light: RgbColorSpace::srgb().illuminant(),
    };
    color_of_lit(&lit)
}

/// The colour of a surface from the spectrum that it reflects by daylight.
fn color_of_lit(lit: &impl Spectrum) -> Option<Vec3> {
    let space = RgbColorSpace::srgb();
    let white = cie::xyz(&space.illuminant()).y;
    let rgb = space.rgb_from_xyz() * cie::xyz(lit) / white;
    rgb.is_finite().then(|| rgb.max(Vec3::ZERO))
}

/// The colour of a light of this spectrum, of luminance 1 unless it is black.
pub(super) fn emission(pairs: &[f32]) -> Option<Vec3> {
    if pairs.iter().skip(1).step_by(2).all(|&value| value == 0.0) {
        return piecewise(pairs).map(|_| Vec3::ZERO);
    }
    of_luminance_one(&piecewise(pairs)?)
}

/// The colour of a light whose spectrum has a name, of luminance 1.
pub(super) fn named_emission(name: &str) -> Option<Vec3> {
    match name {
        "stdillum-A" => blackbody(2855.5),
        "stdillum-D50" => of_luminance_one(&Daylight::D50),
        "stdillum-D65" => of_luminance_one(&Daylight::D65),
        _ => None,
    }
}

/// The numbers in the text of a spectrum's file: wavelength in nm and value by turns, `#` before
/// what is not one.
pub(super) fn pairs_of(text: &str) -> Option<Vec<f64>> {
    let plain = text
        .lines()
        .map(|line| line.split('#').next().unwrap_or_default());
    let words = plain.flat_map(str::split_whitespace);
    let number = |word: &str| number_of(word).and_then(|_| word.parse().ok());
    let numbers: Vec<f64> = words.map(number).collect::<Option<_>>()?;
    (!numbers.is_empty() && numbers.len() % 2 == 0).then_some(numbers)
}

/// The colour of a black body of this temperature in kelvin, of luminance 1.
pub(super) fn blackbody(kelvin: f32) -> Option<Vec3> {
    of_luminance_one(&Blackbody::new(kelvin).ok()?)
}

fn of_luminance_one(spectrum: &impl Spectrum) -> Option<Vec3> {
    let xyz = cie::xyz(spectrum);
    let rgb = RgbColorSpace::srgb().rgb_from_xyz() * xyz / xyz.y;
    rgb.is_finite().then(|| rgb.max(Vec3::ZERO))
}

fn piecewise(pairs: &[f32]) -> Option<PiecewiseLinear<Vec<f32>>> {
    let every_second = |from: usize| pairs.iter().skip(from).step_by(2).copied().collect();
    PiecewiseLinear::new(every_second(0), every_second(1)).ok()
}

/// Light that a surface reflects.
struct Lit<S> {
    reflectance: S,
    light: Daylight,
}

impl<S: Spectrum> Spectrum for Lit<S> {
    fn eval(&self, lambda: f32) -> f32 {
        self.reflectance.eval(lambda) * self.light.eval(lambda)
    }

    fn max_value(&self) -> f32 {
        self.reflectance.max_value() * self.light.max_value()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lights::math::spectrum::rec709_luminance;

    #[test]
    fn constants_are_grey_and_black_bodies_warm() {
        let grey = reflectance(&[300.0, 0.5, 900.0, 0.5]).expect("a spectrum");
        assert!(grey.abs_diff_eq(Vec3::splat(0.5), 2e-3), "grey, not {grey}");
        let warm = blackbody(2700.0).expect("a temperature");
        assert!(warm.x > warm.y && warm.y > warm.z, "orange, not {warm}");
        let luminance = rec709_luminance(warm);
        assert!(
            (luminance - 1.0).abs() < 0.01,
            "luminance 1, not {luminance}"
        );
        assert_eq!(blackbody(-1.0), None, "no temperature");
        // As a surface it is as warm, but reflects at most all light: a red wavelength and more.
        let share = blackbody_share(2700.0).expect("a temperature");
        assert!(share.max_element() < 1.0, "{share}");
        assert!(
            share.x > share.y && share.y > share.z,
            "orange, not {share}"
        );
        let white = blackbody_share(6500.0).expect("a temperature");
        assert!(white.min_element() > 0.7, "{white}");
        assert_eq!(reflectance(&[1.0]), None, "no pair");
        // Half a nanometre that is lost in between whole ones, and a whole one.
        let hole = [300.0, 0.5, 599.25, 0.5, 599.5, 0.0, 599.75, 0.5, 900.0, 0.5];
        let holed = unbounded(&hole).expect("a spectrum");
        assert!(holed.x < grey.x - 1e-4, "{holed} and {grey}");
        // A line of .2 nm has the colour of one of its wavelength, wherever whole nanometres are.
        let line = |middle: f32| emission(&[middle - 0.1, 0.0, middle, 1.0, middle + 0.1, 0.0]);
        let [on, off] = [546.0, 546.3].map(|middle| line(middle).expect("a spectrum"));
        assert!(on.abs_diff_eq(off, 0.02), "{on} and {off}");
        let black = emission(&[400.0, 0.0, 700.0, 0.0]);
        assert_eq!(black, Some(Vec3::ZERO), "no light, not white");
    }
}
