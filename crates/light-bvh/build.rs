//! Sets a `cfg` if the compiler has AVX-512: stable Rust has it from 1.89 on.

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
