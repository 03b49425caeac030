use light_math::spectrum::cie::{LAMBDA_MAX, LAMBDA_MIN};
use light_math::spectrum::{
    Daylight, RgbIlluminant, SampledSpectrum, SampledWavelengths, Spectrum, UpliftTable,
};

use crate::color::{ColorModel, Radiance};
use crate::flux::Flux;
use crate::glam::Vec3;
use crate::spectral_emission::SpectralEmission;

/// The spectral colour model, with `N` sampled wavelengths per query.
///
/// Emissions, and what queries return, are per nanometre: `Radiometric(1.0)` of a spectrum that is 1
/// is 1 W m^-2 sr^-1 nm^-1. White of an image, `(1, 1, 1)`, is D65 with the
/// [mean](light_math::spectrum::cie::xyz) luminance 1, as in pbrt's lights: it is
/// [`Y_INTEGRAL`](light_math::spectrum::cie::Y_INTEGRAL), 106.9, times as bright as white of the same
/// amount in [`Rgb`](crate::Rgb), 72,982 nit in place of 683. Photometric amounts and powers make the
/// same light in both models; for an image whose white is `Radiometric(1.0)` in `Rgb` that amount is
/// `Luminance(Nit(683.0))`.
///
/// The example [`spectral`][1] makes a picture with it; [`spectral_and_rgb`][2] has the same lamps in
/// both models.
///
/// [1]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/spectral.rs
/// [2]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/spectral_and_rgb.rs
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spectral<const N: usize>;

impl<const N: usize> Radiance for SampledSpectrum<N> {
    const BLACK: Self = Self::ZERO;

    #[inline]
    fn splat(value: f32) -> Self {
        Self::splat(value)
    }

    #[inline]
    fn map(self, f: impl Fn(f32) -> f32) -> Self {
        self.map(f)
    }

    #[inline]
    fn is_black(self) -> bool {
        self.is_zero()
    }

    #[inline]
    fn average(self) -> f32 {
        Self::average(&self)
    }

    #[inline]
    fn maximum(self) -> f32 {
        self.max_element()
    }
}

impl<const N: usize> ColorModel for Spectral<N> {
    type Wavelengths = SampledWavelengths<N>;
    type Emission = SpectralEmission;
    type Radiance = SampledSpectrum<N>;

    #[inline]
    fn emit(emission: &SpectralEmission, wavelengths: &Self::Wavelengths) -> Self::Radiance {
        emission.sample(wavelengths)
    }

    /// A smooth spectrum times D65, so that a grey texel has the spectrum of daylight.
    #[inline]
    fn emit_texel(rgb: Vec3, wavelengths: &Self::Wavelengths) -> Self::Radiance {
        RgbIlluminant::clamped(&UpliftTable::SRGB, Daylight::D65, rgb).sample(wavelengths)
    }

    fn maximum(emission: &SpectralEmission) -> f32 {
        emission.max_value()
    }

    fn is_valid(emission: &SpectralEmission) -> bool {
        emission.is_valid()
    }

    /// The integrals over the spectrum, which is per nm.
    fn flux(emission: &SpectralEmission) -> Flux {
        Flux::of_spectrum(emission)
    }

    fn flux_of_texel(rgb: Vec3) -> Flux {
        Flux::of_spectrum(&RgbIlluminant::clamped(
            &UpliftTable::SRGB,
            Daylight::D65,
            rgb,
        ))
    }

    /// Spread over the wavelengths that the eye responds to.
    fn reference_wavelengths() -> Self::Wavelengths {
        SampledWavelengths::visible(0.5)
    }

    /// The estimate of the mean over the spectrum, each wavelength divided by its density.
    #[inline]
    fn mean(value: Self::Radiance, wavelengths: &Self::Wavelengths) -> f32 {
        let density = SampledSpectrum::new(*wavelengths.pdf());
        value.safe_div(density).average() / (LAMBDA_MAX - LAMBDA_MIN)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glam::Vec2;
    use crate::{IntensityAmount, Light, MediumInterface, PdfCoverage, PointLight, PointLightDesc};
    use light_bounds::LightSampleContext;
    use light_math::spectrum::{Blackbody, Constant, RgbColorSpace, UpliftSolver, cie};

    type S4 = Spectral<4>;

    #[test]
    fn a_grey_texel_is_daylight() {
        let w = SampledWavelengths::from_lambda([450.0, 550.0, 600.0, 650.0]);
        let texel = S4::emit_texel(Vec3::splat(2.0), &w);
        // The values of a reference renderer for its sRGB illuminant.
        let expected = [1.183_213_8, 1.052_138_9, 0.910_165, 0.809_250_8];
        for (value, expected) in texel.values().iter().zip(expected) {
            assert!((value / (2.0 * expected) - 1.0).abs() < 1e-5, "{texel:?}");
        }
    }

    #[test]
    fn means_over_many_wavelengths_are_means_over_the_spectrum() {
        let emission = SpectralEmission::from(Blackbody::new(4000.0).expect("valid"));
        let exact: f32 = (0..470)
            .map(|i| emission.eval(360.5 + i as f32) / 470.0)
            .sum();
        let n = 500;
        let mean: f32 = (0..n)
            .map(|i| {
                let w = SampledWavelengths::visible((i as f32 + 0.5) / n as f32);
                S4::mean(S4::emit(&emission, &w), &w) / n as f32
            })
            .sum();
        assert!((mean / exact - 1.0).abs() < 0.01, "{mean} for {exact}");
    }

    #[test]
    fn a_lamp_keeps_its_colour_on_the_way() {
        let space = RgbColorSpace::srgb();
        let rgb = Vec3::new(1.0, 0.6, 0.2);
        let uplift = UpliftSolver::new(&space);
        let emission = RgbIlluminant::new(&uplift, space.illuminant(), rgb).expect("valid");
        let lamp = PointLight::<S4>::new(PointLightDesc {
            position: Vec3::ZERO,
            emission: emission.into(),
            amount: IntensityAmount::Radiometric(4.0),
            media: MediumInterface::default(),
        })
        .expect("valid");
        let ctx = LightSampleContext::medium(Vec3::new(0.0, 0.0, 2.0));
        let n = 200;
        let mut xyz = Vec3::ZERO;
        for i in 0..n {
            let w = SampledWavelengths::uniform((i as f32 + 0.5) / n as f32);
            let sample = lamp.sample_li(&ctx, Vec2::ZERO, &w, PdfCoverage::Complete);
            xyz += cie::sampled_xyz(&sample.expect("lit").l, &w) / n as f32;
        }
        let seen = space.rgb_from_xyz() * xyz;
        assert!(seen.distance(rgb) < 5e-3, "4 W/sr at 2 m: {seen}");
    }

    #[test]
    fn validity_refuses_what_no_light_emits() {
        assert!(S4::is_valid(&Constant(0.0).into()), "black is an emission");
        for bad in [-1.0, f32::NAN, f32::INFINITY] {
            assert!(!S4::is_valid(&Constant(bad).into()), "{bad}");
        }
    }
}
