//! Measures how marches through media converge and draws it for `docs/light-media.md`:
//! `cargo xtask march-convergence`. Prints the slopes, and how far trackers are from the truth.

#[path = "../../tests/integration/support/convergence.rs"]
mod convergence;
mod drawing;
mod figures;

use core::error::Error;
use std::fs;
use std::path::Path;

use figures::MediumFigures;

/// Where the drawing goes, from the project's root.
const DRAWING: &str = "docs/images/march-convergence.svg";

fn main() -> Result<(), Box<dyn Error>> {
    let media = convergence::media().map(|(name, medium)| MediumFigures::measure(name, &medium));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    fs::write(root.join(DRAWING), drawing::drawing(&media))?;
    for medium in &media {
        let name = medium.name;
        println!("{name} slope-rms 0 {:.3}", medium.rms_slope);
        println!("{name} slope-bias 0 {:.3}", medium.bias_slope);
        println!("{name} tracked-off 0 {:e}", medium.tracked_off);
        println!("{name} tracked-error 0 {:e}", medium.tracked_error);
    }
    println!("{DRAWING}");
    Ok(())
}
