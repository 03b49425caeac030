use std::path::PathBuf;

use light_scene::Image;

use crate::PartialPicture;

use super::doubts;
use super::failure::Failure;
use super::output_file::has_ending;
use super::output_image::{OutputImage, Precision};
use super::prepared_picture::PreparedPicture;
use super::render_args::RenderArgs;
use super::rendered_picture::RenderedPicture;

impl RenderArgs {
    /// The files to write, all of them tried.
    pub(super) fn outputs(&self) -> Result<Vec<OutputImage>, Failure> {
        let precision = if self.half {
            Precision::Half
        } else {
            Precision::Single
        };
        let open = |path: &PathBuf| {
            let output = OutputImage::new(path, precision)?;
            if self.settings.samples.is_some() {
                output.expect_part()?;
            }
            Ok(output)
        };
        let outputs: Vec<OutputImage> = self.output.iter().map(open).collect::<Result<_, _>>()?;
        if self.layers.is_wanted() && !outputs.iter().any(OutputImage::has_layers) {
            let message = "--aov: expected an .exr file to write, which holds the layers";
            return Err(Failure::Input(message.into()));
        }
        Ok(outputs)
    }

    /// What to say of --half where no file holds half floats.
    pub(super) fn half_doubt(&self) -> Option<String> {
        let reason = if !self.output.iter().any(|path| has_ending(path, "exr")) {
            "no output is an .exr file"
        } else if self.settings.samples.is_some() {
            "parts hold exact sums"
        } else {
            return None;
        };
        self.half.then(|| format!("--half has no effect: {reason}"))
    }

    /// Writes the picture, or the requested part of it.
    pub(super) fn write(
        &self,
        outputs: &[OutputImage],
        picture: &PreparedPicture,
        made: RenderedPicture,
    ) -> Result<(), Failure> {
        let RenderedPicture {
            rendering, layers, ..
        } = made;
        let film = rendering.film;
        if self.settings.samples.is_some() {
            let start = picture.settings.samples.start;
            let part = PartialPicture {
                samples: start..start + film.samples(),
                film,
                identity: picture.identity(),
            };
            return outputs
                .iter()
                .try_for_each(|output| output.write_part(&part));
        }
        let (width, height) = film.resolution();
        let image = Image::new(width, height, film.develop()).map_err(Failure::input)?;
        drop(film);
        let tone_map = self.display.tone_map(&image, picture.exposure);
        let is_shown = outputs.iter().any(|output| !output.has_layers());
        self.doubt(|| {
            let shown = || is_shown.then(|| doubts::of_shown(&image, &tone_map))?;
            let is_fixed = is_shown && !self.display.is_auto(picture.exposure);
            let clipped = || is_fixed.then(|| doubts::of_clipped(&image, &tone_map))?;
            doubts::of_black(&image).or_else(shown).or_else(clipped)
        });
        outputs.iter().try_for_each(|output| match &layers[..] {
            [] => output.write(&image, &tone_map),
            layers => output.write_layers(&image, layers, &tone_map),
        })
    }
}
