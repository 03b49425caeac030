//! The project's reference vectors, all 11,964 cases, on every test run, and a part of the
//! self-test.

use light_conformance::self_test::{Selection, run_folder};
use light_conformance::{check_folder, default_folder};

#[test]
fn nothing_fails() {
    let reports = check_folder(&default_folder()).expect("the vectors are part of the project");
    let text: String = reports.iter().map(ToString::to_string).collect();
    let is_good = reports.iter().all(|r| r.failed == 0 && r.unchecked == 0);
    assert!(is_good, "{text}");
    let lines: usize = reports.iter().map(|r| r.passed + r.exempt).sum();
    assert_eq!((reports.len(), lines), (14, 11_964), "{text}");
}

#[test]
fn changed_results_fail() {
    let table = run_folder(&default_folder(), &Selection::THIN).expect("vectors that pass");
    assert!(table.is_complete(), "{table}");
}
