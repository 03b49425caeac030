use lights::glam::Vec3;
use lights::math::spectrum::rec709_luminance;

/// How linear radiance becomes display values. For viewing only: files of record stay linear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToneMap {
    exposure: f32,
    curve: ToneCurve,
}

/// How bright parts become white.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum ToneCurve {
    /// As they are up to a knee at 0.6, and gradually from there.
    #[default]
    Soft,
    /// `x / (1 + x)` of each channel.
    ///
    /// # Source
    /// `[Reinhard2002]`, equation 3.
    Reinhard,
    /// As they are, up to 1.
    Clip,
}

impl ToneMap {
    /// Radiance 1 becomes almost white.
    pub const UNIT: Self = Self::new(1.0);

    /// Radiance is multiplied with `exposure`, then 1 becomes almost white.
    #[must_use]
    pub const fn new(exposure: f32) -> Self {
        let curve = ToneCurve::Soft;
        Self { exposure, curve }
    }

    /// The same exposure with another curve.
    #[must_use]
    pub const fn with_curve(self, curve: ToneCurve) -> Self {
        Self { curve, ..self }
    }

    /// The exposure that brings the log-average luminance of `pixels` to middle grey;
    /// [`UNIT`](Self::UNIT) for a black picture.
    ///
    /// # Source
    /// `[Reinhard2002]`, equations 1 and 2, over the pixels that are not black.
    #[must_use]
    pub(crate) fn fit(pixels: &[Vec3]) -> Self {
        const MIDDLE_GREY: f64 = 0.18;
        let (mut sum, mut n) = (0.0, 0u32);
        for luminance in pixels.iter().map(|&p| f64::from(rec709_luminance(p))) {
            if luminance > 0.0 && luminance.is_finite() {
                sum += luminance.ln();
                n += 1;
            }
        }
        if n == 0 {
            return Self::UNIT;
        }
        #[expect(clippy::cast_possible_truncation, reason = "an exposure needs no f64")]
        let exposure = (MIDDLE_GREY / (sum / f64::from(n)).exp()) as f32;
        Self::new(exposure)
    }

    /// The linear colour in `[0, 1]` that a screen should show for a pixel: exposed, with
    /// highlights rolled off channel by channel.
    #[must_use]
    pub(crate) fn apply(&self, radiance: Vec3) -> Vec3 {
        let exposed = (radiance * self.exposure).max(Vec3::ZERO);
        match self.curve {
            ToneCurve::Soft => exposed.map(roll_off),
            // As 1 - 1 / (1 + x), which is 1 at infinity.
            ToneCurve::Reinhard => exposed.map(|x| 1.0 - 1.0 / (1.0 + x)),
            ToneCurve::Clip => exposed.min(Vec3::ONE),
        }
    }
}

/// Identity up to the knee, from there a curve of equal slope that reaches one at infinity.
fn roll_off(x: f32) -> f32 {
    const KNEE: f32 = 0.6;
    if !(x > KNEE) {
        return x;
    }
    let over = (x - KNEE) / (1.0 - KNEE);
    KNEE + (1.0 - KNEE) * (1.0 - 1.0 / (1.0 + over))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_is_fixed_at_its_ends() {
        let show = |x| ToneMap::UNIT.apply(Vec3::splat(x)).x;
        assert_eq!(show(0.0), 0.0, "black");
        assert_eq!(show(0.5), 0.5, "below the knee nothing changes");
        assert_eq!(show(f32::INFINITY), 1.0, "white");
        assert_eq!(show(f32::MAX), 1.0, "white without overflow");
    }

    #[test]
    fn curves_have_their_own_shapes() {
        let show = |curve, x| ToneMap::new(2.0).with_curve(curve).apply(Vec3::splat(x)).x;
        for (curve, expected) in [
            (ToneCurve::Soft, [0.4, 0.8, 1.0]),
            (ToneCurve::Reinhard, [0.4 / 1.4, 0.5, 1.0]),
            (ToneCurve::Clip, [0.4, 1.0, 1.0]),
        ] {
            let found = [0.2, 0.5, f32::INFINITY].map(|x| show(curve, x));
            let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs());
            assert!(off.fold(0.0, f32::max) < 1e-6, "{curve:?}: {found:?}");
        }
    }

    #[test]
    fn the_curve_rises() {
        let mut last = -1.0;
        for i in 0..200u8 {
            let x = ToneMap::UNIT.apply(Vec3::splat(f32::from(i) * 0.02)).x;
            assert!(x > last && x <= 1.0, "monotonic at {i}");
            last = x;
        }
    }

    #[test]
    fn middle_grey_lands_where_it_should() {
        let pixels = [Vec3::splat(5.0), Vec3::ZERO, Vec3::splat(5.0)];
        let map = ToneMap::fit(&pixels);
        assert!((map.exposure - 0.036).abs() < 1e-5, "0.18 / 5");
        assert_eq!(
            ToneMap::fit(&[Vec3::ZERO]),
            ToneMap::UNIT,
            "nothing to measure"
        );
    }
}
