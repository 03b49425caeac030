//! The kernels of `gpu/ptx`: `cargo xtask ptx` makes `kernels.ptx` again, `cargo xtask gpu`
//! assembles it, and runs it where there is a GPU.

mod condition;
mod linker;
mod options;
mod sources;
mod tokens;

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use linker::{is_recent, linker};
use options::{TARGET_CPU, WORKSPACE, rust_flags};

use crate::debian::Toolchain;
use crate::steps::{Outcome, StepResult, Steps, cargo, is_there, output, root};

/// Architectures that they are assembled for.
const ARCHITECTURES: [&str; 2] = [TARGET_CPU, "sm_90"];

/// The assembler: NVIDIA's wheel on PyPI.
const ASSEMBLER: &str = "nvidia-cuda-nvcc-cu12==12.9.86";

/// The exit status by which the loader says that there is no GPU.
const NO_DEVICE: i32 = 77;

/// Adds the checks as steps.
pub fn add_steps(steps: &mut Steps) {
    steps.run("kernels: made from these sources", is_current);
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
        .env("RUSTFLAGS", rust_flags())
        .env("LD_LIBRARY_PATH", linker.libraries)
        .env(
            "PATH",
            format!("{}:{}:{path}", linker.folder.display(), programs.display()),
        );
    let sources = sources::line()?;
    output(&mut build)?;
    let made = root().join("target/ptx/nvptx64-nvidia-cuda/release/light_ptx_kernels.ptx");
    let text = fs::read_to_string(&made).map_err(|e| format!("{}: {e}", made.display()))?;
    rounded(&text)?;
    fs::write(kernels(), format!("{sources}\n{text}")).map_err(|e| e.to_string())?;
    Ok(Outcome::Passed)
}

fn kernels() -> PathBuf {
    root().join(WORKSPACE).join("kernels.ptx")
}

/// Compares the digest in the text with the sources.
fn is_current() -> StepResult {
    let text = fs::read_to_string(kernels()).map_err(|e| e.to_string())?;
    sources::is_made_of(&text, &sources::line()?).map(|()| Outcome::Passed)
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
