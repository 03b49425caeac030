//! Checks all 2^32 octahedral codes: `cargo xtask exhaustive`.
#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for the terminal"
)]

use std::process::ExitCode;
use std::time::Instant;

use light_math::OctahedralVector;
use light_testkit::soak::octahedral_codes::{ROWS, check_rows};

fn main() -> ExitCode {
    if std::env::args().len() > 1 {
        eprintln!("usage: cargo xtask exhaustive");
        return ExitCode::from(2);
    }
    let start = Instant::now();
    let worst = check_rows(0..ROWS);
    println!(
        "octahedral, 2^32 codes in {:.0} s: length error {:.3e}, angular error {:.4e} (stated \
         {:.4e}), {} codes lost",
        start.elapsed().as_secs_f64(),
        worst.length_error,
        worst.angular_error,
        OctahedralVector::MAX_ANGULAR_ERROR,
        worst.lost
    );
    ExitCode::from(u8::from(!worst.holds()))
}
