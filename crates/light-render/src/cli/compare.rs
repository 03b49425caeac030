use std::path::{Path, PathBuf};

use crate::{Comparison, Flip, difference};
use clap::Args;
use light_scene::{Diagnostic, Image, read_signed_image, write_image};
use serde_json::json;

use super::arguments::not_negative;
use super::failure::Failure;
use super::output_file::expect_another;
use super::stdout::say;

/// Compare an image with a reference.
#[derive(Args, Debug)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  lights compare picture.exr reference.exr
  lights compare picture.exr reference.exr --max-relmse 0.01 --diff where.png

Exit status: 0 done, 1 the error or the bias is above its limit, 2 bad usage or bad input."
)]
pub(crate) struct CompareArgs {
    /// The image.
    image: PathBuf,
    /// What it should be.
    reference: PathBuf,
    /// Exit with status 1 above this relMSE.
    #[arg(long, value_name = "X", value_parser = not_negative, allow_hyphen_values = true)]
    max_relmse: Option<f64>,
    /// Exit with status 1 when the mean signed bias of a channel is larger than this, either way.
    #[arg(long, value_name = "X", value_parser = not_negative, allow_hyphen_values = true)]
    max_bias: Option<f64>,
    /// Write a false-colour difference: red too bright, blue too dark.
    #[arg(long, value_name = "IMAGE")]
    diff: Option<PathBuf>,
    /// Print one line of JSON.
    #[arg(long)]
    json: bool,
}

impl CompareArgs {
    /// Compares, prints the figures, and checks them.
    ///
    /// # Errors
    /// Images that cannot be read or differ in size; figures above their limits.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let image = read(&self.image)?;
        let reference = read(&self.reference)?;
        let size = |image: &Image| [image.width(), image.height()];
        if size(&image) != size(&reference) {
            let [w, h] = size(&reference);
            let [x, y] = size(&image);
            let message = format!(
                "is {x} x {y}, expected {w} x {h} as {}",
                self.reference.display()
            );
            return Err(Failure::input(Diagnostic::file(&self.image, message)));
        }
        let comparison = Comparison::new(image.texels(), reference.texels())
            .ok_or_else(|| Failure::Input("nothing to compare".into()))?;
        if let Some(path) = &self.diff {
            let inputs = [self.image.clone(), self.reference.clone()];
            expect_another(path, &inputs, "the images for --diff")?;
            write_difference(path, &image, &reference)?;
        }
        let flip = FlipMeans::of(&image, &reference)?;
        self.print(&comparison, &flip)?;
        self.check(&comparison)
    }

    fn print(&self, c: &Comparison, flip: &FlipMeans) -> Result<(), Failure> {
        let (bias, error) = (c.bias.to_array(), c.bias_error.to_array());
        if self.json {
            let line = json!({
                "relmse": c.rel_mse,
                "mse": c.mse,
                "bias": bias,
                "bias_se": error,
                "flip_ldr": flip.ldr,
                "flip_hdr": flip.hdr,
            });
            return say!("{line}");
        }
        say!("relMSE {:.6e}", c.rel_mse)?;
        say!("MSE    {:.6e}", c.mse)?;
        for (name, (bias, error)) in ["R", "G", "B"].into_iter().zip(bias.into_iter().zip(error)) {
            say!("bias {name} {bias:+.6e} +- {error:.1e}")?;
        }
        say!("FLIP   {:.6} on a screen, radiance clamped at 1", flip.ldr)?;
        say!("FLIP   {:.6} over the exposures of the reference", flip.hdr)
    }

    fn check(&self, c: &Comparison) -> Result<(), Failure> {
        let bias = c.bias.abs().max_element();
        let checks = [
            ("relMSE", c.rel_mse, self.max_relmse),
            ("bias", bias, self.max_bias),
        ];
        for (name, value, limit) in checks {
            if let Some(limit) = limit.filter(|limit| value > *limit) {
                return Err(Failure::Check(format!(
                    "{name} {value:e} is above {limit:e}"
                )));
            }
        }
        Ok(())
    }
}

/// The means of FLIP: 0 where both pictures look the same, at most 1.
struct FlipMeans {
    ldr: f64,
    hdr: f64,
}

impl FlipMeans {
    fn of(image: &Image, reference: &Image) -> Result<Self, Failure> {
        let (a, b) = (image.texels(), reference.texels());
        let width = image.width();
        let mean = |flip: Option<Flip>| {
            let flip = flip.ok_or_else(|| Failure::Input("nothing to compare".into()));
            flip.map(|flip| flip.mean())
        };
        Ok(Self {
            ldr: mean(Flip::ldr(a, b, width))?,
            hdr: mean(Flip::hdr(a, b, width))?,
        })
    }
}

fn read(path: &Path) -> Result<Image, Failure> {
    read_signed_image(path)
        .map(|file| file.image)
        .map_err(Failure::input)
}

fn write_difference(path: &Path, image: &Image, reference: &Image) -> Result<(), Failure> {
    let pairs = image.texels().iter().zip(reference.texels());
    let colors = pairs.map(|(&x, &r)| difference(x, r)).collect();
    let picture = Image::new(image.width(), image.height(), colors).map_err(Failure::input)?;
    write_image(path, &picture).map_err(Failure::input)
}
