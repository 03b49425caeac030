//! Debian's Rust, unpacked into a cache folder and not installed: it brings the sources of the
//! standard libraries, and a version that is older than the one on most machines.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::features::Needs;
use crate::steps::{output, root};

/// A toolchain from Debian's packages.
#[derive(Debug)]
pub struct Toolchain {
    folder: PathBuf,
}

impl Toolchain {
    /// The newest version with the sources of its libraries, fetched (about 160 MB) when it is not
    /// there.
    ///
    /// # Errors
    /// One line that says what cannot be had.
    pub fn with_sources() -> Result<Self, String> {
        let packages = ["rustc-web", "cargo-web", "rust-web-src"].map(String::from);
        let folder = unpacked("debian-rust", &packages)?;
        Ok(Self { folder })
    }

    /// Version `release` (as `1.85`), fetched (about 100 MB) when it is not there.
    ///
    /// # Errors
    /// One line that says what cannot be had.
    pub fn of_release(release: &str) -> Result<Self, String> {
        // Lines such as: rustc-web | 1.85.0+dfsg3-1~deb12u3 | http://... Packages
        let known = output(Command::new("apt-cache").args(["madison", "rustc-web"]))?;
        let mut versions = known.lines().filter_map(|line| line.split('|').nth(1));
        let version = versions
            .find(|version| version.trim().starts_with(&format!("{release}.")))
            .ok_or_else(|| format!("Debian has no rustc-web {release} for this machine"))?
            .trim();
        let packages = ["rustc-web", "cargo-web", "libstd-rust-web-dev"]
            .map(|package| format!("{package}={version}"));
        let folder = unpacked(&format!("debian-rust-{release}"), &packages)?;
        Ok(Self { folder })
    }
}

/// A folder below `target` that holds the packages and what else they need that this machine lacks.
///
/// # Errors
/// One line that says what cannot be had.
pub fn unpacked(name: &str, packages: &[String]) -> Result<PathBuf, String> {
    let folder = root().join("target").join(name);
    let complete = folder.join("complete");
    if !complete.is_file() {
        let files = folder.join("packages");
        fs::create_dir_all(&files).map_err(|e| e.to_string())?;
        fetch(packages, &files).map_err(|e| e.lines().next().unwrap_or_default().to_owned())?;
        unpack(&files, &folder)?;
        fs::remove_dir_all(&files).map_err(|e| e.to_string())?;
        fs::write(&complete, "").map_err(|e| e.to_string())?;
    }
    Ok(folder)
}

/// Downloads the packages and what they need beyond the installed ones.
fn fetch(packages: &[String], folder: &Path) -> Result<(), String> {
    let mut plan = Command::new("apt-get");
    plan.args(["install", "--simulate", "--no-install-recommends"])
        .args(packages);
    let plan = output(plan.env("LC_ALL", "C"))?;
    // Lines such as: Inst rustc-web (1.96.0 Debian:12 [amd64])
    let downloads = plan.lines().filter_map(|line| {
        let mut words = line.strip_prefix("Inst ")?.split(' ');
        let name = words.next()?;
        let version = words.find_map(|word| word.strip_prefix('('))?;
        Some(format!("{name}={version}"))
    });
    println!("    fetching {} from Debian", packages.join(", "));
    output(
        Command::new("apt-get")
            .arg("download")
            .args(downloads)
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
    /// Where it is unpacked.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Its cargo with its compiler, in the project's root.
    #[must_use]
    pub fn cargo(&self) -> Command {
        let programs = self.folder.join("usr/bin");
        let path = std::env::var("PATH").unwrap_or_default();
        let mut command = Command::new(programs.join("cargo"));
        command
            .current_dir(root())
            .env("PATH", format!("{}:{path}", programs.display()))
            .env("LD_LIBRARY_PATH", libraries(&self.folder))
            .env("RUSTC", programs.join("rustc"))
            .env("RUSTDOC", programs.join("rustdoc"))
            .env_remove("CARGO")
            .env_remove("RUSTUP_TOOLCHAIN");
        command
    }

    /// Its compiler.
    #[must_use]
    pub fn rustc(&self) -> Command {
        let mut command = Command::new(self.folder.join("usr/bin/rustc"));
        command.env("LD_LIBRARY_PATH", libraries(&self.folder));
        command
    }

    /// A build for `target` that makes the standard libraries it needs first: without alloc where
    /// none is promised.
    #[must_use]
    pub fn cargo_build(&self, target: &str, needs: Needs) -> Command {
        let mut command = self.cargo();
        command
            .args(["build", "--release", "--target", target])
            .arg(if needs == Needs::Core {
                "-Zbuild-std=core"
            } else {
                "-Zbuild-std=core,alloc"
            })
            // The library sources may only be built by a compiler that accepts unstable features.
            .env("RUSTC_BOOTSTRAP", "1");
        command
    }
}

/// Where the libraries of unpacked packages are: some are in the one, some in the other folder.
#[must_use]
pub fn libraries(folder: &Path) -> String {
    ["usr/lib", "lib"]
        .map(|part| folder.join(part).join(multiarch()).display().to_string())
        .join(":")
}

/// Debian's name for the folder of this machine's libraries.
fn multiarch() -> String {
    format!("{}-linux-gnu", std::env::consts::ARCH)
}
