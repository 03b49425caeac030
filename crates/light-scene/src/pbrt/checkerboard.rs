use lights::sources::{TextureMapping, Wrap};

use super::file_loc::Typed;
use super::state::Reader;
use super::texture_kind::TextureKind;
use crate::glam::{Affine2, Vec2, Vec3};
use crate::{Color, ColorImage, Image};

/// Texels of a check along a side: images are smooth from one texel to the next.
const TEXELS: u32 = 128;

impl Reader {
    /// `Texture "checkerboard"` in the plane: an image of two by two checks, over and over; the
    /// first texture is where the whole parts of u and v add up to an even number.
    ///
    /// # Source
    /// `[PBRT4]`, `textures.cpp`, without its filter.
    pub(super) fn checkerboard(&mut self, typed: &Typed<'_>, kind: TextureKind) -> Color {
        let tex1 = self.texture_or(typed, "tex1", 1.0, kind);
        let tex2 = self.texture_or(typed, "tex2", 0.0, kind);
        let what = "Texture \"checkerboard\"";
        let mut color = |color: Color| {
            if matches!(color, Color::Image(_)) {
                self.warn(
                    typed.at,
                    what,
                    "has images on its checks, which count by their means",
                );
            }
            self.scene.mean(&color)
        };
        let colors = [color(tex1), color(tex2)];
        if typed.parameters.whole("dimension", 3) == Some(3) {
            self.warn(typed.at, what, "of dimension 3 was taken as its mean");
            return Color::Constant(colors[0].midpoint(colors[1]));
        }
        let mapping = self.texture_mapping(typed);
        let side = 2 * TEXELS;
        let check = |at: u32| (at / TEXELS) as usize;
        // Row 0 is on top, where v is 1.
        let texel = |index: u32| colors[(check(index % side) + 1 + check(index / side)) % 2];
        let texels: Vec<Vec3> = (0..side * side).map(texel).collect();
        let image = Image::new(side, side, texels).expect("as many texels as the image has");
        let halves = Affine2::from_scale(Vec2::splat(0.5));
        let image = self.scene.add_image(image);
        Color::Image(ColorImage {
            mapping: TextureMapping {
                transform: halves * mapping.transform,
                wrap: [Wrap::Repeat; 2],
            },
            ..ColorImage::new(image)
        })
    }
}
