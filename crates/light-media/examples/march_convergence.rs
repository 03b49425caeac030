//! How marches converge to trackers: medium, quantity, step, error, a line each; then the slopes.
//! `cargo xtask march-convergence` draws it.

#[path = "../tests/support/convergence.rs"]
mod convergence;

use convergence::{march_errors, media, slope, tracked, truth};

fn main() {
    for (name, medium) in media() {
        let errors = march_errors(&medium);
        for e in &errors {
            println!("{name} rms {:e} {:e}", e.step, e.rms);
            println!("{name} bias {:e} {:e}", e.step, e.bias);
        }
        let fine = &errors[2..];
        let rms = slope(fine.iter().map(|e| (e.step, e.rms)));
        let bias = slope(fine.iter().map(|e| (e.step, e.bias)));
        println!("{name} slope-rms 0 {rms:.3}");
        println!("{name} slope-bias 0 {bias:.3}");
        let tracked = tracked(&medium);
        let off = (tracked.mean - truth(&medium)).abs();
        println!("{name} tracked-off 0 {off:e}");
        println!("{name} tracked-error 0 {:e}", tracked.standard_error);
    }
}
