//! `cargo xtask ci`: everything that a machine can check without being asked twice.

use crate::check::WorkspaceTests;
use crate::steps::Steps;
use crate::tools::Install;
use crate::{
    api, check, counts, crates, dependencies, embedded, fuzz, no_std, oldest, packages, tint,
};

/// Seconds that each fuzz target gets.
const FUZZ_SECONDS: u32 = 5;

/// Adds all steps: the everyday ones, then what needs more tools or more time.
pub fn add_steps(steps: &mut Steps, tests: WorkspaceTests) {
    check::add_steps(steps, tests);
    no_std::add_steps(steps);
    embedded::add_steps(steps, &[]);
    oldest::add_steps(steps);
    packages::add_steps(steps);
    steps.run("dependencies of each crate alone", || crates::crates(&[]));
    dependencies::add_steps(steps, Install::Forbidden);
    steps.run("fuzz targets, a few seconds each", || {
        fuzz::smoke(FUZZ_SECONDS)
    });
    steps.run("shaders by tint", tint::tint);
    steps.run("public items", || api::api(&[]));
    steps.run("instruction counts", || counts::counts(&[]));
}
