//! Sets a `cfg` if the compiler has AVX-512, which stable Rust has from 1.89 on, and one if the
//! machine has no operating system and no instructions for floats.

use std::env;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(avx512)");
    let has_std = env::var_os("CARGO_FEATURE_STD").is_some();
    let is_x86 = env::var("CARGO_CFG_TARGET_ARCH").is_ok_and(|arch| arch == "x86_64");
    if has_std && is_x86 && rustc_minor().is_some_and(|minor| minor >= 89) {
        println!("cargo::rustc-cfg=avx512");
    }
    println!("cargo::rustc-check-cfg=cfg(soft_floats)");
    let is_bare = env::var("CARGO_CFG_TARGET_OS").is_ok_and(|os| os == "none");
    if is_bare && !has_float_instructions() {
        println!("cargo::rustc-cfg=soft_floats");
    }
}

/// Whether the target computes in single precision: by its features, or by its name where those
/// that say so are unstable.
fn has_float_instructions() -> bool {
    let features = env::var("CARGO_CFG_TARGET_FEATURE").unwrap_or_default();
    let abi = env::var("CARGO_CFG_TARGET_ABI").unwrap_or_default();
    abi == "eabihf" || features.split(',').any(|f| ["neon", "sse2"].contains(&f))
}

/// The `y` of a compiler that says it is "rustc 1.y.z"; of another one nothing is known.
fn rustc_minor() -> Option<u32> {
    let version = Command::new(env::var_os("RUSTC")?)
        .arg("--version")
        .output()
        .ok()?;
    let version = String::from_utf8(version.stdout).ok()?;
    let (minor, _) = version.strip_prefix("rustc 1.")?.split_once('.')?;
    minor.parse().ok()
}
