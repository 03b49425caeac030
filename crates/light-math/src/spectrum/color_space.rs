use glam::{Mat3, Vec2, Vec3};

use super::{Daylight, cie};

/// An RGB colour space: what its three numbers mean in XYZ, and the light that is its white.
///
/// White, `(1, 1, 1)`, has the colour of the illuminant and the luminance `Y` = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RgbColorSpace {
    illuminant: Daylight,
    xyz_from_rgb: Mat3,
    rgb_from_xyz: Mat3,
}

impl RgbColorSpace {
    /// The space of the given red, green and blue (chromaticities `(x, y)`), and the given white.
    ///
    /// # Errors
    /// If the primaries lie on a line, if one is not finite, or if white lies on a line with two of
    /// them, so that the third has no part in it.
    pub fn new(primaries: [Vec2; 3], illuminant: Daylight) -> Result<Self, RgbColorSpaceError> {
        let [r, g, b] = primaries.map(|xy| Vec3::new(xy.x, xy.y, 1.0 - xy.x - xy.y));
        let unscaled = Mat3::from_cols(r, g, b);
        let determinant = unscaled.determinant();
        if !(determinant.abs() > 1e-6 && determinant.is_finite()) {
            return Err(RgbColorSpaceError::Primaries);
        }
        // As much of each primary as makes up white.
        let shares = unscaled.inverse() * cie::xyz(&illuminant);
        let xyz_from_rgb = Mat3::from_cols(r * shares.x, g * shares.y, b * shares.z);
        if !(xyz_from_rgb.determinant().abs() > 1e-6) {
            return Err(RgbColorSpaceError::Primaries);
        }
        Ok(Self {
            illuminant,
            xyz_from_rgb,
            rgb_from_xyz: xyz_from_rgb.inverse(),
        })
    }

    /// Linear sRGB, which shares its primaries with Rec. 709.
    ///
    /// # Source
    /// IEC 61966-2-1.
    #[must_use]
    pub fn srgb() -> Self {
        Self::standard([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]], Daylight::D65)
    }

    /// DCI-P3 with the white D65 ("Display P3").
    ///
    /// # Source
    /// SMPTE EG 432-1.
    #[must_use]
    pub fn dci_p3() -> Self {
        Self::standard(
            [[0.680, 0.320], [0.265, 0.690], [0.150, 0.060]],
            Daylight::D65,
        )
    }

    /// Rec. 2020 (and 2100), the space of ultra-high-definition television.
    ///
    /// # Source
    /// ITU-R BT.2020.
    #[must_use]
    pub fn rec2020() -> Self {
        Self::standard(
            [[0.708, 0.292], [0.170, 0.797], [0.131, 0.046]],
            Daylight::D65,
        )
    }

    /// ACES2065-1, which holds every visible colour; two of its primaries are none.
    ///
    /// # Source
    /// SMPTE ST 2065-1.
    #[must_use]
    pub fn aces2065_1() -> Self {
        Self::standard(
            [[0.7347, 0.2653], [0.0, 1.0], [0.0001, -0.077]],
            Daylight::ACES_D60,
        )
    }

    /// The light whose colour is white.
    #[inline]
    #[must_use]
    pub const fn illuminant(&self) -> Daylight {
        self.illuminant
    }

    /// The matrix from linear RGB to XYZ, column vectors; white has `Y` = 1.
    #[inline]
    #[must_use]
    pub const fn xyz_from_rgb(&self) -> Mat3 {
        self.xyz_from_rgb
    }

    /// The matrix from XYZ to linear RGB, column vectors.
    #[inline]
    #[must_use]
    pub const fn rgb_from_xyz(&self) -> Mat3 {
        self.rgb_from_xyz
    }

    /// The luminance `Y` of a colour; 1 for white.
    #[inline]
    #[must_use]
    pub fn luminance(&self, rgb: Vec3) -> f32 {
        rgb.dot(self.xyz_from_rgb.row(1))
    }

    fn standard(primaries: [[f32; 2]; 3], illuminant: Daylight) -> Self {
        Self::new(primaries.map(Vec2::from_array), illuminant)
            .expect("the primaries of a standard span a triangle")
    }
}

/// Why a colour space is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RgbColorSpaceError {
    /// The primaries lie on a line, with or without white, or one is not finite.
    Primaries,
}

impl core::fmt::Display for RgbColorSpaceError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Primaries => "the primaries of a colour space span a triangle",
        })
    }
}

impl core::error::Error for RgbColorSpaceError {}

#[cfg(test)]
mod tests {
    use super::*;

    fn standards() -> [RgbColorSpace; 4] {
        [
            RgbColorSpace::srgb(),
            RgbColorSpace::dci_p3(),
            RgbColorSpace::rec2020(),
            RgbColorSpace::aces2065_1(),
        ]
    }

    #[test]
    fn white_is_the_illuminant() {
        for space in standards() {
            let white = space.rgb_from_xyz() * cie::xyz(&space.illuminant());
            assert!(white.distance(Vec3::ONE) < 1e-5, "{white}");
            assert!(
                (space.luminance(Vec3::ONE) - 1.0).abs() < 1e-5,
                "Y of white"
            );
        }
    }

    #[test]
    fn srgb_has_the_published_matrix() {
        let published = Mat3::from_cols(
            Vec3::new(0.4124, 0.2126, 0.0193),
            Vec3::new(0.3576, 0.7152, 0.1192),
            Vec3::new(0.1805, 0.0722, 0.9505),
        );
        assert!(
            RgbColorSpace::srgb()
                .xyz_from_rgb()
                .abs_diff_eq(published, 4e-4),
            "within the rounding of white: {}",
            RgbColorSpace::srgb().xyz_from_rgb()
        );
    }

    #[test]
    fn matrices_are_inverse() {
        for space in standards() {
            let identity = space.rgb_from_xyz() * space.xyz_from_rgb();
            assert!(identity.abs_diff_eq(Mat3::IDENTITY, 1e-5), "{identity}");
        }
    }

    #[test]
    fn refuses_a_primary_that_white_has_no_part_of() {
        let white = cie::xyz(&Daylight::D65);
        let white = Vec2::new(white.x, white.y) / white.element_sum();
        let away = Vec2::new(0.2, 0.1);
        for share in [0.0, 1e-8] {
            let third = Vec2::new(0.1, 0.8);
            let red = white + away + share * (third - white);
            let primaries = [red, third, white - away];
            assert_eq!(
                RgbColorSpace::new(primaries, Daylight::D65),
                Err(RgbColorSpaceError::Primaries),
                "{primaries:?}"
            );
        }
    }

    #[test]
    fn refuses_primaries_on_a_line() {
        let line = [
            Vec2::new(0.1, 0.1),
            Vec2::new(0.2, 0.2),
            Vec2::new(0.3, 0.3),
        ];
        for primaries in [line, [Vec2::NAN; 3]] {
            assert_eq!(
                RgbColorSpace::new(primaries, Daylight::D65),
                Err(RgbColorSpaceError::Primaries),
                "{primaries:?}"
            );
        }
    }
}
