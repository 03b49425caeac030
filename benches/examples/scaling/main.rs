//! Measures how the costs of light samplers grow with the lights, for `docs/light-bvh.md`:
//! `cargo xtask scaling [--quick | LIGHTS]`.

use std::fs;
use std::io::{IsTerminal, stderr};
use std::process::ExitCode;

use benches::page::{root, write_table};
use light_render::{available_memory, plot};

mod columns;
mod measure;
mod thread_time;

use columns::Row;
use measure::Effort;

/// The page that the table is on.
const PAGE: &str = "docs/light-bvh.md";

/// Lights of the largest set, if the command does not say.
const LARGEST: usize = 10_000_000;

/// Lights of the largest set of `--quick`.
const QUICK: usize = 10_000;

/// Bytes of memory that a light takes at most while its set is measured (246 at 10^7 lights, with
/// the reference tree), with a sixth of room.
const BYTES_A_LIGHT: u64 = 288;

/// What the command asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Request {
    /// The table is printed.
    Quick,
    /// Sets of up to so many lights, into the page.
    UpTo(usize),
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match request(&arguments).and_then(run) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn request(arguments: &[String]) -> Result<Request, String> {
    match arguments {
        [] => Ok(Request::UpTo(LARGEST)),
        [flag] if flag == "--quick" => Ok(Request::Quick),
        [lights] => match lights.parse() {
            Ok(lights) if (100..=1_000_000_000).contains(&lights) => Ok(Request::UpTo(lights)),
            _ => Err(format!(
                "{lights}: expected 100 to 1000000000 lights, or --quick"
            )),
        },
        _ => Err("usage: cargo xtask scaling [--quick | LIGHTS]".into()),
    }
}

/// Measures, and writes or prints.
///
/// # Errors
/// Too little memory, a light that a sampler refuses, or a file that cannot be written.
fn run(request: Request) -> Result<(), String> {
    let (largest, effort) = match request {
        Request::Quick => (QUICK, Effort::QUICK),
        Request::UpTo(lights) => (lights, Effort::FULL),
    };
    fits(largest, available_memory())?;
    let mut rows = Vec::new();
    for lights in powers_of_ten(largest) {
        let progress = |what: &str| {
            if stderr().is_terminal() {
                eprintln!("{lights} lights: {what}");
            }
        };
        rows.extend(measure::measure(lights, &effort, progress)?);
        // After each size, for the last one may take an hour on a busy machine.
        if request != Request::Quick {
            write_plots(&rows)?;
            write_table(PAGE, "scaling", &columns::table(&rows))?;
        }
    }
    print!("{}", columns::table(&rows));
    Ok(())
}

/// Whether sets of so many lights can be measured in so much memory.
///
/// # Errors
/// One line that says what they need.
fn fits(lights: usize, available: u64) -> Result<(), String> {
    let needed = (lights as u64).saturating_mul(BYTES_A_LIGHT);
    if needed <= available {
        return Ok(());
    }
    let gigabytes = |bytes: u64| bytes as f64 * 1e-9;
    Err(format!(
        "{lights} lights: they need about {:.1} GB of memory, {:.1} GB are available",
        gigabytes(needed),
        gigabytes(available)
    ))
}

fn powers_of_ten(largest: usize) -> impl Iterator<Item = usize> {
    let sizes = std::iter::successors(Some(100_usize), |lights| lights.checked_mul(10));
    sizes.take_while(move |&lights| lights <= largest)
}

fn write_plots(rows: &[Row]) -> Result<(), String> {
    for drawing in columns::PLOTS {
        let svg = plot::log_plot_file(&drawing.series(rows), "lights", drawing.y_title);
        fs::write(root().join(drawing.file), svg).map_err(|e| format!("{}: {e}", drawing.file))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn too_many_lights_for_the_memory_are_refused() {
        let refused = fits(100_000_000, 24 << 30).expect_err("in 24 GB");
        assert!(refused.starts_with("100000000 lights: "), "{refused}");
        assert!(refused.lines().count() == 1, "{refused}");
        assert_eq!(fits(10_000_000, 24 << 30), Ok(()), "these fit");
    }

    #[test]
    fn requests_are_sizes_or_quick() {
        let of = |text: &str| request(&[text.to_owned()]);
        assert_eq!(of("--quick"), Ok(Request::Quick), "a flag");
        assert_eq!(of("1000"), Ok(Request::UpTo(1000)), "a size");
        for wrong in ["99", "-1", "1e6", "10000000000", "fast"] {
            let error = of(wrong).expect_err(wrong);
            assert!(error.starts_with(&format!("{wrong}: expected")), "{error}");
        }
        assert_eq!(request(&[]), Ok(Request::UpTo(LARGEST)), "none");
    }

    #[test]
    fn sizes_are_powers_of_ten() {
        let sizes: Vec<usize> = powers_of_ten(99_999).collect();
        assert_eq!(sizes, [100, 1000, 10_000], "up to the largest");
    }
}
