//! The one way to run everything: each module is a command of `cargo xtask`.

use std::process::ExitCode;

mod api;
mod arrows;
mod bench;
mod check;
mod ci;
mod circles;
mod counts;
mod coverage;
mod crates;
mod debian;
mod dependencies;
mod embedded;
mod farm;
mod features;
mod foreign;
mod fuzz;
mod gallery;
mod gpu;
mod mutants;
mod no_std;
mod oldest;
mod packages;
mod processor_time;
mod programs;
mod ptx;
mod references;
mod rust_gpu;
mod software_floats;
mod steps;
mod tint;
mod tools;

use check::WorkspaceTests;
use steps::{StepResult, Steps};
use tools::Install;

const USAGE: &str = "\
usage: cargo xtask [COMMAND]

  (none)                      format, imports, lints, tests over each feature set, documentation
  ci [--tested]               the same, bare targets, microcontrollers in an emulator, the oldest
                              toolchain, packages, fuzz smoke, instruction counts
                              (--tested: `cargo test --workspace` ran before)
  conformance [DIR]           check the reference vectors (default: testdata/pbrt)
  conformance --self-test [DIR]
                              change each of our answers and demand that its case fails
  exhaustive                  check all 2^32 octahedral codes
  bench [FILTER]              time everything, with ratios to the reference
  bench --table [TABLE...]    measure light hierarchies for docs/light-bvh.md: hierarchies,
                              receivers, adversarial, refits
                              (numbers instead: print the first of sets of so many lights)
  counts [--write]            count the instructions of hot paths and compare with
                              benches/counts.txt
  api [--write]               compare the public items of each library crate with docs/api, or
                              write them there
  arrows [--write]            compare the drawing of the crates in ARCHITECTURE.md with the
                              manifests, or write it
  crates [--write [CRATE...]] compare the counts of dependencies in the README of each library with
                              cargo's, or measure its build and write both
  circles                     find source files that import each other
  packages                    make the package of each library, and build it from that
  farm                        run jobs of `lights farm` by the engines that this machine can have,
                              with killed tasks and a lost machine
  families                    write the table of families of places into docs/light-bvh.md
  foreign DIR                 render every scene file below a folder, tiny and within limits, and
                              print what became of it
  gallery [--references]      remake the pictures of docs/gallery.md (the picture of the README and
                              the references of the demo: hours)
  march-convergence           redraw how marches through media converge, for docs/light-media.md
  median-cut-table [IMAGE...] remeasure median-cut lights for docs/light-sources.md
  fuzz [TARGET] [SECONDS]     look for input that breaks a promise (default: all targets, 60 s each)
  coverage [CRATE...]         which lines and regions of the core crates the tests reach
  deny                        check licences, sources and advisories of dependencies
  gpu [QUERIES [SET]]         the shaders of light-gpu against the crates, on this machine's driver
                              or on Mesa's from Debian (default: 2^20 queries a set; with SET
                              of those that have it in their names); the CUDA kernels: made from
                              these sources, assembled, and compared where there is a GPU
  mutants [CRATE] [COUNT|all|missed] [OFFSET]
                              break the core crates on purpose: does a test notice?
                              (default: 60 mutants a crate)
  embedded [--write]          run queries of a scene in flash on microcontrollers in an emulator and
                              compare their bits with the host's, or write embedded/README.md
  no-std                      prove that no crate needs std, nor alloc where it promises that
  oldest                      check the libraries with the oldest compiler that they promise
  ptx                         make the CUDA kernels, gpu/ptx/kernels.ptx, again
  rust-gpu [--write]          compare the places of the core that rust-gpu does not take with
                              docs/rust-gpu.md, or write them there
  scaling [--quick | LIGHTS | placed | workers]
                              measure how the costs of light samplers grow with the lights, to so
                              many (default: 100000000 where the memory holds them, and 10^9
                              that are placed), for docs/light-bvh.md, and what farms render, for
                              docs/farm.md (--quick: to 10000, roughly, printed only)
  brute-force [SEEDS] [FIRST SEED] [KIND]
                              compare very many lights of each kind with quadrature of their
                              descriptions (default: 1000 seeds from 0, all kinds)
  soak [CHOICES] [LIGHT_SAMPLES] [SEED]
                              take very many samples and compare each with its query
                              (default: 10^9, 10^8, seed 1)
  tint                        compile the project's WGSL by `tint`, where it is in the path
  uplift-table                remake the spectra of sRGB colours that light-math ships
";

/// Runs the command that the program's `arguments` (without its name) ask for.
#[must_use]
pub fn run(arguments: &[String]) -> ExitCode {
    let Some((command, rest)) = arguments.split_first() else {
        return all(|steps| check::add_steps(steps, WorkspaceTests::Here));
    };
    match (command.as_str(), rest) {
        ("ci", []) => all(|steps| ci::add_steps(steps, WorkspaceTests::Here)),
        ("ci", [flag]) if flag == "--tested" => {
            all(|steps| ci::add_steps(steps, WorkspaceTests::Before))
        }
        ("oldest", []) => all(oldest::add_steps),
        ("embedded", rest) => all(|steps| embedded::add_steps(steps, rest)),
        ("farm", []) => all(farm::add_steps),
        ("no-std", []) => all(no_std::add_steps),
        ("bench", [flag, names @ ..]) if flag == "--table" => {
            one("bench --table", || programs::bench_tables(names))
        }
        ("families", []) => one("families", || {
            programs::bench_tables(&["families".to_owned()])
        }),
        ("bench", rest) => one("bench", || bench::bench(rest)),
        ("counts", rest) => one("counts", || counts::counts(rest)),
        ("api", rest) => one("public items", || api::api(rest)),
        ("arrows", rest) => one("arrows between crates", || arrows::arrows(rest)),
        ("crates", rest) => one("builds of each crate alone", || crates::crates(rest)),
        ("circles", []) => one("circles of imports", circles::check),
        ("packages", []) => all(packages::add_steps),
        ("foreign", rest) => one("foreign scenes", || foreign::foreign(rest)),
        ("gallery", rest) => one("gallery", || gallery::gallery(rest)),
        ("march-convergence", []) => one("march-convergence", programs::march_convergence),
        ("median-cut-table", images) => {
            one("median-cut-table", || programs::median_cut_table(images))
        }
        ("coverage", rest) => one("coverage", || coverage::coverage(rest)),
        ("deny", []) => all(|steps| dependencies::add_steps(steps, Install::Allowed)),
        ("gpu", rest) => match gpu::wrong_arguments(rest) {
            Some(why) => {
                eprintln!("{why}");
                ExitCode::from(2)
            }
            None => all(|steps| {
                steps.run("shaders by tint", tint::tint);
                steps.run("shaders", || gpu::gpu(rest));
                ptx::add_steps(steps);
            }),
        },
        ("tint", []) => one("shaders by tint", tint::tint),
        ("ptx", []) => one("kernels", ptx::remake),
        ("rust-gpu", rest) => one("places that rust-gpu does not take", || {
            rust_gpu::rust_gpu(rest)
        }),
        ("mutants", rest) => one("mutants", || mutants::mutants(rest)),
        ("fuzz", rest) => one("fuzz", || fuzz::fuzz(rest)),
        ("scaling", rest) => one("scaling", || programs::scaling(rest)),
        ("brute-force", rest) => one("brute-force", || programs::brute_force(rest)),
        ("soak", rest) => one("soak", || programs::soak(rest)),
        ("conformance", rest) => programs::conformance(rest),
        ("exhaustive", rest) => programs::exhaustive(rest),
        ("uplift-table", []) => programs::uplift_table(),
        ("help" | "--help" | "-h", _) => {
            print!("{USAGE}");
            ExitCode::SUCCESS
        }
        _ => {
            eprint!("not understood: {}\n\n{USAGE}", arguments.join(" "));
            ExitCode::from(2)
        }
    }
}

fn all(add_steps: impl FnOnce(&mut Steps)) -> ExitCode {
    let mut steps = Steps::default();
    add_steps(&mut steps);
    steps.finish()
}

fn one(name: &str, step: impl FnOnce() -> StepResult) -> ExitCode {
    all(|steps| steps.run(name, step))
}
