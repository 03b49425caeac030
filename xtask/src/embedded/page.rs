use std::fs;

use crate::steps::{Outcome, StepResult, root};

use super::board::Board;
use super::firmware::Measured;

const PAGE: &str = "embedded/README.md";
const START: &str = "<!-- cargo xtask embedded -->\n";
const END: &str = "<!-- end of embedded -->\n";

/// Writes the tables of all boards that ran into the page.
pub(super) fn write(boards: &[(&'static Board, Vec<Measured>)]) -> StepResult {
    if boards.is_empty() {
        return Ok(Outcome::Skipped("nothing was measured".into()));
    }
    let path = root().join(PAGE);
    let error = |e| format!("{PAGE}: {e}");
    let page = fs::read_to_string(&path).map_err(error)?;
    let marks = page.find(START).zip(page.find(END));
    let (start, end) = marks.ok_or(format!("{PAGE}: no place for the tables"))?;
    let (before, after) = (&page[..start + START.len()], &page[end..]);
    fs::write(&path, format!("{before}\n{}\n{after}", tables(boards))).map_err(error)?;
    Ok(Outcome::Passed)
}

fn tables(boards: &[(&'static Board, Vec<Measured>)]) -> String {
    let parts = boards.iter().map(|(board, measured)| {
        format!(
            "On a {}:\n\n{}\n{}",
            board.name,
            queries(board, measured),
            sizes(measured)
        )
    });
    parts.collect::<Vec<_>>().join("\n")
}

fn queries(board: &Board, measured: &[Measured]) -> String {
    let mut table = "| program | query | instructions: mean | least | most | stack, bytes |\n\
                     | --- | --- | ---: | ---: | ---: | ---: |\n"
        .to_owned();
    for Measured {
        firmware, report, ..
    } in measured
    {
        for (cost, [least, mean, most]) in report.rows(board) {
            table += &format!(
                "| `{}` | {} | {mean:.0} | {least:.0} | {most:.0} | {} |\n",
                firmware.name, cost.name, cost.stack
            );
        }
    }
    table
}

fn sizes(measured: &[Measured]) -> String {
    let mut table = "\
| program | code, bytes | constants | static variables | 64-bit floats | code by crate |
| --- | ---: | ---: | ---: | --- | --- |
"
    .to_owned();
    for Measured {
        firmware, program, ..
    } in measured
    {
        let crates = program.code_by_crate();
        let crates = crates.iter().map(|(name, size)| format!("{name} {size}"));
        let doubles = if program.doubles().is_empty() {
            "none"
        } else {
            "linked"
        };
        table += &format!(
            "| `{}` | {} | {} | {} | {doubles} | {} |\n",
            firmware.name,
            program.code,
            program.constants,
            program.memory,
            crates.collect::<Vec<_>>().join(", ")
        );
    }
    table
}
