use core::slice::from_ref;
use std::path::PathBuf;

use clap::Args;
use light_scene::{Diagnostic, Image, write_image};
use lights::math::SphereMap;
use lights::sources::equal_area_size;

use super::environment::{Environment, MapName};
use super::failure::Failure;
use super::memory_check::check_memory;
use super::output_file::{expect_another, expect_image};
use super::whole::whole;

/// A texel while it is made, as light, as a picture, and in the file.
const BYTES_PER_TEXEL: u64 = 48;

/// Convert a lat-long environment map into an equal-area one, or back.
///
/// Light is kept: each channel integrates over the sphere to what it was. PNG holds 8 bits of sRGB:
/// brighter than 1 is cut off.
#[derive(Args, Debug)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  lights env convert studio.hdr studio-equal-area.exr --to equal-area"
)]
pub(crate) struct ConvertArgs {
    /// The map: .exr, .hdr or .png.
    input: PathBuf,
    /// The converted map: .exr, .hdr or .png.
    output: PathBuf,
    /// What the input is; without, 2:1 is lat-long, a square is equal-area.
    #[arg(long, value_name = "MAP")]
    from: Option<MapName>,
    /// What the output shall be; without, the other of both.
    #[arg(long, value_name = "MAP")]
    to: Option<MapName>,
    /// Rows of the output; without, as many as keep the size of texels.
    #[arg(long, value_name = "N", value_parser = whole(1..=16384))]
    height: Option<u32>,
}

impl ConvertArgs {
    /// Converts the map.
    ///
    /// # Errors
    /// Files that cannot be read or written; an input of unclear shape.
    pub(super) fn run(&self) -> Result<(), Failure> {
        expect_another(&self.output, from_ref(&self.input), "the one that is read")?;
        expect_image(&self.output)?;
        let Environment { image, map } = Environment::read(&self.input, self.from)?;
        let to = self.to.map_or_else(|| other(map), SphereMap::from);
        let size = match self.height {
            Some(height) => shape(to, height),
            None if to == map => image.size(),
            None => shape(to, natural_height(to, image.size()[1])),
        };
        let what = format!("a map of {} x {} texels (--height)", size[0], size[1]);
        check_memory(
            &what,
            u64::from(size[0]) * u64::from(size[1]) * BYTES_PER_TEXEL,
        )?;
        let out = image
            .resampled(map, to, size)
            .map_err(|error| Failure::input(Diagnostic::file(&self.input, error.to_string())))?;
        let out = Image::new(size[0], size[1], out.texels().collect()).map_err(Failure::input)?;
        write_image(&self.output, &out).map_err(Failure::input)
    }
}

fn other(map: SphereMap) -> SphereMap {
    match map {
        SphereMap::LatLong => SphereMap::EqualArea,
        SphereMap::EqualArea => SphereMap::LatLong,
    }
}

fn shape(map: SphereMap, height: u32) -> [u32; 2] {
    match map {
        SphereMap::LatLong => [2 * height, height],
        SphereMap::EqualArea => [height, height],
    }
}

/// Rows of a map whose texels are as large as those of the other map with `height` rows, at the
/// horizon.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "positive, and below the height"
)]
fn natural_height(to: SphereMap, height: u32) -> u32 {
    match to {
        SphereMap::EqualArea => equal_area_size(height),
        SphereMap::LatLong => {
            let rows = f64::from(height) / core::f64::consts::FRAC_2_SQRT_PI;
            (rows.round() as u32).max(1)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back_is_the_same_size() {
        for height in [1, 2, 16, 255, 256, 1000, 8192] {
            let square = natural_height(SphereMap::EqualArea, height);
            assert_eq!(
                natural_height(SphereMap::LatLong, square),
                height,
                "{square}"
            );
        }
    }
}
