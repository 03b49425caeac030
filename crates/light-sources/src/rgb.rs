use crate::color::{ColorModel, Radiance};
use crate::flux::Flux;
use crate::glam::Vec3;
use light_math::spectrum::photometric::K_M;
use light_math::spectrum::rec709_luminance;

/// The colour model of linear RGB: three floats for an emission and for a radiance, no wavelengths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rgb;

impl Radiance for Vec3 {
    const BLACK: Self = Self::ZERO;

    #[inline]
    fn splat(value: f32) -> Self {
        Self::splat(value)
    }

    #[inline]
    fn map(self, f: impl Fn(f32) -> f32) -> Self {
        Self::new(f(self.x), f(self.y), f(self.z))
    }

    #[inline]
    fn is_black(self) -> bool {
        self == Self::ZERO
    }

    #[inline]
    fn average(self) -> f32 {
        self.element_sum() / 3.0
    }

    #[inline]
    fn maximum(self) -> f32 {
        self.max_element()
    }
}

impl ColorModel for Rgb {
    type Wavelengths = ();
    type Emission = Vec3;
    type Radiance = Vec3;

    #[inline]
    fn emit(emission: &Vec3, (): &()) -> Vec3 {
        *emission
    }

    #[inline]
    fn emit_texel(rgb: Vec3, (): &()) -> Vec3 {
        rgb
    }

    #[inline]
    fn maximum(emission: &Vec3) -> f32 {
        emission.max_element()
    }

    fn is_valid(emission: &Vec3) -> bool {
        emission.is_finite() && emission.cmpge(Vec3::ZERO).all()
    }

    /// White, `(1, 1, 1)`, is 1 W and 683 lm, as 1 W of 555 nm. The luminous flux of other colours
    /// is in proportion to their luminance, the radiant flux is the mean of their channels.
    fn flux(emission: &Vec3) -> Flux {
        Self::flux_of_texel(*emission)
    }

    fn flux_of_texel(rgb: Vec3) -> Flux {
        Flux {
            luminous: K_M * rec709_luminance(rgb),
            radiant: rgb.average(),
        }
    }

    fn reference_wavelengths() {}

    #[inline]
    fn mean(value: Vec3, (): &()) -> f32 {
        value.average()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_math::spectrum::RgbColorSpace;

    #[test]
    fn validity_refuses_what_no_light_emits() {
        assert!(Rgb::is_valid(&Vec3::ZERO), "black is an emission");
        assert!(!Rgb::is_valid(&Vec3::new(1.0, -1e-9, 0.0)), "negative");
        assert!(!Rgb::is_valid(&Vec3::new(1.0, f32::NAN, 0.0)), "NaN");
        assert!(!Rgb::is_valid(&Vec3::new(f32::INFINITY, 0.0, 0.0)), "inf");
    }

    #[test]
    fn an_emission_is_its_radiance() {
        let e = Vec3::new(1.0, 2.0, 6.0);
        assert_eq!(Rgb::emit(&e, &()), e, "identity");
        assert_eq!(Rgb::maximum(&e), 6.0, "maximum");
        assert_eq!(Rgb::mean(e, &()), 3.0, "mean");
    }

    #[test]
    fn luminance_is_that_of_the_colour_space() {
        let space = RgbColorSpace::srgb();
        for rgb in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE] {
            let flux = Rgb::flux(&rgb);
            let expected = 683.0 * space.luminance(rgb);
            assert!((flux.luminous - expected).abs() < 0.1, "{rgb}: {flux:?}");
        }
        assert_eq!(Rgb::flux(&Vec3::ONE).radiant, 1.0, "white is a watt");
    }
}
