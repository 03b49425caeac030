//! The linker of LLVM's bitcode, by which the compiler makes PTX.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use crate::debian::{Toolchain, libraries, unpacked};
use crate::steps::{output, root};

/// Kernels are made by Rust 1.96 or newer.
const LEAST_MINOR: u32 = 96;

/// The linker.
#[derive(Debug)]
pub(super) struct Linker {
    /// Where it is, with the tools that it starts.
    pub(super) folder: PathBuf,
    /// Where the libraries of all of them are.
    pub(super) libraries: String,
}

/// Whether the compiler of this `version` has the options of the kernels; otherwise where a newer
/// one is.
pub(super) fn is_recent(version: &str) -> Result<(), String> {
    let release = (version.lines())
        .find_map(|line| line.strip_prefix("release: 1."))
        .ok_or("the compiler does not tell its version")?;
    let minor = release
        .split('.')
        .next()
        .and_then(|n| n.parse::<u32>().ok());
    if minor < Some(LEAST_MINOR) {
        return Err(format!(
            "Debian's lists have Rust 1.{release}, and the kernels need 1.{LEAST_MINOR}: \
             `apt-get update`, and remove target/debian-rust"
        ));
    }
    Ok(())
}

/// Builds the linker from the compiler's sources, unless it is there; `version` is the compiler's.
pub(super) fn linker(rust: &Toolchain, version: &str) -> Result<Linker, String> {
    let llvm = version
        .lines()
        .find_map(|line| line.strip_prefix("LLVM version: "));
    let major = llvm.and_then(|version| version.split('.').next());
    let major = major.ok_or("the compiler does not tell its version of LLVM")?;
    let packages = [
        format!("llvm-{major}"),
        format!("llvm-{major}-linker-tools"),
    ];
    let llvm = unpacked("debian-llvm", &packages)?;
    let folder = root().join("target/ptx-tools/bin");
    let program = folder.join("llvm-bitcode-linker");
    let libraries = format!("{}:{}", libraries(rust.folder()), libraries(&llvm));
    if !program.is_file() {
        let source = source_of_linker(rust)?;
        let target = root().join("target/ptx-tools/target");
        let mut build = rust.cargo();
        build.args(["build", "--quiet", "--release", "--manifest-path"]);
        build
            .arg(source.join("Cargo.toml"))
            .env("CARGO_TARGET_DIR", &target);
        println!("    building the linker of bitcode");
        output(&mut build)?;
        fs::create_dir_all(&folder).map_err(|e| e.to_string())?;
        for tool in ["llvm-link", "opt", "llc"] {
            let from = llvm.join(format!("usr/lib/llvm-{major}/bin/{tool}"));
            fs::copy(&from, folder.join(tool)).map_err(|e| format!("{}: {e}", from.display()))?;
        }
        let built = target.join("release/llvm-bitcode-linker");
        fs::copy(built, &program).map_err(|e| e.to_string())?;
    }
    Ok(Linker { folder, libraries })
}

/// A copy of the linker's sources that is a workspace of its own.
fn source_of_linker(rust: &Toolchain) -> Result<PathBuf, String> {
    let sources = rust.folder().join("usr/src");
    let release = fs::read_dir(&sources).map_err(|e| format!("{}: {e}", sources.display()))?;
    let release = release
        .flatten()
        .map(|entry| entry.path().join("src/tools/llvm-bitcode-linker"));
    let from = release.into_iter().find(|path| path.is_dir());
    let from = from.ok_or("Debian's sources have no llvm-bitcode-linker")?;
    let to = root().join("target/ptx-tools/source");
    fs::create_dir_all(&to).map_err(|e| format!("{}: {e}", to.display()))?;
    output(Command::new("cp").arg("-rT").args([&from, &to]))?;
    let manifest = to.join("Cargo.toml");
    let text = fs::read_to_string(&manifest).map_err(|e| e.to_string())?;
    fs::write(&manifest, text + "\n[workspace]\n").map_err(|e| e.to_string())?;
    Ok(to)
}
