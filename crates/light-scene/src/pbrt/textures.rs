use std::path::Path;

use super::file_loc::Typed;
use super::state::Reader;
use super::texture_kind::{NamedTexture, TextureKind};
use super::tokens::Tokens;
use super::upgrade::UPGRADE;
use crate::glam::Vec3;
use crate::scene_light::scaled;
use crate::text::shown;
use crate::{Color, ColorImage, Diagnostic, Image};

impl Reader {
    /// `Texture "name" "type" "class"` and its parameters.
    pub(super) fn texture(
        &mut self,
        path: &Path,
        tokens: &mut Tokens<'_>,
    ) -> Result<(), Diagnostic> {
        let name = tokens.quoted("a texture's name")?.into_owned();
        let kind = match &*tokens.quoted("a texture's type")? {
            "float" => TextureKind::Float,
            "spectrum" => TextureKind::Spectrum,
            other => {
                let found = shown(other);
                let mut message = format!("expected \"float\" or \"spectrum\", found \"{found}\"");
                if other == "color" {
                    message = format!("{message}; {UPGRADE}");
                }
                return Err(tokens.diagnostic(message));
            }
        };
        let typed = self.typed(path, tokens, "Texture")?;
        let what = format!("Texture \"{}\"", typed.kind);
        self.met_stand_in = false;
        let color = self.texture_color(&typed, &what, kind);
        typed.parameters.check()?;
        self.warn_unused(typed.at, &what, &typed.parameters);
        let texture = NamedTexture {
            color: color?,
            is_stand_in: self.met_stand_in,
        };
        self.textures.insert((kind, name), texture);
        Ok(())
    }

    fn texture_color(
        &mut self,
        typed: &Typed<'_>,
        what: &str,
        kind: TextureKind,
    ) -> Result<Color, Diagnostic> {
        Ok(match typed.kind.as_str() {
            "constant" => self.texture_or(typed, "value", 1.0, kind),
            "scale" => self.scale_texture(typed, kind),
            "mix" => self.mix_texture(typed, kind),
            "imagemap" => self.image_map(typed, kind)?,
            "checkerboard" => self.checkerboard(typed, kind),
            _ => {
                self.warn(typed.at, what, "was taken as grey");
                typed.parameters.accept_all();
                self.stand_in()
            }
        })
    }

    /// What takes the place of a texture that was not read.
    pub(super) const fn stand_in(&mut self) -> Color {
        self.met_stand_in = true;
        Color::Constant(Vec3::splat(0.5))
    }

    /// A parameter that is a colour or the name of a texture.
    pub(super) fn color(&mut self, typed: &Typed<'_>, name: &str, default: f32) -> Color {
        self.lookup(typed, name, default, TextureKind::Spectrum, 1.0)
    }

    /// A parameter that is a number or the name of a texture: of a colour the first channel counts.
    pub(super) fn share(&mut self, typed: &Typed<'_>, name: &str, default: f32) -> Color {
        self.lookup(typed, name, default, TextureKind::Float, f32::INFINITY)
    }

    /// A number, for a parameter that takes no texture.
    pub(super) fn plain_number(&mut self, typed: &Typed<'_>, name: &str) -> Option<f32> {
        if typed.parameters.texture(name).is_none() {
            return typed
                .parameters
                .number_where(name, |n| n >= 0.0, "of at least 0");
        }
        let what = format!("the texture of `{name}`");
        self.warn(typed.at, &what, "was taken as its mean");
        let color = self.share(typed, name, 0.0);
        Some(self.scene.mean(&color).x)
    }

    /// A texture of this kind that another one is made of.
    pub(super) fn texture_or(
        &mut self,
        typed: &Typed<'_>,
        name: &str,
        default: f32,
        kind: TextureKind,
    ) -> Color {
        self.lookup(typed, name, default, kind, f32::INFINITY)
    }

    fn lookup(
        &mut self,
        typed: &Typed<'_>,
        name: &str,
        default: f32,
        kind: TextureKind,
        most: f32,
    ) -> Color {
        if let Some(texture) = typed.parameters.texture(name) {
            let known = |kind| self.textures.get(&(kind, texture.to_owned()));
            if let Some(texture) = known(kind).or_else(|| known(kind.other())) {
                self.met_stand_in |= texture.is_stand_in;
                return texture.color;
            }
            let what = format!("texture \"{texture}\"");
            let message = "is not defined before it is used and was taken as grey";
            self.warn_kind(typed.at, "undefined texture", &what, message);
            return self.stand_in();
        }
        if kind == TextureKind::Float {
            return Color::Constant(Vec3::splat(typed.parameters.amount_or(name, default)));
        }
        let color = typed.parameters.reflectance(name, most);
        if color.is_none() && typed.parameters.has(name) {
            let what = format!("the spectrum of `{name}`");
            let message = "is not understood; the default was taken";
            self.warn(typed.at, &what, message);
        }
        Color::Constant(color.unwrap_or(Vec3::splat(default)))
    }

    fn scale_texture(&mut self, typed: &Typed<'_>, kind: TextureKind) -> Color {
        let color = self.texture_or(typed, "tex", 1.0, kind);
        match (color, self.share(typed, "scale", 1.0)) {
            (color, Color::Constant(scale)) => scaled(color, scale),
            (Color::Constant(color), image) => scaled(image, color),
            both => self.baked(typed, [both.0, both.1], |[color, scale]| color * scale),
        }
    }

    fn mix_texture(&mut self, typed: &Typed<'_>, kind: TextureKind) -> Color {
        let first = self.texture_or(typed, "tex1", 0.0, kind);
        let second = self.texture_or(typed, "tex2", 1.0, kind);
        let amount = self.share(typed, "amount", 0.5);
        self.baked(typed, [first, second, amount], |[first, second, amount]| {
            first.lerp(second, amount.x)
        })
    }

    /// Combines colours texel by texel, or by their means if their mappings differ.
    fn baked<const N: usize>(
        &mut self,
        typed: &Typed<'_>,
        colors: [Color; N],
        together: impl Fn([Vec3; N]) -> Vec3,
    ) -> Color {
        let shown = |color: &Color| match color {
            Color::Image(shown) => Some(*shown),
            Color::Constant(_) => None,
        };
        let images: Vec<ColorImage> = colors.iter().filter_map(shown).collect();
        let scene = &self.scene;
        let size = |shown: &ColorImage| {
            let image = &scene.images[shown.image.0 as usize];
            [image.width(), image.height()]
        };
        let same = |pair: &[ColorImage]| {
            size(&pair[0]) == size(&pair[1]) && pair[0].mapping == pair[1].mapping
        };
        let lie_alike = images.windows(2).all(same);
        let Some(&first) = images.first().filter(|_| lie_alike) else {
            let means = colors.map(|color| scene.mean(&color));
            if !lie_alike {
                let what = format!("the images of a Texture \"{}\"", typed.kind);
                self.warn(typed.at, &what, "do not lie alike and count by their means");
            }
            return Color::Constant(together(means));
        };
        let texel = |index: usize| {
            let of = |color: Color| match color {
                Color::Constant(color) => color,
                Color::Image(shown) => {
                    shown.scale * scene.images[shown.image.0 as usize].texels()[index]
                }
            };
            together(colors.map(of)).max(Vec3::ZERO)
        };
        let [width, height] = size(&first);
        let texels = (0..width as usize * height as usize).map(texel).collect();
        let image = Image::new(width, height, texels).expect("as many texels as the image has");
        Color::Image(ColorImage {
            image: self.scene.add_image(image),
            scale: Vec3::ONE,
            ..first
        })
    }
}
