//! The tests that run a second time without std, where float functions are software.

use std::collections::BTreeSet;
use std::process::Command;

use crate::features::{SOFTWARE_FLOATS, together};
use crate::steps::{Outcome, StepResult, cargo, output, run};

/// Integration tests that run a second time with [`SOFTWARE_FLOATS`], beside the unit tests: of each
/// package the modules of its program `integration`, with pinned values, closed forms, and laws of
/// what it computes by float functions. Other tests compare parts of a crate with each other, by
/// the same float functions, and take the most time.
const MODULES: &[(&str, &[&str])] = &[
    (
        "light-math",
        &["value_stability", "distributions", "solid_angles", "warps"],
    ),
    (
        "light-bvh",
        &["value_stability", "reference_properties", "wide"],
    ),
    ("light-samplers", &["known_probabilities", "visibility"]),
    (
        "light-sources",
        &[
            "conversions",
            "far_from_the_origin",
            "known_values",
            "photometric",
        ],
    ),
    ("light-media", &["closed_forms"]),
    ("light-photometry", &["eulumdat", "lm63"]),
];

/// As [`MODULES`], whole programs: that of light-bounds.
const PROGRAMS: &[&str] = &["contribution"];

/// The unit tests of the crates that work without std, and the tests of what they compute by float
/// functions, without std.
///
/// # Errors
/// What failed, or which tests are missing.
pub fn software_floats() -> StepResult {
    let selection = together(SOFTWARE_FLOATS);
    let mut tree = cargo([
        "tree",
        "--edges",
        "features,normal,dev",
        "--invert",
        "light-math",
    ]);
    if output(tree.args(&selection))?.contains("light-math feature \"std\"") {
        return Err(
            "a test dependency turns on std of light-math: cargo tree --edges features".into(),
        );
    }
    let mut whole = cargo(["test", "--quiet", "--lib"]);
    whole.args(PROGRAMS.iter().flat_map(|name| ["--test", name]));
    run(whole.args(&selection))?;

    let integration = |quiet: &[&str], of_tests: &[&str]| -> Command {
        let mut test = cargo(["test", "--test", "integration"]);
        test.args(quiet).args(&selection).arg("--").args(of_tests);
        test
    };
    // Not quiet: the count of tests that follows each program's list parts the lists.
    let lists = output(&mut integration(&[], &["--list"]))?;
    let names = chosen(&lists, MODULES)?;
    let mut exact = vec!["--exact"];
    exact.extend(names);
    run(&mut integration(&["--quiet"], &exact)).map(|()| Outcome::Passed)
}

/// The tests of the modules, from the lists of all programs.
///
/// # Errors
/// A package of which no program has tests in each of its modules.
fn chosen<'a>(lists: &'a str, modules: &[(&str, &[&str])]) -> Result<BTreeSet<&'a str>, String> {
    let mut names = BTreeSet::new();
    for (package, modules) in modules {
        let is_of = |name: &str, module: &str| {
            let rest = name.strip_prefix(module);
            rest.is_some_and(|rest| rest.starts_with("::"))
        };
        let has_all = |list: &&'a str| {
            let has = |module: &&str| names_in(list).any(|name| is_of(name, module));
            modules.iter().all(has)
        };
        let list = lists.split(" benchmarks\n").find(has_all);
        let list = list.ok_or_else(|| {
            format!("{package}: no program has tests in each module of {modules:?}")
        })?;
        names
            .extend(names_in(list).filter(|name| modules.iter().any(|module| is_of(name, module))));
    }
    Ok(names)
}

/// The names of the tests in a list.
fn names_in(list: &str) -> impl Iterator<Item = &str> {
    list.lines().filter_map(|line| line.strip_suffix(": test"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LISTS: &str = "\
sums::of_two: test
sums::small::of_one: test
sums_of_sums::of_none: test

3 tests, 0 benchmarks
sums::of_two: test
lists::empty: test

2 tests, 0 benchmarks
";

    #[test]
    fn tests_are_chosen_by_the_module() {
        let modules: &[(&str, &[&str])] = &[("a", &["sums"])];
        let expected = BTreeSet::from(["sums::of_two", "sums::small::of_one"]);
        assert_eq!(chosen(LISTS, modules), Ok(expected), "not by a prefix");
        let modules: &[(&str, &[&str])] = &[("b", &["sums", "lists"])];
        let expected = BTreeSet::from(["lists::empty", "sums::of_two"]);
        assert_eq!(chosen(LISTS, modules), Ok(expected), "of one program");
    }

    #[test]
    fn a_module_without_tests_is_an_error() {
        let modules: &[(&str, &[&str])] = &[("a", &["sums"]), ("b", &["sums", "products"])];
        let error = chosen(LISTS, modules).expect_err("no products");
        assert!(error.starts_with("b: "), "{error}");
    }
}
