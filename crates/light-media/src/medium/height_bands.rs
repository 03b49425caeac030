use core::f32::consts::LN_2;

use light_math::float;

use crate::ray::Span;

/// The bands of height that a ray crosses: in band `k` the density lies within `[2^-(k+1), 2^-k]`,
/// in band 0 also everything below the base, in the last one everything above.
#[derive(Clone, Debug)]
pub(super) struct HeightBands {
    band: i32,
    last: i32,
    t_of_base: f32,
    t_per_band: f32,
}

impl HeightBands {
    /// The last band: above it the density is negligible, and one segment covers the rest.
    const TOP: i32 = 24;

    /// The bands along `span` of a ray that starts at height `h0` above the base and rises by `dh`
    /// a unit; densities fall by the factor `e` each `1 / falloff`.
    #[expect(clippy::cast_possible_truncation, reason = "clamped to 0..=TOP")]
    pub(super) fn new(falloff: f32, h0: f32, dh: f32, span: Span) -> Self {
        let band_of = |t: f32| {
            let height = if dh == 0.0 { h0 } else { h0 + dh * t };
            float::floor(falloff * height / LN_2).clamp(0.0, Self::TOP as f32) as i32
        };
        Self {
            band: band_of(span.t0),
            last: band_of(span.t1),
            t_of_base: -h0 / dh,
            t_per_band: LN_2 / (falloff * dh),
        }
    }

    /// The bound of the density in the current band, and the distance at which the ray leaves the
    /// band.
    pub(super) fn step(&mut self) -> (f32, f32) {
        // The margin covers the rounding of heights and exponentials.
        let density = float::powf(0.5, self.band as f32) * (1.0 + 1e-4);
        if self.band == self.last {
            return (density, f32::INFINITY);
        }
        let upward = self.last > self.band;
        let wall = self.band + i32::from(upward);
        self.band += if upward { 1 } else { -1 };
        (density, self.t_of_base + self.t_per_band * wall as f32)
    }
}
