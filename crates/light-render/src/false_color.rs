use lights::glam::Vec3;

use crate::tone_map::luminance;

/// The colour that shows how far a pixel is from its reference: white where equal, red where too bright, blue where too
/// dark, full colour at one reference value (or 0.1, for dark pixels) of difference.
#[must_use]
pub fn difference(pixel: Vec3, reference: Vec3) -> [u8; 3] {
    /// Below this luminance the scale is absolute.
    const FLOOR: f32 = 0.1;
    const TOO_BRIGHT: Vec3 = Vec3::new(178.0, 24.0, 43.0);
    const TOO_DARK: Vec3 = Vec3::new(33.0, 102.0, 172.0);
    const EQUAL: Vec3 = Vec3::splat(247.0);
    let (x, r) = (luminance(pixel), luminance(reference));
    let relative = ((x - r) / r.max(FLOOR)).clamp(-1.0, 1.0);
    let end = if relative < 0.0 { TOO_DARK } else { TOO_BRIGHT };
    // The root spreads small differences, which are the interesting ones.
    let color = EQUAL.lerp(end, relative.abs().sqrt());
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "within 0..=255"
    )]
    color.to_array().map(|x| x as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sign_and_size_are_colors() {
        let one = Vec3::ONE;
        assert_eq!(difference(one, one), [247; 3], "equal");
        let [r, _, b] = difference(one * 1.5, one);
        assert!(r > b, "red where too bright");
        let [r, _, b] = difference(one * 0.5, one);
        assert!(b > r, "blue where too dark");
        assert_eq!(
            difference(one * 9.0, one),
            difference(one * 2.0, one),
            "saturates"
        );
    }
}
