//! Measures how the costs of light samplers grow with the lights, for `docs/light-bvh.md`, and the
//! throughput of a farm with the workers, for `docs/farm.md`:
//! `cargo xtask scaling [--quick | LIGHTS | placed | workers]`.

use std::fs;
use std::io::{IsTerminal, stderr};
use std::process::ExitCode;

use benches::page::{read_table, root, write_table};
use light_render::{available_memory, plot};

mod columns;
mod measure;
mod placed;
mod workers;

use columns::{Measured, Row};
use measure::Effort;
use workers::Job;

/// The page that the table is on.
const PAGE: &str = "docs/light-bvh.md";

/// The page that says what farms render.
const FARM_PAGE: &str = "docs/farm.md";

/// The plot of that page.
const FARM_PLOT: &str = "docs/images/scaling-workers.svg";

/// Lights of the largest city of placed houses.
const LARGEST_PLACED: usize = 1_000_000_000;

/// Lights of the largest set, if the command does not say and the memory holds it.
const LARGEST: usize = 100_000_000;

/// Lights of the largest set of `--quick`.
const QUICK: usize = 10_000;

/// What the command asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Request {
    /// The table is printed.
    Quick,
    /// Sets of up to so many lights, cities of placed lights and the workers, into the pages.
    UpTo(usize),
    /// Cities of placed lights alone, into the page.
    Placed,
    /// The workers alone, into the page.
    Workers,
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
        [] => Ok(Request::UpTo(largest_held(available_memory()))),
        [flag] if flag == "--quick" => Ok(Request::Quick),
        [part] if part == "placed" => Ok(Request::Placed),
        [part] if part == "workers" => Ok(Request::Workers),
        [lights] => match lights.parse() {
            Ok(lights) if (100..=1_000_000_000).contains(&lights) => Ok(Request::UpTo(lights)),
            _ => Err(format!(
                "{lights}: expected 100 to 1000000000 lights, placed, workers, or --quick"
            )),
        },
        _ => Err("usage: cargo xtask scaling [--quick | LIGHTS | placed | workers]".into()),
    }
}

/// Measures, and writes or prints.
///
/// # Errors
/// Too little memory, a light that a sampler refuses, or a file that cannot be written.
fn run(request: Request) -> Result<(), String> {
    let (largest, largest_placed, effort) = match request {
        Request::Quick => (Some(QUICK), Some(QUICK), Effort::QUICK),
        Request::UpTo(lights) => (Some(lights), Some(LARGEST_PLACED), Effort::FULL),
        Request::Placed => (None, Some(LARGEST_PLACED), Effort::FULL),
        Request::Workers => (None, None, Effort::FULL),
    };
    fits(largest.unwrap_or_default(), available_memory())?;
    let mut rows = Vec::new();
    if request == Request::Placed {
        rows = columns::rows_of(&read_table(PAGE, "scaling")?);
        rows.retain(|row| row.sampler != Measured::Placed);
    }
    for lights in powers_of_ten(largest.unwrap_or_default()) {
        rows.extend(measure::measure(lights, &effort, |what| {
            say(&format!("{lights} lights: {what}"));
        })?);
        keep(request, &mut rows)?;
    }
    for lights in powers_of_ten(largest_placed.unwrap_or_default()) {
        say(&format!("{lights} placed lights"));
        rows.push(placed::measure(lights, &effort)?);
        keep(request, &mut rows)?;
    }
    if !rows.is_empty() {
        print!("{}", columns::table(&columns::in_order(rows)));
    }
    if request == Request::Placed {
        return Ok(());
    }
    let job = if request == Request::Quick {
        Job::QUICK
    } else {
        Job::FULL
    };
    let throughput = workers::measure(job, say)?;
    print!("{}", workers::table(&throughput));
    if request != Request::Quick {
        let series = workers::series(&throughput);
        let svg = plot::log_plot_file(&series, "workers", "million samples a second");
        fs::write(root().join(FARM_PLOT), svg).map_err(|e| format!("{FARM_PLOT}: {e}"))?;
        write_table(FARM_PAGE, "scaling", &workers::table(&throughput))?;
    }
    Ok(())
}

/// Tells a user who waits what is measured.
fn say(what: &str) {
    if stderr().is_terminal() {
        eprintln!("{what}");
    }
}

/// Writes what was measured so far: after each size, for the last one may take an hour on a busy
/// machine.
fn keep(request: Request, rows: &mut Vec<Row>) -> Result<(), String> {
    *rows = columns::in_order(core::mem::take(rows));
    if request == Request::Quick {
        return Ok(());
    }
    write_plots(rows)?;
    write_table(PAGE, "scaling", &columns::table(rows))
}

/// Lights of the largest set that so much memory holds, [`LARGEST`] at most.
fn largest_held(available: u64) -> usize {
    let held = powers_of_ten(LARGEST).filter(|&lights| fits(lights, available).is_ok());
    held.last().unwrap_or(LARGEST)
}

/// Whether sets of so many lights can be measured in so much memory.
///
/// # Errors
/// One line that says what they need.
fn fits(lights: usize, available: u64) -> Result<(), String> {
    let needed = measure::bytes(lights);
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
        let refused = fits(100_000_000, 16 << 30).expect_err("in 16 GB");
        assert!(refused.starts_with("100000000 lights: "), "{refused}");
        assert!(refused.lines().count() == 1, "{refused}");
        assert_eq!(fits(10_000_000, 16 << 30), Ok(()), "these fit");
    }

    #[test]
    fn the_largest_set_is_one_that_the_memory_holds() {
        for (gigabytes, lights) in [(1, 1_000_000), (16, 10_000_000), (22, LARGEST)] {
            assert_eq!(largest_held(gigabytes << 30), lights, "in {gigabytes} GB");
        }
        assert!(fits(largest_held(0), 0).is_err(), "no memory");
    }

    #[test]
    fn requests_are_sizes_or_quick() {
        let of = |text: &str| request(&[text.to_owned()]);
        assert_eq!(of("--quick"), Ok(Request::Quick), "a flag");
        assert_eq!(of("1000"), Ok(Request::UpTo(1000)), "a size");
        assert_eq!(of("placed"), Ok(Request::Placed), "a part");
        assert_eq!(of("workers"), Ok(Request::Workers), "a part");
        for wrong in ["99", "-1", "1e6", "10000000000", "fast"] {
            let error = of(wrong).expect_err(wrong);
            assert!(error.starts_with(&format!("{wrong}: expected")), "{error}");
        }
        assert!(matches!(request(&[]), Ok(Request::UpTo(_))), "none");
    }

    #[test]
    fn sizes_are_powers_of_ten() {
        let sizes: Vec<usize> = powers_of_ten(99_999).collect();
        assert_eq!(sizes, [100, 1000, 10_000], "up to the largest");
    }
}
