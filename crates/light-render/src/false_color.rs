use lights::glam::Vec3;

use lights::math::spectrum::rec709_luminance;

/// The linear colour that shows how far a pixel is from its reference: white where equal, red where
/// too bright, blue where too dark, full colour at one reference value (or 0.1, for dark pixels) of
/// difference.
#[must_use]
pub fn difference(pixel: Vec3, reference: Vec3) -> Vec3 {
    /// Below this luminance the scale is absolute.
    const FLOOR: f32 = 0.1;
    const TOO_BRIGHT: Vec3 = Vec3::new(0.45, 0.01, 0.02);
    const TOO_DARK: Vec3 = Vec3::new(0.015, 0.13, 0.41);
    const EQUAL: Vec3 = Vec3::splat(0.93);
    let (x, r) = (rec709_luminance(pixel), rec709_luminance(reference));
    let relative = ((x - r) / r.max(FLOOR)).clamp(-1.0, 1.0);
    let end = if relative < 0.0 { TOO_DARK } else { TOO_BRIGHT };
    // The root spreads small differences, which are the interesting ones.
    EQUAL.lerp(end, relative.abs().sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sign_and_size_are_colors() {
        let one = Vec3::ONE;
        assert_eq!(difference(one, one), Vec3::splat(0.93), "equal");
        let bright = difference(one * 1.5, one);
        assert!(bright.x > bright.z, "red where too bright");
        let dark = difference(one * 0.5, one);
        assert!(dark.z > dark.x, "blue where too dark");
        assert_eq!(
            difference(one * 9.0, one),
            difference(one * 2.0, one),
            "saturates"
        );
    }
}
