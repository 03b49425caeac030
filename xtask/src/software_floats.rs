//! The tests that run a second time without std, where float functions are software.

use crate::features::{SOFTWARE_FLOATS, together};
use crate::steps::{Outcome, StepResult, cargo, output, run};

/// The programs of integration tests that run a second time with [`SOFTWARE_FLOATS`], beside the
/// unit tests. Each holds, without std, what depends on float functions.
const PROGRAMS: [&str; 2] = ["contribution", "integration"];

/// The unit tests of the crates that work without std, and the tests of what they compute by float
/// functions, without std.
///
/// # Errors
/// What failed.
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
    let mut test = cargo(["test", "--quiet", "--lib"]);
    test.args(PROGRAMS.iter().flat_map(|name| ["--test", name]));
    run(test.args(&selection)).map(|()| Outcome::Passed)
}

#[cfg(test)]
mod tests {
    use std::fs::read_to_string;

    use super::*;
    use crate::steps::root;

    /// What is pinned bit for bit holds only where float functions are software.
    #[test]
    fn pinned_values_are_tested_without_std() {
        for set in SOFTWARE_FLOATS {
            let main = format!("crates/{}/tests/integration/main.rs", set.package);
            let Ok(main) = read_to_string(root().join(main)) else {
                continue;
            };
            let is_left_out = |name: &str| {
                let (before, _) = main.split_once(&format!("mod {name};"))?;
                let condition = before.lines().next_back()?;
                Some(condition.contains("\"std\""))
            };
            for name in ["value_stability", "cell_values", "known_values"] {
                assert_ne!(is_left_out(name), Some(true), "{name} of {}", set.package);
            }
        }
    }
}
