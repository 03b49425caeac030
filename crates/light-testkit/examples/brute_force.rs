//! Compares very many lights with quadrature of their descriptions:
//! `brute_force [SEEDS] [FIRST SEED] [KIND]`.
#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for the terminal"
)]

use std::process::ExitCode;

use light_testkit::brute_force::{Kind, check};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |i: usize, default: u64| match arguments.get(i) {
        None => Some(default),
        Some(text) => text.parse().ok(),
    };
    let wanted = arguments.get(2);
    let is_wanted = |kind: &Kind| wanted.is_none_or(|name| format!("{kind:?}") == *name);
    let kinds: Vec<Kind> = Kind::ALL.into_iter().filter(is_wanted).collect();
    let (Some(seeds), Some(first), false) = (number(0, 1000), number(1, 0), kinds.is_empty())
    else {
        eprintln!("usage: brute_force [SEEDS] [FIRST SEED] [KIND], where KIND is one of");
        eprintln!("{:?}", Kind::ALL);
        return ExitCode::from(2);
    };
    let mut faults = 0u64;
    for kind in kinds {
        let before = faults;
        for seed in first..first + seeds {
            if let Err(fault) = check(kind, seed) {
                println!("{fault}");
                faults += 1;
            }
        }
        println!("{kind:?}: {} faults of {seeds} lights", faults - before);
    }
    ExitCode::from(u8::from(faults > 0))
}
