use lights::glam::{DVec3, Vec3};

/// How far an image is from a reference of the same size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Mean over pixels and channels of the squared difference over the squared reference plus
    /// 0.01.
    pub rel_mse: f64,
    /// Mean over pixels and channels of the squared difference.
    pub mse: f64,
    /// Mean of image minus reference, a channel.
    pub bias: DVec3,
    /// Standard error of [`bias`](Self::bias), a channel: the pixels' standard deviation over the
    /// root of their number.
    pub bias_error: DVec3,
}

impl Comparison {
    /// Added to the squared reference, it keeps dark pixels from ruling the relative error.
    pub(crate) const FLOOR: f64 = 1e-2;

    /// Compares `image` with `reference`, pixel by pixel.
    ///
    /// `None` when the numbers of pixels differ or are zero.
    #[must_use]
    pub fn new(image: &[Vec3], reference: &[Vec3]) -> Option<Self> {
        if image.len() != reference.len() || image.is_empty() {
            return None;
        }
        let n = image.len() as f64;
        let mut rel_sum = DVec3::ZERO;
        let mut square_sum = DVec3::ZERO;
        let mut sum = DVec3::ZERO;
        for (x, r) in image.iter().zip(reference) {
            let (x, r) = (x.as_dvec3(), r.as_dvec3());
            let d = x - r;
            sum += d;
            square_sum += d * d;
            rel_sum += d * d / (r * r + Self::FLOOR);
        }
        let bias = sum / n;
        let variance = (square_sum / n - bias * bias).max(DVec3::ZERO);
        Some(Self {
            rel_mse: rel_sum.element_sum() / (3.0 * n),
            mse: square_sum.element_sum() / (3.0 * n),
            bias,
            bias_error: (variance / n).map(f64::sqrt),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_images_have_no_error() {
        let image = [Vec3::new(1.0, 2.0, 3.0); 4];
        let c = Comparison::new(&image, &image).expect("same size");
        assert_eq!(
            (c.rel_mse, c.mse, c.bias),
            (0.0, 0.0, DVec3::ZERO),
            "nothing"
        );
    }

    #[test]
    fn figures_follow_their_definitions() {
        let reference = [Vec3::ONE, Vec3::ONE];
        let image = [Vec3::splat(1.5), Vec3::splat(0.5)];
        let c = Comparison::new(&image, &reference).expect("same size");
        assert!((c.mse - 0.25).abs() < 1e-12, "half squared");
        assert!(
            (c.rel_mse - 0.25 / 1.01).abs() < 1e-12,
            "over one plus a hundredth"
        );
        assert_eq!(c.bias, DVec3::ZERO, "errors cancel");
        let error = DVec3::splat(0.5 / 2.0f64.sqrt());
        assert!(
            c.bias_error.distance(error) < 1e-12,
            "deviation 0.5 of two pixels"
        );
    }

    #[test]
    fn sizes_must_agree() {
        assert_eq!(Comparison::new(&[Vec3::ONE], &[]), None, "one against none");
        assert_eq!(Comparison::new(&[], &[]), None, "nothing to compare");
    }
}
