//! The variance of one choice, and what a better one could remove.

use core::error::Error;
use std::time::Instant;

use light_render::bench::{ChoiceKind, scene_variance};

use super::arguments::Arguments;
use super::figure::figure;
use super::place::load;

/// A table of the variance of one choice.
pub(super) fn ceilings(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let mut title = "| scene | lights | receivers | arriving".to_owned();
    let mut line = "| --- | --- | --- | ---".to_owned();
    for kind in ChoiceKind::ALL {
        title += &format!(" | {}", kind.name());
        line += " | ---";
    }
    println!("{title} |\n{line} |");
    for &scene in &arguments.scenes {
        let start = Instant::now();
        let (world, view) = load(scene, arguments.gloss, arguments.receivers)?;
        eprintln!("{scene}: {} lights", world.lights().len());
        let variance = scene_variance(&world, &view, arguments.strata, 1)?;
        print!(
            "| {scene} | {} | {} | {:.2}",
            world.lights().len(),
            variance.receivers,
            variance.arriving
        );
        for (kind, v) in &variance.rows {
            print!(" | {} + {}", figure(v.between), figure(v.within));
            if v.lost > 0.0 {
                eprintln!("{scene}: {} loses {:e} of the light", kind.name(), v.lost);
            }
        }
        println!(" |");
        eprintln!("{scene}: {:.0?}", start.elapsed());
    }
    Ok(())
}
