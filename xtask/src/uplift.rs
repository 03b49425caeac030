//! The table of smooth spectra that `light-math` ships: remade by the solver that is its source.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use lights::math::spectrum::{RgbColorSpace, UpliftSolver, UpliftTable};

/// `cargo xtask uplift-table`.
pub(crate) fn run() -> ExitCode {
    let path = table_file();
    match fs::write(&path, table()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{}: {error}", path.display());
            ExitCode::from(1)
        }
    }
}

/// The table of sRGB as little-endian floats.
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

fn table_file() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/light-math/src/spectrum/uplift_srgb.bin")
}
