//! Coordinates as whole numbers: a float of `[0, 1]` times a number of texels.

/// Positions are counted in this part of a texel: 2^-32.
pub(super) const STEPS: u64 = 1 << STEP_BITS;

/// The base-2 logarithm of [`STEPS`].
pub(super) const STEP_BITS: u32 = 32;

const MANTISSA_BITS: u32 = f32::MANTISSA_DIGITS - 1;

/// What a mantissa counts, at exponent 0: 2^-150.
const LOG2_UNIT: i32 = 1 - f32::MIN_EXP + f32::MANTISSA_DIGITS as i32;

/// The room that a product of a mantissa and a number of texels leaves in 63 bits.
const ROOM: u32 = 15;

/// An interval in one texel, to more digits than the ends have.
#[derive(Clone, Copy, Debug)]
pub(super) struct Narrow {
    start: u64,
    /// How wide it is; not 0.
    extent: u64,
    /// Both count this power of two of a texel.
    log2: i32,
}

impl Narrow {
    /// The interval from `min` to `max`, of `[0, 1]`, which rise.
    #[inline]
    pub(super) const fn new(min: f32, max: f32, texels: usize) -> Self {
        let ((low, from), (high, to)) = (split(min), split(max));
        let texels = texels as u64;
        let end = (high * texels) << ROOM;
        let start = match ((low * texels) << ROOM).checked_shr(to - from) {
            Some(start) => start,
            None => 0,
        };
        Self {
            start,
            extent: end - start,
            log2: to as i32 - LOG2_UNIT - ROOM as i32,
        }
    }

    /// How wide it is, to 32 bits, and the power of two of a texel that this counts.
    #[inline]
    pub(super) const fn width(&self) -> (u64, i32) {
        let shift = self.extent.leading_zeros();
        let width = self.extent << shift >> STEP_BITS;
        (width, self.log2 + STEP_BITS as i32 - shift as i32)
    }

    /// The position at `u`, of 2^32, of the interval, and the power of two of a texel that this
    /// counts.
    #[inline]
    pub(super) const fn at(&self, u: u32) -> (u64, i32) {
        let (high, low) = (self.extent >> STEP_BITS, self.extent & (STEPS - 1));
        let u = u as u64;
        (self.start + high * u + ((low * u) >> STEP_BITS), self.log2)
    }
}

/// The texel of `x`, of `[0, 1]`.
#[inline]
pub(super) fn texel(x: f32, texels: usize) -> usize {
    whole_texels(position(x, texels)).min(texels - 1)
}

/// `x * texels` in steps, for `x` of `[0, 1]`: rounded down, which is less than 2^-7 of the
/// distance between two floats from half a texel on.
#[inline]
pub(super) const fn position(x: f32, texels: usize) -> u64 {
    // The exponent at which a mantissa counts steps.
    const UNIT: u32 = LOG2_UNIT as u32 - STEP_BITS;
    let (mantissa, exponent) = split(x);
    let product = mantissa * texels as u64;
    if exponent >= UNIT {
        return product << (exponent - UNIT);
    }
    match product.checked_shr(UNIT - exponent) {
        Some(position) => position,
        None => 0,
    }
}

/// The whole texels of a position.
#[inline]
pub(super) const fn whole_texels(position: u64) -> usize {
    (position >> STEP_BITS) as usize
}

/// The mantissa of the magnitude of `x`, of 24 bits, and its exponent, from 0 on.
#[inline]
const fn split(x: f32) -> (u64, u32) {
    let bits = x.abs().to_bits();
    let (exponent, fraction) = (bits >> MANTISSA_BITS, bits & ((1 << MANTISSA_BITS) - 1));
    let mantissa = match exponent {
        0 => fraction << 1,
        _ => fraction | 1 << MANTISSA_BITS,
    };
    (mantissa as u64, exponent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::float::{next_down, next_up};

    const STEP: f64 = 1.0 / STEPS as f64;

    #[test]
    fn positions_are_rounded_down() {
        let ends = [0.0, 0.999_75, 1.0].map(|x| texel(x, 4));
        assert_eq!(ends, [0, 3, 3], "closed at the end");
        assert_eq!(texel(-0.0, 4), 0, "with a sign");
        for texels in [1, 3, 4096, 10_007, 1 << 24] {
            for bits in (0..=1.0f32.to_bits()).step_by(99_991) {
                let x = f32::from_bits(bits);
                let exact = f64::from(x) * texels as f64;
                let rounding = exact - position(x, texels) as f64 * STEP;
                assert!((0.0..STEP).contains(&rounding), "{x} of {texels}");
                let inside = exact - texel(x, texels) as f64;
                let end = f64::from(u8::from(x == 1.0));
                assert!(
                    (end..end.max(0.5) + 0.5).contains(&inside),
                    "{x} of {texels}"
                );
            }
        }
    }

    #[test]
    fn narrow_intervals_keep_their_digits() {
        // Not `f64::powi`, which needs std.
        let scale = |log2: i32| f64::from_bits(u64::from((1023 + log2).unsigned_abs()) << 52);
        let ends = [0.0, 1e-45, 3e-42, 1e-30, 2e-9, 0.3, 0.999_999_9, 1.0];
        for texels in [1, 3, 10_007, 1 << 24] {
            for (i, &min) in ends.iter().enumerate() {
                let rest = ends[i + 1..].iter().copied();
                for max in rest.chain([next_up(min)]).filter(|&max| max <= 1.0) {
                    let narrow = Narrow::new(min, max, texels);
                    let exact = (f64::from(max) - f64::from(min)) * texels as f64;
                    let (width, log2) = narrow.width();
                    let found = width as f64 * scale(log2);
                    assert!(
                        (found / exact - 1.0).abs() < 1e-9,
                        "{min} to {max}: {found}"
                    );
                    let (at, log2) = narrow.at(3 << 30);
                    let exact = f64::from(min) * texels as f64 + exact * 0.75;
                    let found = at as f64 * scale(log2);
                    assert!(
                        (found / exact - 1.0).abs() < 1e-9,
                        "{min} to {max}: {found}"
                    );
                }
            }
        }
        assert_eq!(
            Narrow::new(next_down(0.5), 0.5, 1).width().0,
            1 << 31,
            "bits"
        );
    }
}
