use std::path::Path;

use lights::sources::{TextureMapping, Wrap};

use super::file_loc::{FileLoc, Typed};
use super::image_key::ImageKey;
use super::state::Reader;
use super::texture_kind::TextureKind;
use crate::glam::{Affine2, Vec2, Vec3};
use crate::image::{IMAGE_ENDINGS, expect_image_name, is_image_name, parse_encoded};
use crate::text::shown;
use crate::{Color, ColorImage, Diagnostic, ImageFile, ImageId};

impl Reader {
    /// A texture of an image file.
    pub(super) fn image_map(
        &mut self,
        typed: &Typed<'_>,
        kind: TextureKind,
    ) -> Result<Color, Diagnostic> {
        let parameters = &typed.parameters;
        let file = parameters.string("filename");
        let file = file.ok_or_else(|| typed.at.diagnostic("expected \"string filename\""))?;
        let path = self.resolve(file);
        let scale = parameters.amount_or("scale", 1.0);
        let mapping = self.texture_mapping(typed);
        self.filter(typed);
        if !is_image_name(&path) {
            let what = format!("the image \"{file}\"");
            let message = format!("was taken as grey: expected {IMAGE_ENDINGS}");
            self.warn_kind(typed.at, "image", &what, &message);
            return Ok(self.stand_in());
        }
        let inverted = parameters.is_true("invert", false);
        let key = ImageKey {
            encoding: parameters.string("encoding").unwrap_or("sRGB").to_owned(),
            gray: kind == TextureKind::Float,
            inverted: inverted.then(|| scale.to_bits()),
            ..ImageKey::colors(path)
        };
        let image = match self.image_if_there(typed.at, key)? {
            Ok(image) => image,
            Err(missing) => {
                let what = format!("{missing};");
                let message = "the texture was taken as grey";
                self.warn_kind(typed.at, "missing image", &what, message);
                return Ok(self.stand_in());
            }
        };
        Ok(Color::Image(ColorImage {
            scale: Vec3::splat(if inverted { 1.0 } else { scale }),
            mapping,
            ..ColorImage::new(image)
        }))
    }

    /// The image of a file relative to the scene.
    pub(super) fn image(&mut self, at: FileLoc<'_>, key: ImageKey) -> Result<ImageId, Diagnostic> {
        let image = self.image_if_there(at, key)?;
        image.map_err(|missing| at.diagnostic(missing.to_string()))
    }

    /// The image of a file relative to the scene, or why the file cannot be read.
    fn image_if_there(
        &mut self,
        at: FileLoc<'_>,
        key: ImageKey,
    ) -> Result<Result<ImageId, Diagnostic>, Diagnostic> {
        if let Some(&known) = self.images.get(&key) {
            return Ok(Ok(known));
        }
        let encoding = key.encoding().ok_or_else(|| {
            let found = shown(&key.encoding);
            let message = format!(
                "expected an `encoding` of \"sRGB\", \"linear\" or \"gamma\" and \
                                   a number, found \"{found}\""
            );
            at.diagnostic(message)
        })?;
        let refuse = |error: Diagnostic| at.diagnostic(error.to_string());
        expect_image_name(&key.path).map_err(refuse)?;
        let bytes = match self.files.read(&key.path) {
            Ok(bytes) => bytes,
            Err(missing) => return Ok(Err(missing)),
        };
        let file = parse_encoded(&key.path, &bytes, encoding);
        let file = file.and_then(|file| self.within_budget(&key.path, file));
        let file = file.map_err(refuse)?;
        self.scene.warnings.extend(file.warning);
        let image = self.scene.add_image(key.change(file.image));
        self.images.insert(key, image);
        Ok(Ok(image))
    }

    /// The image of a file, if there is room for it.
    pub(super) fn within_budget(
        &mut self,
        path: &Path,
        file: ImageFile,
    ) -> Result<ImageFile, Diagnostic> {
        self.texels.take(path, file.image.size())?;
        Ok(file)
    }

    /// The mapping of an image by surface parameters.
    pub(super) fn texture_mapping(&mut self, typed: &Typed<'_>) -> TextureMapping {
        let parameters = &typed.parameters;
        let mapping = parameters.string("mapping").unwrap_or("uv");
        let pair = |u, v, default| {
            let [u, v] = [u, v].map(|name| parameters.number_or(name, default));
            Vec2::new(u, v)
        };
        let scale = pair("uscale", "vscale", 1.0);
        let offset = pair("udelta", "vdelta", 0.0);
        let mut transform = Affine2::from_scale_angle_translation(scale, 0.0, offset);
        if mapping != "uv" {
            transform = Affine2::IDENTITY;
            for name in ["v1", "v2"] {
                parameters.accept(name);
            }
            let what = format!("the mapping \"{mapping}\"");
            self.warn(typed.at, &what, "was taken as \"uv\"");
        }
        let wrap = match parameters.string("wrap").unwrap_or("repeat") {
            "repeat" => Wrap::Repeat,
            "clamp" => Wrap::Clamp,
            "black" => Wrap::Black,
            other => {
                let what = format!("the wrap mode \"{other}\"");
                self.warn(typed.at, &what, "was taken as \"repeat\"");
                Wrap::Repeat
            }
        };
        TextureMapping {
            transform,
            wrap: [wrap; 2],
        }
    }

    /// Images are smooth between texels; what blurs those that are far away is the renderer's
    /// samples.
    fn filter(&mut self, typed: &Typed<'_>) {
        typed.parameters.accept("maxanisotropy");
        let filter = typed.parameters.string("filter").unwrap_or("bilinear");
        if !matches!(filter, "bilinear" | "trilinear" | "ewa" | "EWA") {
            let what = format!("the filter \"{filter}\"");
            self.warn(typed.at, &what, "was taken as \"bilinear\"");
        }
    }
}
