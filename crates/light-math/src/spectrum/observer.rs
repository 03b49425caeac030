//! The matching functions of the CIE 1931 standard observer, by nanometre.

use glam::Vec3;

#[path = "cie_1931.rs"]
mod cie_1931;

use cie_1931::OBSERVER_5_NM;

/// How many whole nanometres the range has.
pub(super) const SAMPLES: usize = 471;

/// The matching functions at each nanometre, interpolated when the crate is compiled.
pub(super) const OBSERVER: &[Vec3; SAMPLES] = &interpolate(&OBSERVER_5_NM);

/// The weights of rows `i - 1` to `i + 2` for the cubic through them, at `t` in `[0, 1)` from row
/// `i` to the next.
pub(super) const fn cubic(t: f64) -> [f64; 4] {
    [
        -t * (t - 1.0) * (t - 2.0) / 6.0,
        (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
        -(t + 1.0) * t * (t - 2.0) / 2.0,
        (t + 1.0) * t * (t - 1.0) / 6.0,
    ]
}

/// Cubics through four neighbours, clamped to be non-negative.
const fn interpolate(rows: &[[f64; 3]; 95]) -> [Vec3; SAMPLES] {
    let mut out = [Vec3::ZERO; SAMPLES];
    let mut i = 0;
    while i < SAMPLES {
        let row = i / 5;
        let weights = cubic((i % 5) as f64 / 5.0);
        let mut xyz = [0.0; 3];
        let mut k = 0;
        while k < 4 {
            // Rows row - 1 to row + 2, without the ones outside of the table.
            let neighbour = if row + k == 0 { 0 } else { row + k - 1 };
            let neighbour = if neighbour > 94 { 94 } else { neighbour };
            let mut c = 0;
            while c < 3 {
                xyz[c] += weights[k] * rows[neighbour][c];
                c += 1;
            }
            k += 1;
        }
        out[i] = Vec3::new(positive(xyz[0]), positive(xyz[1]), positive(xyz[2]));
        i += 1;
    }
    out
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "rounds to single precision"
)]
const fn positive(x: f64) -> f32 {
    if x > 0.0 { x as f32 } else { 0.0 }
}
