use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::debian::{Toolchain, libraries, unpacked};
use crate::features::Needs;
use crate::no_std::is_installed;
use crate::steps::{cargo, is_there, output};

/// A machine of the emulator.
#[derive(Debug)]
pub(super) struct Board {
    /// What it is.
    pub(super) name: &'static str,
    /// Its target.
    pub(super) target: &'static str,
    emulator: &'static str,
    arguments: &'static [&'static str],
    /// What its compiler is told besides.
    flags: &'static str,
    /// Nanoseconds that the emulator lets pass for an instruction, as a power of two. Fixed, so
    /// that clocks count instructions.
    shift: u32,
    /// Nanoseconds of a tick of the counter that the programs read.
    tick: u32,
}

/// The boards.
pub(super) const BOARDS: [Board; 2] = [
    Board {
        name: "Cortex-M4F",
        target: "thumbv7em-none-eabihf",
        emulator: "qemu-system-arm",
        arguments: &["-M", "mps2-an386", "-cpu", "cortex-m4"],
        flags: "",
        // A tick of the timer at 25 MHz is less than an instruction of 64 ns.
        shift: 6,
        tick: 40,
    },
    Board {
        name: "RV32IMAC",
        target: "riscv32imac-unknown-none-elf",
        emulator: "qemu-system-riscv32",
        arguments: &["-M", "virt", "-bios", "none"],
        // The linker makes far calls near, as C compilers ask it to.
        flags: " -Ctarget-feature=+relax",
        shift: 0,
        tick: 1,
    },
];

impl Board {
    /// The instructions of so many ticks.
    pub(super) fn instructions(&self, ticks: f64) -> f64 {
        ticks * f64::from(self.tick) / f64::from(1u32 << self.shift)
    }
}

/// What builds and runs programs for a board.
#[derive(Debug)]
pub(super) struct Builder {
    board: &'static Board,
    /// Debian's toolchain, where the installed one has not the target.
    toolchain: Option<Toolchain>,
    linker: Option<PathBuf>,
    /// The folder of unpacked packages with the emulator; `None` where it is installed.
    emulator: Option<PathBuf>,
}

impl Builder {
    /// Finds or fetches what is needed.
    ///
    /// # Errors
    /// One line that says what cannot be had.
    pub(super) fn new(board: &'static Board) -> Result<Self, String> {
        let (toolchain, linker) = if is_installed(board.target)? {
            (None, None)
        } else {
            let reason = |e| {
                let target = board.target;
                format!("no target (rustup target add {target}) and none from Debian ({e})")
            };
            let toolchain = Toolchain::with_sources().map_err(reason)?;
            (Some(toolchain), Some(linker()?))
        };
        let emulator = if is_there(board.emulator) {
            None
        } else {
            let packages = ["qemu-system-arm", "qemu-system-misc"].map(String::from);
            let reason = |e| format!("no {} and none from Debian ({e})", board.emulator);
            Some(unpacked("debian-qemu", &packages).map_err(reason)?)
        };
        Ok(Self {
            board,
            toolchain,
            linker,
            emulator,
        })
    }

    /// The name and version of the compiler.
    pub(super) fn compiler(&self) -> Result<String, String> {
        let mut rustc = match &self.toolchain {
            Some(toolchain) => toolchain.rustc(),
            None => rustc(),
        };
        Ok(output(rustc.arg("--version"))?.trim().to_owned())
    }

    /// A build for the board.
    pub(super) fn cargo_build(&self) -> Command {
        let target = self.board.target;
        // Names of this form say the crate of every function.
        let mut flags = "-Csymbol-mangling-version=v0".to_owned();
        flags += self.board.flags;
        if let Some(linker) = &self.linker {
            flags += &format!(" -Clinker={}", linker.display());
        }
        let mut command = match &self.toolchain {
            Some(toolchain) => toolchain.cargo_build(target, Needs::Core),
            None => cargo(["build", "--release", "--target", target]),
        };
        command.env("RUSTFLAGS", flags);
        command
    }

    /// A run of a program.
    pub(super) fn emulator(&self, program: &Path) -> Command {
        let board = self.board;
        let mut command = match &self.emulator {
            Some(folder) => {
                let mut command = Command::new(folder.join("usr/bin").join(board.emulator));
                command
                    .env("LD_LIBRARY_PATH", libraries(folder))
                    .arg("-L")
                    .arg(folder.join("usr/share/qemu"));
                command
            }
            None => Command::new(board.emulator),
        };
        command
            .args(board.arguments)
            .args(["-nographic", "-monitor", "none", "-serial", "none"])
            .args(["-semihosting-config", "enable=on,target=native"])
            .args(["-icount", &format!("shift={}", board.shift), "-kernel"])
            .arg(program);
        command
    }
}

/// The compiler of the installed toolchain.
fn rustc() -> Command {
    Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
}

/// The linker of the installed toolchain, or Debian's.
fn linker() -> Result<PathBuf, String> {
    let sysroot = output(rustc().args(["--print", "sysroot"]))?;
    let targets = fs::read_dir(Path::new(sysroot.trim()).join("lib/rustlib"));
    let targets = targets.map_err(|e| e.to_string())?.flatten();
    let mut linkers = targets.map(|target| target.path().join("bin/rust-lld"));
    if let Some(linker) = linkers.find(|linker| linker.is_file()) {
        return Ok(linker);
    }
    let folder = unpacked("debian-lld", &["lld".to_owned()]);
    let folder = folder.map_err(|e| format!("no linker: neither rust-lld nor Debian's ({e})"))?;
    Ok(folder.join("usr/bin/ld.lld"))
}
