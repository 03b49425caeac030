//! The program `lights`.

use std::process::ExitCode;

fn main() -> ExitCode {
    light_render::cli::main()
}
