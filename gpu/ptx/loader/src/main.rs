//! Runs the kernels where there is a GPU: `light-cuda-check [QUERIES]`.
//!
//! Every answer to so many queries (default: 2^20) is compared with the host's, bit for bit. Then
//! it says how many samples a second the GPU, one core and all cores of the host take.

mod gpu;
mod host;
mod work;

use std::process::ExitCode;

use light_bvh::LightBvh;
use light_ptx_queries::Receiver;
use light_sets::{BenchSet, SetKind};

use gpu::Gpu;
use work::Work;

/// The exit status that says that there is no device.
const NO_DEVICE: u8 = 77;

/// Numbers of lights of the trees.
const SIZES: [usize; 3] = [100, 10_000, 1_000_000];

type Result<T, E = Box<dyn core::error::Error>> = core::result::Result<T, E>;

fn main() -> ExitCode {
    let count = match std::env::args().nth(1).map_or(Ok(1 << 20), |n| n.parse()) {
        Ok(count) => count,
        Err(_) => {
            eprintln!("usage: light-cuda-check [QUERIES]");
            return ExitCode::from(2);
        }
    };
    let gpu = match Gpu::new() {
        Ok(gpu) => gpu,
        Err(why) => {
            println!("{why}: not run");
            return ExitCode::from(NO_DEVICE);
        }
    };
    match check(&gpu, count) {
        Ok(0) => {
            println!("identical bits");
            ExitCode::SUCCESS
        }
        Ok(unlike) => {
            eprintln!("{unlike} answers have other bits than the host's");
            ExitCode::FAILURE
        }
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

/// How many answers have other bits than the host's.
fn check(gpu: &Gpu, count: u32) -> Result<usize> {
    println!("{count} queries on {}", gpu.name());
    let mut unlike = gpu.unlike_codes(&work::codes(count))?;
    unlike += gpu.unlike_arrivals(&work::lights(), &work::about_lights(count))?;
    println!(
        "| lights | kernel | GPU, M/s | one core, M/s | {} cores, M/s |",
        host::cores()
    );
    println!("| ---: | --- | ---: | ---: | ---: |");
    let sets = SIZES.map(|size| BenchSet::generate(SetKind::Uniform, size, 1));
    let trees: Vec<LightBvh> = sets.iter().map(work::tree).collect::<Result<_, _>>()?;
    for (set, bvh) in sets.iter().zip(&trees) {
        let size = set.lights.len();
        let work = Work::new(set, count);
        for kernel in work::KERNELS {
            unlike += gpu.unlike_choices(kernel, &bvh.view(), &work)?;
            let [one, all] = [1, host::cores()].map(|n| host::rate(kernel, &bvh.view(), &work, n));
            let rate = gpu.rate(kernel, &bvh.view(), &work)?;
            let name = kernel.name;
            println!("| {size} | {name} | {rate:.0} | {one:.2} | {all:.1} |");
        }
    }
    println!(
        "\n| lights | `light_sample` of one kind | GPU, M/s | near points behind each other |"
    );
    println!("| ---: | --- | ---: | ---: |");
    for (set, bvh) in sets.iter().zip(&trees) {
        kinds(gpu, set, bvh, count)?;
    }
    Ok(unlike)
}

/// Prints how many samples a second receivers of one kind take, in two orders.
fn kinds(gpu: &Gpu, set: &BenchSet, bvh: &LightBvh, count: u32) -> Result<()> {
    let print = |name: &str, work: Work| -> Result<()> {
        let any_order = gpu.rate(work::SAMPLE, &bvh.view(), &work)?;
        let in_order = gpu.rate(work::SAMPLE, &bvh.view(), &work.in_order_of_places())?;
        let size = set.lights.len();
        println!("| {size} | {name} | {any_order:.0} | {in_order:.0} |");
        Ok(())
    };
    for kind in Receiver::ALL {
        print(&format!("{kind:?}"), Work::by(set, count, &[kind]))?;
    }
    print("the five in turn", Work::by(set, count, &Receiver::ALL))
}
