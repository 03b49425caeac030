use std::path::Path;

use super::state::{At, Reader, Typed};
use super::tokens::Tokens;
use crate::glam::Vec3;
use crate::image::read_image_from;
use crate::{Color, ColorImage, Diagnostic};

impl Reader {
    /// `Texture "name" "type" "class"` and its parameters.
    pub(super) fn texture(
        &mut self,
        path: &Path,
        tokens: &mut Tokens<'_>,
    ) -> Result<(), Diagnostic> {
        let name = tokens.quoted("a texture's name")?.into_owned();
        tokens.quoted("a texture's type")?;
        let typed = self.typed(path, tokens, "Texture")?;
        let color = match typed.kind.as_str() {
            "constant" => self.color(&typed, "value", 1.0),
            "scale" => {
                let color = self.color(&typed, "tex", 1.0);
                let scale = match self.color(&typed, "scale", 1.0) {
                    Color::Constant(scale) => scale,
                    Color::Image(_) => {
                        self.warn(typed.at, "a `scale` that is an image", "was taken as 1");
                        Vec3::ONE
                    }
                };
                scaled(color, scale)
            }
            "imagemap" => {
                let file = typed.parameters.string("filename");
                let file =
                    file.ok_or_else(|| typed.at.diagnostic("expected \"string filename\""))?;
                let scale = Vec3::splat(typed.parameters.number_or("scale", 1.0));
                self.image(typed.at, file, scale)?
            }
            other => {
                self.warn(
                    typed.at,
                    &format!("Texture \"{other}\""),
                    "was taken as grey",
                );
                Color::Constant(Vec3::splat(0.5))
            }
        };
        self.warn_unused(
            typed.at,
            &format!("Texture \"{}\"", typed.kind),
            &typed.parameters,
        );
        self.textures.insert(name, color);
        Ok(())
    }

    /// A parameter that is a colour or the name of a texture.
    pub(super) fn color(&mut self, typed: &Typed<'_>, name: &str, default: f32) -> Color {
        if let Some(texture) = typed.parameters.texture(name) {
            if let Some(color) = self.textures.get(texture) {
                return *color;
            }
            self.warn(
                typed.at,
                &format!("texture \"{texture}\""),
                "is not defined and was taken as grey",
            );
        }
        let color = typed.parameters.reflectance(name);
        if color.is_none() && typed.parameters.has(name) {
            self.warn(
                typed.at,
                &format!("the spectrum of `{name}`"),
                "is not understood; the default was taken",
            );
        }
        Color::Constant(color.unwrap_or(Vec3::splat(default)))
    }

    /// An image of a file beside the scene.
    pub(super) fn image(
        &mut self,
        at: At<'_>,
        file: &str,
        scale: Vec3,
    ) -> Result<Color, Diagnostic> {
        let path = self.beside(file);
        let image = match self.images.get(&path) {
            Some(&known) => known,
            None => {
                let file =
                    read_image_from(&path, self.files).map_err(|e| at.diagnostic(e.to_string()))?;
                self.scene.warnings.extend(file.warning);
                let image = self.scene.add_image(file.image);
                self.images.insert(path, image);
                image
            }
        };
        Ok(Color::Image(ColorImage {
            scale,
            ..ColorImage::new(image)
        }))
    }
}

/// A colour times a factor.
pub(super) fn scaled(color: Color, by: Vec3) -> Color {
    match color {
        Color::Constant(color) => Color::Constant(color * by),
        Color::Image(texture) => Color::Image(ColorImage {
            scale: texture.scale * by,
            ..texture
        }),
    }
}
