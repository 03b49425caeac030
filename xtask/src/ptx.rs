//! The kernels of `gpu/ptx`: `cargo xtask ptx` makes `kernels.ptx` again, `cargo xtask gpu`
//! assembles it, and runs it where there is a GPU.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use crate::debian::{Toolchain, libraries, unpacked};
use crate::steps::{Outcome, StepResult, Steps, cargo, is_there, output, root};

/// The workspace of the kernels.
const WORKSPACE: &str = "gpu/ptx";

/// The oldest architecture that the kernels run on.
const TARGET_CPU: &str = "sm_75";

/// Architectures that they are assembled for.
const ARCHITECTURES: [&str; 2] = [TARGET_CPU, "sm_90"];

/// Kernels are made by Rust 1.96 or newer.
const LEAST_MINOR: u32 = 96;

/// The assembler: NVIDIA's wheel on PyPI.
const ASSEMBLER: &str = "nvidia-cuda-nvcc-cu12==12.9.86";

/// The exit status by which the loader says that there is no GPU.
const NO_DEVICE: i32 = 77;

/// Adds the checks as steps.
pub fn add_steps(steps: &mut Steps) {
    steps.run("kernels: rounded as on a CPU, and assembled", assemble);
    steps.run("kernels: the bits of a GPU", compare);
}

/// Builds the kernels with Debian's toolchain.
///
/// # Errors
/// When they do not build.
pub fn remake() -> StepResult {
    let tools = Toolchain::with_sources().and_then(|rust| {
        let version = output(rust.rustc().arg("-vV"))?;
        is_recent(&version)?;
        Ok((linker(&rust, &version)?, rust))
    });
    let (linker, rust) = match tools {
        Ok(tools) => tools,
        Err(reason) => {
            return Ok(Outcome::Skipped(format!(
                "no toolchain from Debian: {reason}"
            )));
        }
    };
    let path = std::env::var("PATH").unwrap_or_default();
    let programs = rust.folder().join("usr/bin");
    let mut build = rust.cargo();
    build
        .args([
            "build",
            "--quiet",
            "--release",
            "-Zbuild-std=core",
            "-p",
            "light-ptx-kernels",
        ])
        .args(["--target", "nvptx64-nvidia-cuda", "--manifest-path"])
        .arg(root().join(WORKSPACE).join("Cargo.toml"))
        .env("CARGO_TARGET_DIR", root().join("target/ptx"))
        .env("RUSTC_BOOTSTRAP", "1")
        .env(
            "RUSTFLAGS",
            format!("-Ctarget-cpu={TARGET_CPU} -Zunstable-options -Cpanic=immediate-abort"),
        )
        .env("LD_LIBRARY_PATH", linker.libraries)
        .env(
            "PATH",
            format!("{}:{}:{path}", linker.folder.display(), programs.display()),
        );
    output(&mut build)?;
    let made = root().join("target/ptx/nvptx64-nvidia-cuda/release/light_ptx_kernels.ptx");
    let text = fs::read_to_string(&made).map_err(|e| format!("{}: {e}", made.display()))?;
    rounded(&text)?;
    fs::write(kernels(), text).map_err(|e| e.to_string())?;
    Ok(Outcome::Passed)
}

fn kernels() -> PathBuf {
    root().join(WORKSPACE).join("kernels.ptx")
}

/// The linker of LLVM's bitcode, by which the compiler makes PTX.
struct Linker {
    /// Where it is, with the tools that it starts.
    folder: PathBuf,
    /// Where the libraries of all of them are.
    libraries: String,
}

/// Whether the compiler of this `version` has the options of the kernels; otherwise where a newer
/// one is.
fn is_recent(version: &str) -> Result<(), String> {
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
fn linker(rust: &Toolchain, version: &str) -> Result<Linker, String> {
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

/// Assembles the kernels.
fn assemble() -> StepResult {
    let text = fs::read_to_string(kernels()).map_err(|e| e.to_string())?;
    rounded(&text)?;
    let assembler = match assembler() {
        Ok(assembler) => assembler,
        Err(reason) => return Ok(Outcome::Skipped(format!("no ptxas: {reason}"))),
    };
    for architecture in ARCHITECTURES {
        let mut command = Command::new(&assembler);
        command
            .args(["-v", "-arch", architecture, "-o", "/dev/null"])
            .arg(kernels());
        let report = command.output().map_err(|e| e.to_string())?;
        let report = String::from_utf8_lossy(&report.stderr).into_owned();
        let used = usage(&report).map_err(|e| format!("{architecture}: {e}"))?;
        for kernel in used {
            println!(
                "    {architecture} {}: {} registers, {} bytes of stack, no spills",
                kernel.name, kernel.registers, kernel.stack
            );
        }
    }
    Ok(Outcome::Passed)
}

/// Compares all answers of a GPU with the host's.
fn compare() -> StepResult {
    let mut command = cargo(["run", "--quiet", "--release", "--manifest-path"]);
    command
        .arg(root().join(WORKSPACE).join("Cargo.toml"))
        .args(["-p", "light-cuda-check"])
        .env("CARGO_TARGET_DIR", root().join("target/cuda"));
    match command.status().map_err(|e| e.to_string())?.code() {
        Some(0) => Ok(Outcome::Passed),
        Some(NO_DEVICE) => Ok(Outcome::Skipped("no GPU that runs CUDA".into())),
        _ => Err("a GPU has other bits than the host".into()),
    }
}

/// NVIDIA's assembler: the installed one, or the wheel, unpacked below `target`.
fn assembler() -> Result<PathBuf, String> {
    if is_there("ptxas") {
        return Ok("ptxas".into());
    }
    let folder = root().join("target/ptxas");
    let program = folder.join("nvidia/cuda_nvcc/bin/ptxas");
    if !program.is_file() {
        println!("    fetching {ASSEMBLER} from PyPI");
        let mut pip = Command::new("python3");
        pip.args(["-m", "pip", "install", "--quiet", "--no-deps", "--target"]);
        output(pip.arg(&folder).arg(ASSEMBLER))
            .map_err(|e| e.lines().last().unwrap_or_default().to_owned())?;
    }
    Ok(program)
}

/// What a kernel takes.
#[derive(Debug, PartialEq)]
struct Usage {
    name: String,
    registers: u32,
    /// Bytes of a thread.
    stack: u32,
}

/// What each kernel takes by the assembler's report.
fn usage(report: &str) -> Result<Vec<Usage>, String> {
    let mut kernels: Vec<Usage> = Vec::new();
    for line in report.lines() {
        if let Some((_, kernel)) = line.split_once("Compiling entry function '") {
            kernels.push(Usage {
                name: kernel.split('\'').next().unwrap_or_default().to_owned(),
                registers: 0,
                stack: 0,
            });
        }
        let Some(kernel) = kernels.last_mut() else {
            continue;
        };
        let number = |before: &str| {
            let (head, _) = line.split_once(before)?;
            head.split(' ').next_back()?.parse().ok()
        };
        for spilled in [" bytes spill stores", " bytes spill loads"] {
            if number(spilled).is_some_and(|bytes: u32| bytes > 0) {
                return Err(format!("{} spills registers: {}", kernel.name, line.trim()));
            }
        }
        if let Some(registers) = number(" registers,") {
            kernel.registers = registers;
        }
        kernel.stack = kernel.stack.max(number(" bytes stack frame").unwrap_or(0));
    }
    if kernels.iter().any(|kernel| kernel.registers == 0) || kernels.is_empty() {
        let error = report.lines().find(|line| line.contains("error"));
        return Err(error
            .unwrap_or("ptxas does not report registers")
            .to_owned());
    }
    Ok(kernels)
}

/// That every operation on floats rounds to the nearest, alone, and none is of 64 bits: an
/// operation that says so is never fused with another.
fn rounded(text: &str) -> Result<(), String> {
    for (number, line) in (1..).zip(text.lines()) {
        let Some(instruction) = line.split_whitespace().find(|word| !word.starts_with('@')) else {
            continue;
        };
        let parts: Vec<&str> = instruction.split('.').collect();
        let computes = ["add", "sub", "mul", "div", "sqrt", "rcp", "fma", "mad"];
        let is_single = parts.contains(&"f32");
        let is_right = match parts[0] {
            _ if parts.contains(&"f64") || parts.contains(&"ftz") || parts.contains(&"approx") => {
                false
            }
            "fma" => false,
            "mad" => !is_single,
            name if computes.contains(&name) && is_single => parts.contains(&"rn"),
            _ => true,
        };
        if !is_right {
            return Err(format!(
                "kernels.ptx:{number}: not rounded as on a CPU: {}",
                line.trim()
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
