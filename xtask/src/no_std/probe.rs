use std::fs;

use crate::features::{FeatureSet, Needs, for_each_set};
use crate::steps::{StepResult, cargo, root, run};

/// Checks a static library for this machine for each crate alone, which brings its own panic
/// handler.
///
/// The compiler finds a second panic handler if std is in it, and the want of an allocator if alloc
/// is: the crates are held to `no_std` by the stable toolchain, without any other target. It finds
/// both before it makes code, of which the bare target makes enough.
pub(super) fn check() -> StepResult {
    for_each_set(|set| set.needs != Needs::Std, check_set)
}

fn check_set(set: &FeatureSet) -> Result<(), String> {
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
    let mut check = cargo(["check", "--quiet", "--manifest-path"]);
    check
        .arg(folder.join("Cargo.toml"))
        .arg("--target-dir")
        .arg(of_needs.join("target"));
    run(&mut check)
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

/// An allocator that never has any memory.
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
    use std::path::Path;
    use std::process::Command;

    use super::*;
    use crate::features::FEATURE_SETS;
    use crate::steps::output;

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

    /// Checks the probe of a set with needs, with a library of this text in place of the crate.
    fn probed(folder: &Path, library: &str, needs: Needs) -> Result<String, String> {
        fs::create_dir_all(folder).expect("a folder");
        let set = FeatureSet {
            package: "library",
            features: "",
            needs,
        };
        let compile = |name: &str, text: &str, of_kind: &[&str]| {
            let file = folder.join(name).with_extension("rs");
            fs::write(&file, text).expect("a file");
            let mut rustc = Command::new("rustc");
            rustc.args(["--edition", "2024", "--emit", "metadata", "-Cpanic=abort"]);
            rustc.args(["-L", ".", "--crate-type"]).args(of_kind);
            output(rustc.arg(&file).current_dir(folder))
        };
        compile("library", library, &["lib"])?;
        compile("probe", &source(&set), &["staticlib", "--extern=library"])
    }

    #[test]
    fn std_and_alloc_are_found() {
        let folder = root().join("target/no-std/tests");
        let core = "#![no_std]";
        let alloc = "#![no_std]\nextern crate alloc;";
        let std = "#![no_std]\nextern crate std;";
        let probed = |library, needs| probed(&folder, library, needs);
        assert_eq!(probed(core, Needs::Core), Ok(String::new()), "of core");
        assert_eq!(probed(alloc, Needs::Alloc), Ok(String::new()), "of alloc");
        let error = probed(alloc, Needs::Core).expect_err("no allocator");
        assert!(error.contains("no global memory allocator"), "{error}");
        for needs in [Needs::Core, Needs::Alloc] {
            let error = probed(std, needs).expect_err("a second handler");
            assert!(error.contains("duplicate lang item"), "{error}");
        }
    }
}
