//! `cargo xtask bench --table [TABLE...]`: measures light hierarchies and writes the tables of
//! `docs/light-bvh.md`.

use std::fs;
use std::process::Command;

use serde_json::Value;

use crate::steps::{Outcome, StepResult, cargo, output, root, run};

mod adversarial;
mod hierarchies;
mod receivers;
mod refits;

/// The page that the tables are on, each between a line with its name and the same line at the end.
const PAGE: &str = "docs/light-bvh.md";
const END: &str = "<!-- end of the table -->";

/// A table: its name, and who makes its lines.
type Table = (&'static str, fn() -> Result<String, String>);

const TABLES: [Table; 4] = [
    ("hierarchies", || hierarchies::table(&[])),
    ("receivers", receivers::table),
    ("adversarial", adversarial::table),
    ("refits", refits::table),
];

/// Measures and writes the tables of the given names, all of them if there are none; of numbers,
/// only prints the sets of so many lights.
///
/// # Errors
/// A name that is none, the command that failed, an answer that cannot be read, a broken law, or a
/// page without a place for the table.
pub fn bench_table(names: &[String]) -> StepResult {
    let are_sizes = !names.is_empty() && names.iter().all(|name| name.parse::<u32>().is_ok());
    let known = |name: &String| TABLES.iter().any(|table| table.0 == name);
    if let Some(unknown) = names.iter().find(|name| !are_sizes && !known(name)) {
        let known = TABLES.map(|table| table.0).join(", ");
        return Err(format!("{unknown}: expected numbers of lights, or {known}"));
    }
    let package = ["--package", "light-render"];
    run(cargo(["build", "--quiet", "--release"]).args(package))?;
    if are_sizes {
        hierarchies::table(names)?;
        return Ok(Outcome::Passed);
    }
    for (name, make) in TABLES {
        if names.is_empty() || names.iter().any(|n| n == name) {
            let table = make()?;
            let path = root().join(PAGE);
            let page = fs::read_to_string(&path).map_err(|e| format!("{PAGE}: {e}"))?;
            let page = replaced(&page, name, &table)?;
            fs::write(&path, page).map_err(|e| format!("{PAGE}: {e}"))?;
        }
    }
    Ok(Outcome::Passed)
}

/// What `lights bench` answers: one row a sampler, all of which lose no light and keep the laws.
fn measure(arguments: &[&str]) -> Result<Vec<Value>, String> {
    let mut command = Command::new(root().join("target/release/lights"));
    command.args(["bench", "--json"]).args(arguments);
    let rows = output(&mut command)?;
    let rows = rows.lines().map(|line| {
        let row: Value = serde_json::from_str(line).map_err(|e| format!("{line}: {e}"))?;
        lawful(&row)?;
        Ok(row)
    });
    rows.collect()
}

/// Whether no light is lost, and probabilities are some and agree; what a row does not tell was not
/// measured.
fn lawful(row: &Value) -> Result<(), String> {
    let rounding = 1e-5;
    let laws = [
        ("lost_energy", 0.0),
        ("pmf_mismatch", 0.0),
        ("pmf_nan", 0.0),
        ("pmf_sum_max_error", rounding),
    ];
    for (law, most) in laws {
        if row[law].as_f64().is_some_and(|broken| broken > most) {
            let (set, sampler) = (&row["set"], &row["sampler"]);
            return Err(format!("{set}, {sampler}: {law} is {}", row[law]));
        }
    }
    Ok(())
}

/// The number that a row has for `field`.
fn number(row: &Value, field: &str) -> Result<f64, String> {
    let number = row[field].as_f64();
    number.ok_or_else(|| format!("{}, {}: no {field}", row["set"], row["sampler"]))
}

/// Two to four digits, or a power of ten.
fn figure(x: f64) -> String {
    match x {
        _ if x >= 1e5 => format!("{x:.0e}"),
        _ if x >= 10.0 => format!("{x:.0}"),
        _ if x >= 1.0 => format!("{x:.1}"),
        _ => format!("{x:.2}"),
    }
}

/// The page with another table between its marks.
fn replaced(page: &str, name: &str, table: &str) -> Result<String, String> {
    let begin = format!("<!-- cargo xtask bench --table {name} -->");
    let missing = || format!("{PAGE}: no place for the table {name}");
    let (before, rest) = page.split_once(&begin).ok_or_else(missing)?;
    let (_, after) = rest.split_once(END).ok_or_else(missing)?;
    Ok(format!("{before}{begin}\n\n{table}\n{END}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_broken_law_is_no_row() {
        let row = |lost: f64| json!({ "lost_energy": lost, "pmf_mismatch": 0.0, "pmf_nan": 0.0 });
        assert!(lawful(&row(0.0)).is_ok(), "all is kept");
        assert!(lawful(&row(1e-9)).is_err(), "energy is lost");
        let sum = json!({ "pmf_sum_max_error": 1e-3 });
        assert!(lawful(&sum).is_err(), "more than all");
    }

    #[test]
    fn only_the_table_is_replaced() {
        let begin = "<!-- cargo xtask bench --table refits -->";
        let page = format!("a\n{begin}\nold\n{END}\nb\n{END}\n");
        let page = replaced(&page, "refits", "new\n").expect("marks");
        let expected = format!("a\n{begin}\n\nnew\n\n{END}\nb\n{END}\n");
        assert_eq!(page, expected, "the rest stays");
        assert!(
            replaced("without marks", "refits", "new\n").is_err(),
            "none"
        );
    }

    #[test]
    fn unknown_tables_are_refused() {
        let error = bench_table(&["speed".to_owned()]).expect_err("no such table");
        assert!(error.contains("refits"), "{error}");
    }
}
