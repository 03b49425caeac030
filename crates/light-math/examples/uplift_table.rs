//! Remakes the table of smooth spectra that `light-math` ships, by the solver that is its source:
//! `cargo xtask uplift-table`. A table for another colour space is made the same way.

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use light_math::spectrum::{RgbColorSpace, UpliftSolver, UpliftTable};

/// The table of sRGB as little-endian floats, from the crate's root.
const FILE: &str = "src/spectrum/uplift_srgb.bin";

fn main() -> ExitCode {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(FILE);
    match fs::write(&path, table()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{}: {error}", path.display());
            ExitCode::FAILURE
        }
    }
}

fn table() -> Vec<u8> {
    let solver = UpliftSolver::new(&RgbColorSpace::srgb());
    let storage = vec![0.0; UpliftTable::<Vec<f32>>::LEN];
    UpliftTable::build(&solver, storage)
        .expect("the storage has the length that the table asks for")
        .coefficients()
        .iter()
        .flat_map(|c| c.to_le_bytes())
        .collect()
}
