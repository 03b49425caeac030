use glam::Vec3;

use super::SigmoidPolynomial;

/// Converts a colour to a smooth spectrum of that colour.
///
/// Emission has no upper bound, so that only the chromaticity matters: a colour is a spectrum
/// between 0 and 1 whose largest RGB component is 1/2, times a factor. Grey is the constant
/// spectrum 1/2.
pub trait Uplift {
    /// The spectrum of a colour, which under the colour space's illuminant has the RGB
    /// `rgb / (2 max(rgb))`.
    ///
    /// `rgb` is linear. Negative components and NaN count as 0; black has the spectrum of grey.
    fn shape(&self, rgb: Vec3) -> SigmoidPolynomial;
}

/// Which component is the largest, and the other two in cyclic order as fractions of it, in
/// `[0, 1]`.
///
/// None for black.
#[inline]
pub(super) fn face(rgb: Vec3) -> Option<(usize, f32, f32)> {
    // NaN fails the comparison; infinity has no ratio.
    let [r, g, b] = rgb
        .to_array()
        .map(|c| if c > 0.0 { c.min(f32::MAX) } else { 0.0 });
    let (face, max, x, y) = if r >= g && r >= b {
        (0, r, g, b)
    } else if g >= b {
        (1, g, b, r)
    } else {
        (2, b, r, g)
    };
    if !(max > 0.0) {
        return None;
    }
    Some((face, x / max, y / max))
}

/// The colour that [`face`] takes apart, with 1/2 as its largest component.
pub(super) fn color(face: usize, x: f32, y: f32) -> Vec3 {
    let (x, y) = (0.5 * x, 0.5 * y);
    match face {
        0 => Vec3::new(0.5, x, y),
        1 => Vec3::new(y, 0.5, x),
        _ => Vec3::new(x, y, 0.5),
    }
}

/// The largest component of a colour that counts, 0 for black.
#[inline]
pub(super) fn strength(rgb: Vec3) -> f32 {
    rgb.x.max(rgb.y).max(rgb.z).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_and_colours_are_inverse() {
        for rgb in [
            Vec3::new(0.5, 0.2, 0.1),
            Vec3::new(0.1, 0.5, 0.3),
            Vec3::new(0.4, 0.0, 0.5),
            Vec3::splat(0.5),
        ] {
            let (f, x, y) = face(rgb * 3.0).expect("not black");
            assert!(color(f, x, y).distance(rgb) < 1e-6, "{rgb}");
        }
    }

    #[test]
    fn what_is_no_colour_counts_as_black() {
        assert_eq!(face(Vec3::ZERO), None, "black");
        assert_eq!(face(Vec3::splat(-1.0)), None, "negative");
        assert_eq!(face(Vec3::NAN), None, "NaN");
        assert_eq!(
            face(Vec3::new(-1.0, 2.0, -3.0)),
            Some((1, 0.0, 0.0)),
            "clamped"
        );
        assert_eq!(strength(Vec3::NAN), 0.0, "NaN has no strength");
    }
}
