use core::f32::consts::PI;

use lights::math::spectrum::rec709_luminance;
use lights::sources::TextureMapping;

use super::file_loc::Typed;
use super::image_key::ImageKey;
use super::lights::{DARK, expect_one_color, is_dark, stated_luminance};
use super::state::{AreaLight, Reader};
use crate::glam::Vec3;
use crate::scene_light::scaled;
use crate::{Color, ColorImage, Diagnostic};

impl Reader {
    pub(super) fn area_light(&mut self, typed: &Typed<'_>) -> Result<(), Diagnostic> {
        let Typed {
            at,
            kind,
            parameters,
        } = typed;
        if kind != "diffuse" {
            let what = format!("AreaLightSource \"{kind}\"");
            self.warn(*at, &what, "was taken as diffuse");
        }
        expect_one_color(typed)?;
        if is_dark(typed) {
            let what = format!("AreaLightSource \"{kind}\"");
            self.warn(*at, &what, DARK);
            self.scene.has_black_lights = true;
            parameters.accept_all();
            self.state.area_light = None;
            return Ok(());
        }
        let color = match parameters.string("filename") {
            // An image without repetition.
            Some(file) => Color::Image(ColorImage {
                mapping: TextureMapping::default(),
                ..ColorImage::new(self.image(*at, ImageKey::colors(self.resolve(file)))?)
            }),
            None => Color::Constant(self.emission(typed, "L")),
        };
        // A scale multiplies the power, as in pbrt.
        let of_unit_area = parameters.positive("power").map(|power| {
            let luminance = match color {
                Color::Image(_) => rec709_luminance(self.scene.mean(&color)),
                Color::Constant(_) => stated_luminance(typed, "L"),
            };
            power / (PI * luminance)
        });
        self.state.area_light = Some(AreaLight {
            radiance: scaled(color, Vec3::splat(parameters.amount_or("scale", 1.0))),
            two_sided: parameters.is_true("twosided", false),
            of_unit_area,
        });
        Ok(())
    }
}

/// The factor of the radiance that gives an emitting surface of this area its stated power.
pub(super) fn area_scale(light: &AreaLight, area: f32) -> f32 {
    let sides = if light.two_sided { 2.0 } else { 1.0 };
    light
        .of_unit_area
        .map_or(1.0, |factor| factor / (area * sides))
}
