//! Measures light hierarchies and writes the tables of `docs/light-bvh.md`:
//! `cargo xtask bench --table [TABLE...]`.

use std::process::ExitCode;

use benches::page::write_table;

mod adversarial;
mod by_cut;
mod families;
mod hierarchies;
mod measure;
mod receivers;
mod refits;

/// The page that the tables are on.
const PAGE: &str = "docs/light-bvh.md";

/// A table: its name, and who makes its lines.
type Table = (&'static str, fn() -> Result<String, String>);

const TABLES: [Table; 5] = [
    ("hierarchies", || hierarchies::table(&[])),
    ("receivers", receivers::table),
    ("adversarial", adversarial::table),
    ("refits", refits::table),
    ("families", families::table),
];

fn main() -> ExitCode {
    let names: Vec<String> = std::env::args().skip(1).collect();
    match tables(&names) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Measures and writes the tables of the given names, all of them if there are none; of numbers,
/// only prints the sets of so many lights.
///
/// # Errors
/// A name that is none, a light that a sampler refuses, a broken law, or a page without a place for
/// the table.
fn tables(names: &[String]) -> Result<(), String> {
    let sizes: Result<Vec<u32>, _> = names.iter().map(|name| name.parse()).collect();
    if let (Ok(sizes), false) = (sizes, names.is_empty()) {
        hierarchies::table(&sizes)?;
        return Ok(());
    }
    let known = |name: &String| TABLES.iter().any(|table| table.0 == name);
    if let Some(unknown) = names.iter().find(|name| !known(name)) {
        let known = TABLES.map(|table| table.0).join(", ");
        return Err(format!("{unknown}: expected numbers of lights, or {known}"));
    }
    for (name, make) in TABLES {
        if names.is_empty() || names.iter().any(|n| n == name) {
            write_table(PAGE, &format!("bench --table {name}"), &make()?)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_tables_are_refused() {
        let error = tables(&["speed".to_owned()]).expect_err("no such table");
        assert!(error.contains("refits"), "{error}");
    }
}
