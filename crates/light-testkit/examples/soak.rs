//! Takes very many samples of lights and holds each against its query:
//! `soak [CHOICES] [LIGHT_SAMPLES] [SEED]`.
#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for the terminal"
)]

use core::time::Duration;
use std::process::ExitCode;
use std::sync::Mutex;
use std::time::Instant;

use light_testkit::soak::Soak;

/// How often the progress is written.
const EVERY: Duration = Duration::from_secs(10);

fn main() -> ExitCode {
    let numbers: Result<Vec<u64>, _> = std::env::args().skip(1).map(|a| a.parse()).collect();
    let mut soak = Soak {
        choices: 1_000_000_000,
        light_samples: 100_000_000,
        seed: 1,
    };
    match numbers.as_deref() {
        Ok([]) => {}
        Ok([choices]) => {
            soak.choices = *choices;
            soak.light_samples = choices / 10;
        }
        Ok([choices, light_samples]) => {
            (soak.choices, soak.light_samples) = (*choices, *light_samples);
        }
        Ok([choices, light_samples, seed]) => {
            (soak.choices, soak.light_samples) = (*choices, *light_samples);
            soak.seed = *seed;
        }
        _ => {
            eprintln!("usage: soak [CHOICES] [LIGHT_SAMPLES] [SEED]");
            return ExitCode::from(2);
        }
    }
    let start = Instant::now();
    let last = Mutex::new(start);
    let report = soak.run(|done, total| {
        let mut last = last.lock().expect("nobody panics with it");
        if last.elapsed() >= EVERY {
            *last = Instant::now();
            let percent = 100.0 * done as f64 / total as f64;
            eprintln!("{percent:.1} %, {} s", start.elapsed().as_secs());
        }
    });
    print!("{report}");
    let (seconds, mismatches) = (start.elapsed().as_secs(), report.mismatches());
    println!("seed {}, {mismatches} mismatches, {seconds} s", soak.seed);
    ExitCode::from(u8::from(mismatches > 0))
}
