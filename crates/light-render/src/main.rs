//! The program `lights`.

mod cli;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Lights and light sampling, shown and measured.
#[derive(Debug, Parser)]
#[command(name = "lights", version)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Bench(cli::bench::BenchArgs),
}

fn main() -> ExitCode {
    let Command::Bench(bench) = Arguments::parse().command;
    match bench.run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("lights: {error}");
            ExitCode::from(2)
        }
    }
}
