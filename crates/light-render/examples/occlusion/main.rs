//! How noisy light is after equal time where most lights are hidden: relMSE times seconds of each
//! way to choose lights, in the scenes of `OcclusionKind`; and with `--ceilings` the variance of
//! one choice, split into what better choices can remove and what not; with `--means` whether the
//! means are those of uniform choices.
//!
//! Each picture is compared with both halves of a reference of many more samples, so that the noise
//! of the reference cancels on average; its own relMSE is a column. Pixels that show a light, and
//! those beside them, are left out; relMSE has a floor of the square of a tenth of the mean.
//! Seconds are those of all threads, without building the scene and the hierarchy of lights, but
//! with filling the cells of visibility.

use core::error::Error;

use clap::Parser;

mod arguments;
mod ceilings;
mod figure;
mod gloss;
mod means;
mod methods;
mod pictures;
mod place;
mod shot;

use arguments::Arguments;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    if arguments.ceilings {
        ceilings::ceilings(&arguments)
    } else if arguments.means {
        means::means(&arguments)
    } else {
        pictures::pictures(&arguments)
    }
}
