use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::features::Needs;
use crate::steps::{output, root};

/// Debian's Rust with the sources of its libraries, unpacked into a folder and not installed.
#[derive(Debug)]
pub(super) struct Toolchain {
    folder: PathBuf,
}

/// The packages; what else they need and this machine lacks is asked of apt.
const PACKAGES: [&str; 3] = ["rustc-web", "cargo-web", "rust-web-src"];

/// The toolchain in the cache folder, fetched (about 160 MB) when it is not there.
///
/// # Errors
/// One line that says what cannot be had.
pub(super) fn toolchain() -> Result<Toolchain, String> {
    let folder = root().join("target/debian-rust");
    let complete = folder.join("complete");
    if !complete.is_file() {
        let packages = folder.join("packages");
        fs::create_dir_all(&packages).map_err(|e| e.to_string())?;
        fetch(&packages).map_err(|e| e.lines().next().unwrap_or_default().to_owned())?;
        unpack(&packages, &folder)?;
        fs::remove_dir_all(&packages).map_err(|e| e.to_string())?;
        fs::write(&complete, "").map_err(|e| e.to_string())?;
    }
    Ok(Toolchain { folder })
}

/// Downloads the packages and what they need beyond the installed ones.
fn fetch(folder: &Path) -> Result<(), String> {
    let mut plan = Command::new("apt-get");
    plan.args(["install", "--simulate", "--no-install-recommends"])
        .args(PACKAGES);
    let plan = output(plan.env("LC_ALL", "C"))?;
    // Lines such as: Inst rustc-web (1.96.0 Debian:12 [amd64])
    let names = plan
        .lines()
        .filter_map(|line| line.strip_prefix("Inst ")?.split(' ').next());
    println!("    fetching Debian's toolchain");
    output(
        Command::new("apt-get")
            .arg("download")
            .args(names)
            .current_dir(folder),
    )
    .map(|_| ())
}

fn unpack(packages: &Path, folder: &Path) -> Result<(), String> {
    for entry in fs::read_dir(packages).map_err(|e| e.to_string())? {
        let package = entry.map_err(|e| e.to_string())?.path();
        output(Command::new("dpkg").arg("-x").arg(package).arg(folder))?;
    }
    Ok(())
}

impl Toolchain {
    pub(super) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Where libraries of packages are: some are in the one, some in the other folder.
    fn libraries(&self) -> String {
        ["usr/lib", "lib"]
            .map(|folder| {
                self.folder
                    .join(folder)
                    .join(multiarch())
                    .display()
                    .to_string()
            })
            .join(":")
    }

    /// A build for `target` that makes the standard libraries it needs first: without alloc where none is promised.
    pub(super) fn cargo_build(&self, target: &str, needs: Needs) -> Command {
        let programs = self.folder.join("usr/bin");
        let path = std::env::var("PATH").unwrap_or_default();
        let mut command = Command::new(programs.join("cargo"));
        command
            .current_dir(root())
            .args(["build", "--release", "--target", target])
            .arg(if needs == Needs::Core {
                "-Zbuild-std=core"
            } else {
                "-Zbuild-std=core,alloc"
            })
            .env("PATH", format!("{}:{path}", programs.display()))
            .env("LD_LIBRARY_PATH", self.libraries())
            .env("RUSTC", programs.join("rustc"))
            .env("RUSTDOC", programs.join("rustdoc"))
            // The library sources may only be built by a compiler that accepts unstable features.
            .env("RUSTC_BOOTSTRAP", "1")
            .env_remove("CARGO")
            .env_remove("RUSTUP_TOOLCHAIN");
        command
    }
}

/// Debian's name for the folder of this machine's libraries.
fn multiarch() -> String {
    format!("{}-linux-gnu", std::env::consts::ARCH)
}
