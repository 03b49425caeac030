use std::fs;

use crate::features::{FeatureSet, Needs, for_each_set};
use crate::steps::{StepResult, cargo, root, run};

/// Links each crate alone into a library for this machine that brings its own panic handler.
///
/// The link fails with a second panic handler if std is in it, and for want of an allocator if
/// alloc is: the crates are held to `no_std` by the stable toolchain, without any other target.
pub(super) fn check() -> StepResult {
    for_each_set(|set| set.needs != Needs::Std, link)
}

fn link(set: &FeatureSet) -> Result<(), String> {
    let of_needs = root().join("target/no-std").join(set.needs.folder());
    let folder = of_needs.join(set.package);
    let write = |file: &str, text: &str| {
        let path = folder.join(file);
        fs::create_dir_all(path.parent().unwrap_or(&folder))
            .and_then(|()| fs::write(&path, text))
            .map_err(|e| format!("{}: {e}", path.display()))
    };
    write("Cargo.toml", &manifest(set))?;
    write("src/lib.rs", &source(set))?;
    fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock")).map_err(|e| e.to_string())?;
    let mut build = cargo(["build", "--quiet", "--manifest-path"]);
    build
        .arg(folder.join("Cargo.toml"))
        .arg("--target-dir")
        .arg(of_needs.join("target"));
    run(&mut build)
}

fn manifest(set: &FeatureSet) -> String {
    let features = set.features.replace(',', "\", \"");
    let path = root().join("crates").join(set.package);
    format!(
        "[package]\nname = \"probe\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n\
         [lib]\ncrate-type = [\"staticlib\"]\n\n\
         [dependencies]\n{} = {{ path = {:?}, default-features = false, \
         features = [\"{features}\"] }}\n\n\
         [profile.dev]\npanic = \"abort\"\n\n[workspace]\n",
        set.package, path,
    )
}

fn source(set: &FeatureSet) -> String {
    let name = set.package.replace('-', "_");
    let allocator = if set.needs == Needs::Alloc {
        ALLOCATOR
    } else {
        ""
    };
    format!(
        "#![no_std]\npub use {name};\n{allocator}\
         #[panic_handler]\nfn panic(_: &core::panic::PanicInfo<'_>) -> ! {{\n    loop {{}}\n}}\n"
    )
}

/// An allocator that never has any memory: enough to link.
const ALLOCATOR: &str = "
extern crate alloc;
struct Nothing;
unsafe impl core::alloc::GlobalAlloc for Nothing {
    unsafe fn alloc(&self, _: core::alloc::Layout) -> *mut u8 {
        core::ptr::null_mut()
    }
    unsafe fn dealloc(&self, _: *mut u8, _: core::alloc::Layout) {}
}
#[global_allocator]
static NOTHING: Nothing = Nothing;
";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::FEATURE_SETS;

    #[test]
    fn the_manifest_names_the_features() {
        let set = FEATURE_SETS
            .iter()
            .find(|s| s.features == "libm,alloc")
            .expect("such a set");
        assert!(
            manifest(set).contains("features = [\"libm\", \"alloc\"]"),
            "features"
        );
        assert!(source(set).contains("global_allocator"), "an allocator");
    }
}
