//! Octahedral codes: unit length, round trip, and the stated bound of the angular error. There are
//! 2^32 codes, so all of them can be checked.

use alloc::vec::Vec;
use core::ops::Range;
use core::sync::atomic::{AtomicU32, Ordering};
use std::thread;

use light_math::OctahedralVector;

/// How far a length may be from 1: two units in the last place.
const MAX_LENGTH_ERROR: f64 = 2.0 * f32::EPSILON as f64;

/// The part of the angular error that the float operations of the encoder may add, which the
/// corners of a cell do not show: the difference of the stated bound and `sqrt(18) h`, less the
/// decoder's share that is measured here.
const ENCODER_ERROR: f64 = 9.0 * 4.25 / 16_777_216.0;

/// The worst that was seen in a range of codes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Worst {
    /// `| |v| - 1 |` of a decoded vector.
    pub length_error: f64,
    /// Angle in radians between a decoded vector and a direction that the ideal encoder sends to
    /// its code.
    pub angular_error: f64,
    /// Codes that come back as another code, of another direction.
    pub lost: u64,
}

impl Worst {
    /// Whether all that `light-math` promises held.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.length_error <= MAX_LENGTH_ERROR
            && self.angular_error + ENCODER_ERROR <= f64::from(OctahedralVector::MAX_ANGULAR_ERROR)
            && self.lost == 0
    }

    fn join(self, other: Self) -> Self {
        Self {
            length_error: self.length_error.max(other.length_error),
            angular_error: self.angular_error.max(other.angular_error),
            lost: self.lost + other.lost,
        }
    }
}

/// How many rows of codes there are.
pub const ROWS: u32 = 1 << 16;

/// Checks all codes of the given rows of the square (`y` of the code), on all cores.
///
/// # Panics
/// If the arithmetic under test panics.
#[must_use]
pub fn check_rows(rows: Range<u32>) -> Worst {
    let next = AtomicU32::new(rows.start);
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let work = || {
        let mut worst = Worst::default();
        loop {
            let y = next.fetch_add(1, Ordering::Relaxed);
            match u16::try_from(y) {
                Ok(row) if y < rows.end => worst = worst.join(check_row(row)),
                _ => return worst,
            }
        }
    };
    thread::scope(|scope| {
        let handles: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        handles
            .into_iter()
            .map(|handle| handle.join().expect("a worker panicked"))
            .fold(Worst::default(), Worst::join)
    })
}

fn check_row(y: u16) -> Worst {
    let mut worst = Worst::default();
    let (bottom, top) = (f64::from(y) - 0.5, f64::from(y) + 0.5);
    let mut left = [sphere(-0.5, bottom), sphere(-0.5, top)];
    for x in 0..=u16::MAX {
        let right = f64::from(x) + 0.5;
        let right = [sphere(right, bottom), sphere(right, top)];
        let code = OctahedralVector::from_xy(x, y);
        let v = code.decode();
        let precise = v.to_array().map(f64::from);
        let length = dot(precise, precise).sqrt();
        worst.length_error = worst.length_error.max((length - 1.0).abs());

        // Chords are the angles, for angles as small as these.
        let unit = precise.map(|c| c / length);
        for corner in [left[0], left[1], right[0], right[1]] {
            let chord_sq = distance_sq(unit, corner);
            if chord_sq > worst.angular_error * worst.angular_error {
                worst.angular_error = 2.0 * (0.5 * chord_sq.sqrt()).asin();
            }
        }

        // On the border of the square two codes mean one direction.
        let again = OctahedralVector::encode(v);
        if again != code {
            let back = again.decode().to_array().map(f64::from);
            worst.lost += u64::from(distance_sq(back, precise) > 1e-12);
        }
        left = right;
    }
    worst
}

/// The direction of the point of the square, in codes; points a little outside are put on the
/// border.
fn sphere(x: f64, y: f64) -> [f64; 3] {
    let x = (x / 32767.5 - 1.0).clamp(-1.0, 1.0);
    let y = (y / 32767.5 - 1.0).clamp(-1.0, 1.0);
    let z = 1.0 - (x.abs() + y.abs());
    let v = if z >= 0.0 {
        [x, y, z]
    } else {
        [(1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y), z]
    };
    let inv_length = 1.0 / dot(v, v).sqrt();
    v.map(|c| c * inv_length)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn distance_sq(a: [f64; 3], b: [f64; 3]) -> f64 {
    let d = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    dot(d, d)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn some_rows_hold() {
        for rows in [0..2, 21845..21847, 32767..32769, 65535..65536] {
            let worst = check_rows(rows.clone());
            assert!(worst.holds(), "rows {rows:?}: {worst:?}");
        }
    }
}
