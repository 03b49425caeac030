use lights::glam::Vec3;
use lights::math::spectrum::rec709_luminance;

/// The exposures that two pictures are shown at.
///
/// # Source
/// `[Andersson2021]`, section 4: from the exposure that maps the brightest pixel to the knee of the
/// tone curve to that which maps the median there, in steps of about a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Exposures {
    /// The first, in stops.
    start: f32,
    /// The last.
    stop: f32,
    /// How many, at least two.
    count: u32,
}

/// The value on the screen that counts as bright.
const BRIGHT: f32 = 0.85;

/// Numerator and denominator of the tone curve, by powers from the second down.
///
/// # Source
/// The fit of K. Narkowicz to the curve of ACES, for radiance times 0.6, as `[Andersson2021]` uses
/// it.
const CURVE: [[f32; 3]; 2] = [
    [0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0],
    [0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14],
];

impl Exposures {
    pub(super) fn for_reference(reference: &[Vec3]) -> Self {
        /// Keeps the logarithms of black finite.
        const FLOOR: f32 = f32::EPSILON;
        let luminance = |&p: &Vec3| rec709_luminance(p.max(Vec3::ZERO).min(Vec3::splat(f32::MAX)));
        let mut luminances: Vec<f32> = reference.iter().map(luminance).collect();
        luminances.sort_by(f32::total_cmp);
        let at = |i: usize| luminances.get(i).copied().unwrap_or(0.0).max(FLOOR);
        let bright = bright_input();
        let [start, stop] = [at(luminances.len() - 1), at(luminances.len() / 2)]
            .map(|luminance| (bright / luminance).log2());
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most some hundred stops, and not negative"
        )]
        let count = ((stop - start).ceil() as u32).max(2);
        Self { start, stop, count }
    }

    /// What radiance is multiplied with.
    pub(super) fn factors(self) -> impl Iterator<Item = f32> {
        let step = (self.stop - self.start) / (self.count - 1) as f32;
        (0..self.count).map(move |i| (self.start + i as f32 * step).exp2())
    }
}

/// The input of the tone curve that comes out as [`BRIGHT`].
fn bright_input() -> f32 {
    let [a, b, c] = [0, 1, 2].map(|power| CURVE[0][power] - BRIGHT * CURVE[1][power]);
    let middle = -0.5 * b / a;
    middle + (middle * middle - c / a).sqrt()
}

/// What a screen shows of `pixels` at an exposure: linear, in `[0, 1]`.
pub(super) fn show(pixels: &[Vec3], exposure: f32) -> Vec<Vec3> {
    /// The curve is white long before; squares of more would overflow.
    const MOST: f32 = 1e6;
    let curve = |x: f32| {
        // NaN becomes black.
        let x = if x > 0.0 {
            (x * exposure).min(MOST)
        } else {
            0.0
        };
        let [above, below] = CURVE.map(|[a, b, c]| (a * x + b) * x + c);
        (above / below).clamp(0.0, 1.0)
    };
    pixels.iter().map(|p| p.map(curve)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_brightest_and_the_median_become_bright() {
        let reference = [0.5, 32.0, 1.0].map(Vec3::splat);
        let exposures = Exposures::for_reference(&reference);
        let factors: Vec<f32> = exposures.factors().collect();
        assert_eq!(factors.len(), 5, "one a stop: {exposures:?}");
        for (pixel, factor) in [(1, factors[0]), (2, factors[4])] {
            let shown = show(&reference, factor)[pixel].y;
            assert!((shown - BRIGHT).abs() < 1e-4, "{pixel}: {shown}");
        }
    }

    #[test]
    fn odd_numbers_are_shown_as_black_or_white() {
        let odd = [f32::NAN, -1.0, f32::INFINITY, 1e30].map(Vec3::splat);
        let shown = show(&odd, 1.0).into_iter().map(|p| p.x);
        assert_eq!(shown.collect::<Vec<_>>(), [0.0, 0.0, 1.0, 1.0], "clamped");
        let black = Exposures::for_reference(&[Vec3::ZERO; 2]);
        assert!(black.factors().all(f32::is_finite), "{black:?}");
    }
}
