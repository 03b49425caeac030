//! The program behind `cargo xtask conformance [--self-test] [DIR]`: compares all vectors of a
//! folder, or changes our answers and demands that the comparison fails.

use std::path::PathBuf;
use std::process::ExitCode;

use light_conformance::self_test::{self, Selection};
use light_conformance::{check_folder, default_folder};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (is_self_test, rest) = match &arguments[..] {
        [flag, rest @ ..] if flag == "--self-test" => (true, rest),
        rest => (false, rest),
    };
    let folder = match rest {
        [] => default_folder(),
        [folder] if !folder.starts_with('-') => PathBuf::from(folder),
        _ => {
            eprintln!("usage: cargo xtask conformance [--self-test] [DIR]");
            return ExitCode::from(2);
        }
    };
    let outcome = if is_self_test {
        self_test::run_folder(&folder, &Selection::ALL).map(|table| {
            print!("{table}");
            table.is_complete()
        })
    } else {
        check_folder(&folder).map(|reports| {
            reports.iter().for_each(|report| print!("{report}"));
            reports
                .iter()
                .all(|report| report.failed == 0 && report.unchecked == 0)
        })
    };
    match outcome {
        Ok(is_good) => ExitCode::from(u8::from(!is_good)),
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}
