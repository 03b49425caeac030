use core::slice::from_ref;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use light_scene::{Diagnostic, write_image};
use lights::sources::{Centroid, MedianCut, MedianCutLight, RegionSums};
use serde_json::{Value, json};

use super::env_regions::draw_regions;
use super::environment::{Environment, MapName};
use super::failure::Failure;
use super::output_file::{expect_another, expect_image};
use super::stdout::say;
use super::whole::whole;

/// Turn an environment map into directional lights of equal energy, by median cut.
///
/// Prints the lights and draws their regions over the map. Directions point toward the lights;
/// irradiance is that of a plane that faces the light; a region is its first column and row, and
/// those behind its last.
#[derive(Args, Debug)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  lights env median-cut studio.exr -n 64 -o regions.png"
)]
pub(crate) struct MedianCutArgs {
    /// The map: .exr, .hdr or .png; 2:1 is lat-long, a square is equal-area.
    image: PathBuf,
    /// How many lights; there are fewer if fewer texels emit light.
    #[arg(short, value_name = "N", value_parser = whole(1..=u32::MAX))]
    n: u32,
    /// How a light's place in its region is weighted.
    #[arg(long, value_name = "WEIGHT", default_value = "luminance")]
    centroid: CentroidName,
    /// How the energy of regions is summed while they are cut.
    #[arg(long, value_name = "SUMS", default_value = "table")]
    sums: SumsName,
    /// What the image is, whatever its shape.
    #[arg(long, value_name = "MAP")]
    map: Option<MapName>,
    /// Print the lights as one line of JSON; this is the default.
    #[arg(long, conflicts_with = "csv")]
    json: bool,
    /// Print the lights as CSV.
    #[arg(long)]
    csv: bool,
    /// The picture of the regions: .png, .exr or .hdr [default: the map's name with
    /// -median-cut.png, in this folder].
    #[arg(short, long, value_name = "IMAGE")]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum CentroidName {
    /// By luminance.
    Luminance,
    /// By squared luminance: closer to the bright spot.
    Squared,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum SumsName {
    /// Exactly, from a summed-area table.
    Table,
    /// Roughly, from coarser images.
    Pyramid,
}

impl MedianCutArgs {
    /// Cuts the map, draws the regions and prints the lights.
    ///
    /// # Errors
    /// Files that cannot be read or written; an image of unclear shape.
    pub(super) fn run(&self) -> Result<(), Failure> {
        let given = self.output.clone();
        let picture = given.unwrap_or_else(|| default_output(&self.image));
        expect_another(
            &picture,
            from_ref(&self.image),
            "the map for the picture of regions",
        )?;
        expect_image(&picture)?;
        let Environment { image, map } = Environment::read(&self.image, self.map)?;
        let refuse = |message: String| Failure::input(Diagnostic::file(&self.image, message));
        let lights = MedianCut::new(image.clone(), map, self.sums.into())
            .and_then(|cut| cut.lights(self.n as usize, self.centroid.into()))
            .map_err(|error| refuse(error.to_string()))?;
        let drawn = draw_regions(&image, map, &lights).map_err(Failure::input)?;
        write_image(&picture, &drawn).map_err(Failure::input)?;
        if self.csv {
            print_csv(&lights)?;
        } else {
            let lights: Vec<Value> = lights.iter().map(report).collect();
            let line = json!({
                "image": self.image.display().to_string(),
                "size": image.size(),
                "map": MapName::from(map).to_string(),
                "n": lights.len(),
                "picture": picture.display().to_string(),
                "lights": lights,
            });
            say!("{line}")?;
        }
        Ok(())
    }
}

/// The picture's name where none is given: in the current folder, not in that of the map.
fn default_output(image: &Path) -> PathBuf {
    let stem = image.file_stem().unwrap_or_default().to_string_lossy();
    PathBuf::from(format!("{stem}-median-cut.png"))
}

fn report(light: &MedianCutLight) -> Value {
    let ([x0, y0], [x1, y1]) = (light.region.min, light.region.max);
    json!({
        "direction": light.direction.to_array(),
        "irradiance": light.irradiance.to_array(),
        "region": [x0, y0, x1, y1],
    })
}

fn print_csv(lights: &[MedianCutLight]) -> Result<(), Failure> {
    say!("direction_x,direction_y,direction_z,irradiance_r,irradiance_g,irradiance_b,x0,y0,x1,y1")?;
    for light in lights {
        let [x, y, z] = light.direction.to_array();
        let [r, g, b] = light.irradiance.to_array();
        let ([x0, y0], [x1, y1]) = (light.region.min, light.region.max);
        say!("{x},{y},{z},{r},{g},{b},{x0},{y0},{x1},{y1}")?;
    }
    Ok(())
}

impl From<CentroidName> for Centroid {
    fn from(name: CentroidName) -> Self {
        match name {
            CentroidName::Luminance => Self::Luminance,
            CentroidName::Squared => Self::SquaredLuminance,
        }
    }
}

impl From<SumsName> for RegionSums {
    fn from(name: SumsName) -> Self {
        match name {
            SumsName::Table => Self::Table,
            SumsName::Pyramid => Self::Pyramid,
        }
    }
}
