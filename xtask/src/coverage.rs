//! `cargo xtask coverage [CRATE...]`: which lines and regions of the core crates their tests reach,
//! by `cargo-llvm-cov`.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::debian;
use crate::mutants::CRATES;
use crate::steps::{Outcome, StepResult, output, root, run};
use crate::tools::{Install, cargo_tool};
use report::Report;

mod explained;
mod report;

/// What the report leaves out: other crates, and files of tests. What a file holds below
/// `mod tests` is cut off later.
const OTHERS: &str =
    "light-testkit|light-scene|light-sets|light-render|crates/lights/|/tests?/|tests\\.rs";

/// Where `cargo-llvm-cov` builds and counts.
const FOLDER: &str = "target/llvm-cov-target";

/// Features that are not on by default and change what the tests run.
const FEATURES: [&str; 4] = [
    "light-bvh/rayon",
    "light-samplers/rayon",
    "light-sources/half",
    "light-sources/rayon",
];

/// Runs the tests of the core crates, or of those named; prints a table of the crates, and what is
/// not reached with the reasons.
///
/// The longer tests of the test kit, which reach more, are left out. The tests of all these crates
/// count together, so that a crate is also reached by those of another one.
///
/// # Errors
/// What could not run.
pub fn coverage(names: &[String]) -> StepResult {
    if let Some(name) = names.iter().find(|name| !CRATES.contains(&name.as_str())) {
        return Err(format!("{name} is none of {}", CRATES.join(", ")));
    }
    let is_chosen = |name: &str| names.is_empty() || names.iter().any(|chosen| chosen == name);
    let tool = cargo_tool("cargo-llvm-cov", Install::Allowed)?;
    let llvm = match Llvm::find() {
        Ok(llvm) => llvm,
        Err(reason) => return Ok(Outcome::Skipped(reason)),
    };
    let command = |arguments: &[&str]| {
        let mut command = Command::new(&tool);
        command
            .arg("llvm-cov")
            .args(arguments)
            .current_dir(root())
            .env_remove("CARGO")
            .envs(llvm.environment())
            .env("LLVM_COV", llvm.program("llvm-cov"))
            .env("LLVM_PROFDATA", llvm.program("llvm-profdata"));
        command
    };
    // Objects and counts of an earlier run may be of other lines.
    run(&mut command(&["clean", "--workspace"]))?;
    let mut tests = command(&["--no-report", "--quiet"]);
    for name in CRATES.into_iter().filter(|name| is_chosen(name)) {
        tests.args(["--package", name]);
        let of_crate = |feature: &&str| feature.split('/').next() == Some(name);
        for feature in FEATURES.into_iter().filter(of_crate) {
            tests.args(["--features", feature]);
        }
    }
    run(&mut tests)?;
    let counts = llvm.merged_counts()?;
    let mut exports = Vec::new();
    for program in programs()? {
        exports.extend(llvm.export(&counts, &program)?);
    }
    let report = Report::from_exports(&exports, is_chosen)?;
    print!("{report}");
    Ok(Outcome::Passed)
}

/// LLVM's programs, by rustup or from Debian.
struct Llvm {
    folder: PathBuf,
    /// What Debian writes behind their names.
    suffix: String,
    /// Where Debian's programs find their libraries.
    libraries: Option<String>,
}

impl Llvm {
    /// Those of rustup's component `llvm-tools`; where it is not installed, Debian's of the
    /// compiler's version.
    fn find() -> Result<Self, String> {
        if let Some(folder) = component()? {
            return Ok(Self {
                folder,
                suffix: String::new(),
                libraries: None,
            });
        }
        let major = major()?;
        let package = format!("llvm-{major}");
        let unpacked = debian::unpacked("debian-llvm", std::slice::from_ref(&package));
        let folder = unpacked.map_err(|reason| {
            format!(
                "no llvm-cov (rustup component add llvm-tools), no {package} from Debian ({reason})"
            )
        })?;
        Ok(Self {
            suffix: format!("-{major}"),
            libraries: Some(debian::libraries(&folder)),
            folder: folder.join("usr/bin"),
        })
    }

    fn program(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{name}{}", self.suffix))
    }

    /// What the programs need to be set.
    fn environment(&self) -> impl Iterator<Item = (&str, &str)> {
        let libraries = self.libraries.as_deref();
        libraries.map(|path| ("LD_LIBRARY_PATH", path)).into_iter()
    }

    fn command(&self, name: &str) -> Command {
        let mut command = Command::new(self.program(name));
        command.envs(self.environment());
        command
    }

    /// The counts of all runs, in one file.
    fn merged_counts(&self) -> Result<PathBuf, String> {
        let folder = root().join(FOLDER);
        let merged = folder.join("all.profdata");
        let mut merge = self.command("llvm-profdata");
        merge.args(["merge", "--output"]).arg(&merged);
        output(merge.args(files(&folder, |path| ends_with(path, "profraw"))?))?;
        Ok(merged)
    }

    /// What one program has run, as JSON with warnings behind it; nothing of a program whose tests
    /// need other features.
    ///
    /// Of a function that is in several programs, `llvm-cov` takes the one that it reads first, and
    /// in that program it may be unused; therefore each program has an export of its own.
    fn export(&self, counts: &Path, program: &Path) -> Result<Option<String>, String> {
        let mut export = self.command("llvm-cov");
        export
            .args(["export", "--skip-functions"])
            .args(["--ignore-filename-regex", OTHERS, "--instr-profile"])
            .arg(counts);
        match output(export.arg(program)) {
            Ok(text) => Ok(Some(text)),
            Err(why) if why.contains("no coverage data found") => Ok(None),
            Err(why) => Err(why),
        }
    }
}

/// The programs that ran: tests of the crates.
fn programs() -> Result<Vec<PathBuf>, String> {
    let folder = root().join(FOLDER).join("debug/deps");
    files(&folder, |path| path.extension().is_none() && path.is_file())
}

/// The files of a folder that are chosen, in their order.
fn files(folder: &Path, is_chosen: impl Fn(&Path) -> bool) -> Result<Vec<PathBuf>, String> {
    let entries = std::fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let paths = entries.filter_map(|entry| entry.ok().map(|e| e.path()));
    let mut paths: Vec<PathBuf> = paths.filter(|path| is_chosen(path)).collect();
    paths.sort();
    Ok(paths)
}

fn ends_with(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|e| e == extension)
}

/// The folder of rustup's component `llvm-tools`, where it is installed.
fn component() -> Result<Option<PathBuf>, String> {
    let sysroot = output(Command::new("rustc").args(["--print", "sysroot"]))?;
    let libraries = PathBuf::from(sysroot.trim()).join("lib/rustlib");
    let hosts = std::fs::read_dir(&libraries).map_err(|e| e.to_string())?;
    Ok(hosts
        .filter_map(Result::ok)
        .map(|host| host.path().join("bin"))
        .find(|programs| programs.join("llvm-cov").is_file()))
}

/// The major version of the compiler's LLVM.
fn major() -> Result<String, String> {
    let rustc = output(Command::new("rustc").arg("-vV"))?;
    let line = rustc.lines().find_map(|l| l.strip_prefix("LLVM version: "));
    let number = line.and_then(|l| l.split('.').next());
    number
        .map(str::to_owned)
        .ok_or_else(|| "rustc -vV names no LLVM version".to_owned())
}
