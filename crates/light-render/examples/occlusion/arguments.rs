use clap::Parser;

use super::gloss::Gloss;
use super::methods::{Method, method};
use super::place::{Place, occluded};

/// Measures choices of lights where most lights are hidden.
#[derive(Clone, Debug, Parser)]
pub(super) struct Arguments {
    /// The scenes, with commas between: names, or KIND:LAMPS:SEED; all kinds of occlusion, small
    /// and large, by default.
    #[arg(long, value_delimiter = ',', default_values_t = occluded())]
    pub(super) scenes: Vec<Place>,
    /// What all diffuse surfaces become: coat:ALPHA, the same under a clear coat, or metal:ALPHA,
    /// silver, each of this roughness.
    #[arg(long)]
    pub(super) gloss: Option<Gloss>,
    /// Choices by their place in the list of all, from 0 on, with commas between; the first is what
    /// the others are set against. 4 and 5 are cells wherever lights are hidden.
    #[arg(long, value_delimiter = ',', value_parser = method, default_value = "0,1,2,3")]
    pub(super) methods: Vec<&'static Method>,
    /// Samples a pixel, with commas between.
    #[arg(long, value_delimiter = ',', default_values_t = [16, 64, 256, 1024])]
    pub(super) samples: Vec<u32>,
    /// Width and height of the pictures.
    #[arg(long, default_value = "384x256", value_parser = size)]
    pub(super) size: (u32, u32),
    /// Samples a pixel of each half of the reference.
    #[arg(long, default_value_t = 768)]
    pub(super) reference: u32,
    /// Render so many upright strips alone, evenly over the picture, that show a quarter of it: each
    /// figure is an estimate of that of the whole, better from many narrow strips than from a few,
    /// which meet too many or none of the noisiest pixels. Cells are those of the whole. With 0 the
    /// whole is rendered.
    #[arg(long, default_value_t = 32)]
    pub(super) strips: u32,
    /// Pictures of other seeds that each figure is the mean of; at least two with --means.
    #[arg(long, default_value_t = 1)]
    pub(super) seeds: u32,
    /// Segments of the longest path: 2 is direct light.
    #[arg(long, default_value_t = 2)]
    pub(super) max_depth: u32,
    /// Print the variance of one choice instead, exact over all lights.
    #[arg(long)]
    pub(super) ceilings: bool,
    /// Print how far the means of pictures are from those of uniform choices instead, in standard
    /// errors: all means are the same if no light is lost.
    #[arg(long, conflicts_with = "ceilings")]
    pub(super) means: bool,
    /// With --ceilings: receivers, one for each pixel of a picture of this size.
    #[arg(long, default_value = "24x16", value_parser = size)]
    pub(super) receivers: (u32, u32),
    /// With --ceilings: the points of each light are the square of this.
    #[arg(long, default_value_t = 3)]
    pub(super) strata: u16,
}

/// `WIDTHxHEIGHT`.
fn size(text: &str) -> Result<(u32, u32), String> {
    let read = |part: &str| part.parse().ok().filter(|&n: &u32| n > 0 && n <= 1 << 12);
    let ends = text
        .split_once('x')
        .and_then(|(width, height)| Some((read(width)?, read(height)?)));
    ends.ok_or_else(|| "expected WIDTHxHEIGHT, each 1 to 4096".to_owned())
}
