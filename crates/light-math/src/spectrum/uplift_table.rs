use glam::Vec3;

use super::uplift::{Uplift, color, face};
use super::{SigmoidPolynomial, UpliftSolver};
use crate::float::sqrt;

/// Spectra of all colours by bilinear interpolation of solved ones: for texels, in about ten
/// nanoseconds.
///
/// The strength of a colour does not matter, so the colours are the three faces of a cube, one for
/// each largest component: `3 x 24 x 24` solutions of three coefficients, 20 KiB in a storage `S`
/// of the caller's choice (`&[f32]`, array, `Vec`). Along a face the nodes are dense where the
/// smallest component is near 0, for there the spectra change fastest. The colour of an
/// interpolated spectrum is within 2e-3 of the solver's in sRGB, 3e-4 in the mean (fractions of the
/// largest component).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UpliftTable<S> {
    coefficients: S,
}

/// Nodes along each side of a face.
const SIDE: usize = 24;

/// How many coefficients a table has.
const LEN: usize = 3 * SIDE * SIDE * 3;

/// The solver's own results, remade by `cargo xtask uplift-table`.
const SRGB: &[f32; LEN] = &decode(include_bytes!("uplift_srgb.bin"));

impl<S> UpliftTable<S> {
    /// How many coefficients a table has.
    pub const LEN: usize = LEN;
}

impl UpliftTable<&'static [f32]> {
    /// The table for sRGB with the white D65.
    pub const SRGB: Self = Self { coefficients: SRGB };
}

impl<S: AsRef<[f32]> + AsMut<[f32]>> UpliftTable<S> {
    /// The table of a colour space in the given storage of [`LEN`](Self::LEN) numbers, whatever it
    /// holds.
    ///
    /// Costs 1728 solutions, some milliseconds.
    ///
    /// # Errors
    /// If the storage has another length.
    pub fn build(solver: &UpliftSolver, mut storage: S) -> Result<Self, UpliftTableError> {
        let coefficients = storage.as_mut();
        if coefficients.len() != LEN {
            return Err(UpliftTableError::WrongLength);
        }
        for (node, out) in coefficients.chunks_exact_mut(3).enumerate() {
            let (f, i, j) = (node / (SIDE * SIDE), node / SIDE % SIDE, node % SIDE);
            let rgb = color(f, node_fraction(i), node_fraction(j));
            out.copy_from_slice(&solver.shape(rgb).c);
        }
        Ok(Self {
            coefficients: storage,
        })
    }
}

impl<S: AsRef<[f32]>> UpliftTable<S> {
    /// The coefficients, in the order of [`build`](UpliftTable::build).
    #[must_use]
    pub fn coefficients(&self) -> &[f32] {
        self.coefficients.as_ref()
    }

    #[inline]
    fn node(&self, f: usize, i: usize, j: usize) -> Vec3 {
        let start = ((f * SIDE + i) * SIDE + j) * 3;
        match self.coefficients.as_ref().get(start..start + 3) {
            Some(&[a, b, c]) => Vec3::new(a, b, c),
            _ => Vec3::ZERO,
        }
    }
}

impl<S: AsRef<[f32]>> Uplift for UpliftTable<S> {
    #[inline]
    fn shape(&self, rgb: Vec3) -> SigmoidPolynomial {
        let Some((f, x, y)) = face(rgb) else {
            return SigmoidPolynomial::default();
        };
        let (i, s) = cell(x);
        let (j, t) = cell(y);
        let near = self.node(f, i, j).lerp(self.node(f, i, j + 1), t);
        let far = self.node(f, i + 1, j).lerp(self.node(f, i + 1, j + 1), t);
        SigmoidPolynomial {
            c: near.lerp(far, s).to_array(),
        }
    }
}

/// The fraction of the largest component at node `i` of a side.
fn node_fraction(i: usize) -> f32 {
    let t = i as f32 / (SIDE - 1) as f32;
    t * t
}

/// The cell of a side that holds the fraction `x` in `[0, 1]`, and how far into it.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between 0 and 23"
)]
fn cell(x: f32) -> (usize, f32) {
    let position = sqrt(x) * (SIDE - 1) as f32;
    let i = (position as usize).min(SIDE - 2);
    (i, position - i as f32)
}

/// Little-endian floats.
const fn decode(bytes: &[u8; 4 * LEN]) -> [f32; LEN] {
    let mut out = [0.0; LEN];
    let mut i = 0;
    while i < LEN {
        let b = 4 * i;
        out[i] = f32::from_le_bytes([bytes[b], bytes[b + 1], bytes[b + 2], bytes[b + 3]]);
        i += 1;
    }
    out
}

/// Why a table is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum UpliftTableError {
    /// The storage does not hold [`UpliftTable::LEN`] numbers.
    WrongLength,
}

impl core::fmt::Display for UpliftTableError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::WrongLength => "the table of spectra of colours has 5184 coefficients",
        })
    }
}

impl core::error::Error for UpliftTableError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::RgbColorSpace;

    #[test]
    fn shipped_table_is_what_the_solver_says() {
        let solver = UpliftSolver::new(&RgbColorSpace::srgb());
        let built = UpliftTable::build(&solver, [0.0; LEN]).expect("fits");
        assert!(
            built.coefficients() == SRGB,
            "remake it with `cargo xtask uplift-table`"
        );
    }

    #[test]
    fn interpolated_colours_come_back() {
        let solver = UpliftSolver::new(&RgbColorSpace::srgb());
        let steps = 37;
        let (mut worst, mut sum) = (0.0f32, 0.0);
        for f in 0..3 {
            for i in 0..=steps {
                for j in 0..=steps {
                    let rgb = color(f, i as f32 / steps as f32, j as f32 / steps as f32);
                    let error = 2.0 * solver.rgb(&UpliftTable::SRGB.shape(rgb)).distance(rgb);
                    worst = worst.max(error);
                    sum += error / (3 * (steps + 1) * (steps + 1)) as f32;
                }
            }
        }
        assert!(worst < 2e-3 && sum < 4e-4, "worst {worst}, mean {sum}");
    }

    #[test]
    fn grey_is_exactly_constant() {
        for rgb in [Vec3::splat(3.0), Vec3::ZERO, Vec3::NAN] {
            assert_eq!(
                UpliftTable::SRGB.shape(rgb),
                SigmoidPolynomial::default(),
                "{rgb}"
            );
        }
    }

    #[test]
    fn refuses_other_storage() {
        let solver = UpliftSolver::new(&RgbColorSpace::srgb());
        assert_eq!(
            UpliftTable::build(&solver, [0.0; 3]).err(),
            Some(UpliftTableError::WrongLength),
            "too short"
        );
    }

    /// A storage is foreign code: what it does later gives a wrong colour, but never a panic.
    #[test]
    fn storage_that_loses_its_numbers_gives_flat_spectra() {
        struct Forgetful([f32; LEN]);
        impl AsMut<[f32]> for Forgetful {
            fn as_mut(&mut self) -> &mut [f32] {
                &mut self.0
            }
        }
        impl AsRef<[f32]> for Forgetful {
            fn as_ref(&self) -> &[f32] {
                &[]
            }
        }
        let solver = UpliftSolver::new(&RgbColorSpace::srgb());
        let table = UpliftTable::build(&solver, Forgetful([0.0; LEN])).expect("fits");
        let shape = table.shape(Vec3::new(0.1, 0.5, 0.9));
        assert_eq!(shape.c, [0.0; 3], "no coefficients");
    }
}
