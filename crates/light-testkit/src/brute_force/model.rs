use alloc::sync::Arc;

use light_math::glam::{DVec3, Vec3};
use light_math::spectrum::cie::matching;
use light_math::spectrum::{
    Blackbody, Constant, Daylight, DenselySampled, PiecewiseLinear, RgbIlluminant, RgbUnbounded,
    SampledWavelengths, Spectrum, UpliftTable,
};
use light_sources::{ColorModel, Rgb, Spectral, SpectralEmission};

use crate::Rng;

/// The channels or wavelengths of a query.
pub(super) type Values = [f64; 4];

/// A colour model of which emissions are known in double precision.
pub(super) trait Model: ColorModel {
    fn random_wavelengths(rng: &mut Rng) -> Self::Wavelengths;

    fn random_emission(rng: &mut Rng) -> Self::Emission;

    /// The values of an emission, by its description.
    fn values_of(emission: &Self::Emission, wavelengths: &Self::Wavelengths) -> Values;

    /// A result of a query as plain numbers.
    fn values(radiance: Self::Radiance) -> Values;

    /// The radiant quantity of an emission, and by how much the sum over nanometres may be off.
    fn radiant(emission: &Self::Emission) -> [f64; 2];

    /// The luminous quantity of an emission, by sums over whole nanometres.
    fn luminous(emission: &Self::Emission) -> f64;

    /// The luminous and the radiant quantity of a texel.
    fn flux_of(rgb: DVec3) -> [f64; 2];

    /// Values of a white texel, by which powers of pictures are compared, and its radiant quantity
    /// with its error.
    fn white(wavelengths: &Self::Wavelengths) -> (Values, [f64; 2]);

    /// Whether the power of a coloured picture is that of its mean colour.
    fn is_linear() -> bool;
}

impl Model for Rgb {
    fn random_wavelengths(_: &mut Rng) {}

    fn random_emission(rng: &mut Rng) -> Vec3 {
        match rng.below(4) {
            0 => [Vec3::X, Vec3::Y, Vec3::Z][rng.below(3)],
            _ => rng.vec3() + 1e-3,
        }
    }

    fn values_of(emission: &Vec3, (): &()) -> Values {
        Self::values(*emission)
    }

    fn values(radiance: Vec3) -> Values {
        let [r, g, b] = radiance.to_array().map(f64::from);
        [r, g, b, (r + g + b) / 3.0]
    }

    fn radiant(emission: &Vec3) -> [f64; 2] {
        [Self::values(*emission)[3], 0.0]
    }

    fn luminous(emission: &Vec3) -> f64 {
        Self::flux_of(emission.as_dvec3())[0]
    }

    fn flux_of(rgb: DVec3) -> [f64; 2] {
        // Y of the primaries of IEC 61966-2-1.
        const LUMINANCE: DVec3 = DVec3::new(0.212_639_005_9, 0.715_168_678_8, 0.072_192_315_4);
        [683.0 * LUMINANCE.dot(rgb), rgb.element_sum() / 3.0]
    }

    fn white((): &()) -> (Values, [f64; 2]) {
        // The mean over the channels is linear in all of them.
        ([0.0, 0.0, 0.0, 1.0], [1.0, 0.0])
    }

    fn is_linear() -> bool {
        true
    }
}

impl Model for Spectral<4> {
    fn random_wavelengths(rng: &mut Rng) -> SampledWavelengths<4> {
        SampledWavelengths::visible(rng.f32())
    }

    fn random_emission(rng: &mut Rng) -> SpectralEmission {
        let mut own = Rng::new(rng.clone().u64());
        if own.below(2) == 0 {
            return random_colour(&mut own);
        }
        match rng.below(4) {
            0 => Constant(rng.f32() + 0.1).into(),
            1 => {
                let kelvin = rng.log_range(1000.0, 30_000.0);
                Blackbody::new(kelvin).expect("a temperature").into()
            }
            // A line, of which most sampled wavelengths see nothing.
            2 => {
                let (middle, width) = (rng.range(380.0, 780.0), rng.log_range(1e-3, 30.0));
                linear(
                    vec![middle - width, middle, middle + width],
                    vec![0.0, 1.0, 0.0],
                )
            }
            _ => {
                let lambdas = (0..12u8).map(|i| 340.0 + 45.0 * f32::from(i));
                let values = (0..12).map(|_| [0.0, rng.f32()][rng.below(2)]);
                linear(lambdas.collect(), values.collect())
            }
        }
    }

    fn values_of(emission: &SpectralEmission, wavelengths: &SampledWavelengths<4>) -> Values {
        wavelengths
            .lambda()
            .map(|lambda| spectrum_at(emission, f64::from(lambda)))
    }

    fn values(radiance: Self::Radiance) -> Values {
        radiance.values().map(f64::from)
    }

    fn radiant(emission: &SpectralEmission) -> [f64; 2] {
        const PARTS: u32 = 32;
        let step = 1.0 / f64::from(PARTS);
        let parts = (0..470 * PARTS).map(|i| 360.0 + step * (f64::from(i) + 0.5));
        let sum: f64 = parts.map(|lambda| spectrum_at(emission, lambda)).sum();
        [sum * step, f64::from(emission.max_value())]
    }

    fn luminous(emission: &SpectralEmission) -> f64 {
        let visible = (360..=830u16).map(f32::from);
        let seen =
            |lambda: f32| f64::from(matching(lambda).y) * spectrum_at(emission, lambda.into());
        683.0 * visible.map(seen).sum::<f64>()
    }

    fn flux_of(rgb: DVec3) -> [f64; 2] {
        // The model's own function takes numbers that a float holds.
        let largest = rgb.max_element().max(f64::MIN_POSITIVE);
        let flux = Self::flux_of_texel((rgb / largest).as_vec3());
        [flux.luminous, flux.radiant].map(|value| f64::from(value) * largest)
    }

    fn white(wavelengths: &SampledWavelengths<4>) -> (Values, [f64; 2]) {
        let radiant = Self::flux_of_texel(Vec3::ONE).radiant;
        let values = Self::values(Self::emit_texel(Vec3::ONE, wavelengths));
        (values, [radiant.into(), 0.0])
    }

    fn is_linear() -> bool {
        false
    }
}

/// Daylight, the spectrum of a colour, or one that is measured at each nanometre.
fn random_colour(rng: &mut Rng) -> SpectralEmission {
    let rgb = match rng.below(3) {
        0 => [Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE][rng.below(4)],
        _ => rng.vec3() + 1e-3,
    };
    let kelvin = rng.range(4000.0, 25_000.0);
    let daylight = Daylight::from_temperature(kelvin).expect("a temperature");
    match rng.below(4) {
        0 => daylight.into(),
        1 => RgbIlluminant::clamped(&UpliftTable::SRGB, Daylight::D65, rgb).into(),
        2 => RgbUnbounded::clamped(&UpliftTable::SRGB, rgb).into(),
        _ => {
            let values: Arc<[f32]> = (0..DenselySampled::<Arc<[f32]>>::LEN)
                .map(|_| [0.0, rng.f32()][rng.below(2)])
                .collect();
            DenselySampled::new(values).expect("a spectrum").into()
        }
    }
}

fn linear(lambdas: Vec<f32>, values: Vec<f32>) -> SpectralEmission {
    let [lambdas, values]: [Arc<[f32]>; 2] = [lambdas.into(), values.into()];
    PiecewiseLinear::new(lambdas, values)
        .expect("a spectrum")
        .into()
}

/// A spectrum at a wavelength in nm.
fn spectrum_at(emission: &SpectralEmission, lambda: f64) -> f64 {
    match emission {
        SpectralEmission::Constant(constant) => constant.0.into(),
        SpectralEmission::Blackbody(body) => {
            let planck = |lambda: f64, kelvin: f64| {
                // h c / k in nm K.
                const SECOND: f64 = 1.438_776_877e7;
                1.0 / (lambda.powi(5) * (SECOND / (lambda * kelvin)).exp_m1())
            };
            let kelvin = f64::from(body.kelvin());
            planck(lambda, kelvin) / planck(2_897_771.955 / kelvin, kelvin)
        }
        SpectralEmission::PiecewiseLinear(linear) => {
            let pair = |values: &[f32]| [values[0], values[1]].map(f64::from);
            let pieces = linear.lambdas().windows(2).zip(linear.values().windows(2));
            let at = |(x, y): (&[f32], &[f32])| {
                let ([x0, x1], [y0, y1]) = (pair(x), pair(y));
                let part = (lambda - x0) / (x1 - x0);
                (0.0..1.0).contains(&part).then_some(y0 + (y1 - y0) * part)
            };
            pieces.map(at).find_map(|value| value).unwrap_or(0.0)
        }
        other => other.eval(lambda as f32).into(),
    }
}
