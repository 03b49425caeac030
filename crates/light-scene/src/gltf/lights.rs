use core::f32::consts::{FRAC_PI_2, FRAC_PI_4};

use lights::math::spectrum::photometric::{K_M, Lumen};
use lights::math::spectrum::rec709_luminance;
use lights::photometry::{WebType, parse_lm63};
use lights::sources::{
    DistantLightDesc, IntensityAmount, IrradianceAmount, LightDesc, MediumInterface,
    PointLightDesc, Rgb, SpotLightDesc,
};

use super::item::Item;
use super::reader::Reader;
use crate::glam::{Affine3A, Mat3A, Quat, Vec3};
use crate::luminaire::read_next_to;
use crate::text::text_of;
use crate::{Diagnostic, goniometric_light};

impl<'a> Reader<'a> {
    /// The lights that extensions attach to a node.
    pub(super) fn lights(
        &mut self,
        node: &Item<'a>,
        transform: &Affine3A,
    ) -> Result<(), Diagnostic> {
        let root = self.document.root();
        if let Some(extension) = node.extension("KHR_lights_punctual")? {
            let owner = root
                .extension("KHR_lights_punctual")?
                .unwrap_or(root.clone());
            let (_, light) = extension.require("light")?.target_in(&owner, "lights")?;
            if light.get("range")?.is_some() {
                self.warn(&light, "`range` was ignored: light goes on for ever");
            }
            let light = punctual(&light, node, transform)?;
            self.scene.add_named_light(node.name(), light);
        }
        if let Some(extension) = node.extension("EXT_lights_ies")? {
            let owner = root.extension("EXT_lights_ies")?.unwrap_or(root);
            let (_, profile) = extension.require("light")?.target_in(&owner, "lights")?;
            let light = self.measured(&extension, &profile, node, transform)?;
            self.scene.add_named_light(node.name(), light);
        }
        Ok(())
    }

    /// A luminaire whose file is in the document or beside it.
    fn measured(
        &mut self,
        extension: &Item<'a>,
        profile: &Item<'a>,
        node: &Item<'a>,
        transform: &Affine3A,
    ) -> Result<LightDesc<Rgb>, Diagnostic> {
        profile.get("mimeType")?;
        let bytes = match profile.get("uri")? {
            Some(uri) => self.buffers.load(&uri)?,
            None => {
                let view = self.buffers.view(&profile.require("bufferView")?)?;
                view.bytes().to_vec()
            }
        };
        let text = text_of(&bytes);
        let luminaire = parse_lm63(&text, |name| {
            read_next_to(self.document.path(), name, self.buffers.files())
        });
        let luminaire = luminaire.map_err(|error| {
            profile.error(&format!("expected an LM-63 file: {}", error.message))
        })?;
        for warning in &luminaire.warnings {
            self.warn(profile, &warning.message);
        }
        let web = luminaire.web;
        // The extension puts the direction (0, 0) of the file along -z.
        let turned = match web.web_type() {
            WebType::A => Quat::from_rotation_y(FRAC_PI_2),
            WebType::B | WebType::C => Quat::from_rotation_x(FRAC_PI_2),
        };
        let color = color(extension)?.min(Vec3::ONE);
        let multiplier = extension.amount_or("multiplier", 1.0)?;
        let transform = rigid(node, transform)? * Affine3A::from_quat(turned);
        let mut light = goniometric_light(&web, transform, color);
        // A tint reduces the power.
        let lumens = web.total_lumens() * multiplier * rec709_luminance(color);
        light.amount = IntensityAmount::LuminousPower(Lumen(lumens));
        Ok(LightDesc::Goniometric(light))
    }
}

/// A light of `KHR_lights_punctual`: white of so many candelas or lux, times its colour.
fn punctual(
    light: &Item<'_>,
    node: &Item<'_>,
    transform: &Affine3A,
) -> Result<LightDesc<Rgb>, Diagnostic> {
    let emission = color(light)? * (light.amount_or("intensity", 1.0)? / K_M);
    let media = MediumInterface::default();
    let kind = light.require("type")?;
    Ok(match kind.text()? {
        "point" => LightDesc::Point(PointLightDesc {
            position: transform.translation.into(),
            emission,
            amount: IntensityAmount::default(),
            media,
        }),
        "spot" => {
            let (start, angle) = match light.get("spot")? {
                None => (0.0, FRAC_PI_4),
                Some(spot) => {
                    let start = spot.number_or("innerConeAngle", 0.0)?;
                    let angle = spot.number_or("outerConeAngle", FRAC_PI_4)?;
                    // Exporters write equal angles for a sharp edge. One unit in the last place
                    // more is still a right angle.
                    let is_cone = angle > 0.0 && angle <= FRAC_PI_2 * 1.000_001;
                    if !(is_cone && (0.0..=angle).contains(&start)) {
                        let message = "expected an `outerConeAngle` above 0, of at most pi/2, and \
                                       an `innerConeAngle` from 0 on, not above it";
                        return Err(spot.error(message));
                    }
                    (start, angle)
                }
            };
            // Ours emit along +z.
            let turned = Affine3A::from_rotation_x(core::f32::consts::PI);
            LightDesc::Spot(SpotLightDesc {
                transform: rigid(node, transform)? * turned,
                angle,
                falloff_start: start,
                emission,
                amount: IntensityAmount::default(),
                media,
            })
        }
        "directional" => LightDesc::Distant(DistantLightDesc {
            direction: rigid(node, transform)?.transform_vector3(Vec3::Z),
            emission,
            amount: IrradianceAmount::default(),
        }),
        _ => return Err(kind.expected("point, spot or directional")),
    })
}

/// The rotation and the translation of a node: scale does not change a light.
fn rigid(node: &Item<'_>, transform: &Affine3A) -> Result<Affine3A, Diagnostic> {
    let m = &transform.matrix3;
    let axes = || {
        let z = m.z_axis.try_normalize()?;
        let x = (m.x_axis - z * m.x_axis.dot(z)).try_normalize()?;
        Some(Mat3A::from_cols(x, z.cross(x), z))
    };
    let matrix3 =
        axes().ok_or_else(|| node.error("expected a light whose transform is not flat"))?;
    Ok(Affine3A {
        matrix3,
        translation: transform.translation,
    })
}

fn color(owner: &Item<'_>) -> Result<Vec3, Diagnostic> {
    let color = Vec3::from(owner.numbers_or("color", [1.0; 3])?);
    if color.min_element() < 0.0 {
        return Err(owner.error("expected a `color` of at least 0"));
    }
    Ok(color)
}
