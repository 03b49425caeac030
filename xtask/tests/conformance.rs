//! The project's own reference vectors, all of them, on every test run.

#[test]
fn nothing_fails() {
    let reports = xtask::conformance::check_folder(&xtask::conformance::default_folder())
        .expect("the vectors are part of the project");
    let text: String = reports.iter().map(ToString::to_string).collect();
    assert!(reports.iter().all(|r| r.failed == 0), "{text}");
}
