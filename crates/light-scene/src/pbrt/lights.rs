use core::f32::consts::PI;

use lights::math::spectrum::photometric::{K_M, Lumen};
use lights::math::spectrum::rec709_luminance;
use lights::sources::{
    Channels, DistantLightDesc, EnvironmentMap, Image, ImageError, ImageInfiniteLightDesc,
    IntensityAmount, IrradianceAmount, LightDesc, MediumInterface, PointLightDesc,
    PortalInfiniteLightDesc, ProjectionLightDesc, RadianceAmount, SpotLightDesc,
    UniformInfiniteLightDesc,
};

use super::file_loc::Typed;
use super::light_check::{self, FarLight};
use super::parameter::ParameterType;
use super::state::{FLATTENED, Reader};
use crate::Diagnostic;
use crate::glam::{Affine3A, Quat, Vec3};
use crate::image::read_environment_from;
use crate::text::shown;

impl Reader {
    pub(super) fn light(&mut self, typed: &Typed<'_>) -> Result<(), Diagnostic> {
        let Typed {
            at,
            kind,
            parameters,
        } = typed;
        let at = *at;
        if self.state.is_singular() {
            let what = format!("LightSource \"{kind}\"");
            self.warn(at, &what, FLATTENED);
            return Ok(());
        }
        let transform = Affine3A::from_mat4(self.state.transform);
        let from = transform.transform_point3(parameters.vec3_or("from", Vec3::ZERO));
        let to = transform.transform_point3(parameters.vec3_or("to", Vec3::Z));
        let scale = parameters.amount_or("scale", 1.0);
        let media = self.light_media();
        if kind == "infinite" {
            expect_one_color(typed)?;
        }
        if is_dark(typed) {
            let what = format!("LightSource \"{kind}\"");
            self.warn(at, &what, DARK);
            self.scene.has_black_lights = true;
            parameters.accept_all();
            return Ok(());
        }
        let light = match kind.as_str() {
            "point" => LightDesc::Point(PointLightDesc {
                position: from,
                emission: self.emission(typed, "I") * with_power(typed, scale, 4.0 * PI),
                amount: IntensityAmount::default(),
                media,
            }),
            "spot" => {
                let up_to = |most: f32| move |angle: f32| (0.0..=most).contains(&angle);
                let domain = "above 0, and up to 180 degrees";
                let is_cone = |angle: f32| angle > 0.0 && angle <= 180.0;
                let angle = parameters.number_where("coneangle", is_cone, domain);
                let angle = angle.unwrap_or(30.0);
                let domain = "from 0 to `coneangle`";
                let delta = parameters.number_where("conedeltaangle", up_to(angle), domain);
                let delta = delta.unwrap_or(5.0).min(angle);
                let (angle, start) = (angle.to_radians(), (angle - delta).to_radians());
                let axis = (to - from).try_normalize();
                let axis = axis.ok_or_else(|| at.diagnostic("expected `from` and `to` apart"))?;
                let solid_angle = PI * (2.0 - angle.cos() - start.cos());
                LightDesc::Spot(SpotLightDesc {
                    transform: Affine3A::from_rotation_translation(
                        Quat::from_rotation_arc(Vec3::Z, axis),
                        from,
                    ),
                    angle,
                    falloff_start: start,
                    emission: self.emission(typed, "I") * with_power(typed, scale, solid_angle),
                    amount: IntensityAmount::default(),
                    media,
                })
            }
            "distant" if from == to => return Err(at.diagnostic("expected `from` and `to` apart")),
            "distant" => LightDesc::Distant(DistantLightDesc {
                direction: from - to,
                emission: self.emission(typed, "L") * with_illuminance(typed, scale, 1.0),
                amount: IrradianceAmount::default(),
            }),
            "projection" => LightDesc::Projection(ProjectionLightDesc {
                // Rows run downward, y upward.
                transform: unscaled(transform) * Affine3A::from_scale(Vec3::new(1.0, -1.0, 1.0)),
                image: self.light_image(typed)?,
                fov: fov(typed).to_radians(),
                amount: match parameters.positive("power") {
                    Some(watts) => IntensityAmount::LuminousPower(Lumen(scale * watts * K_M)),
                    None => IntensityAmount::Radiometric(scale),
                },
                media,
            }),
            "goniometric" => self.goniometric(typed, unscaled(transform), scale)?,
            "infinite" => self.infinite(typed, unscaled(transform), scale)?,
            other => {
                let what = format!("LightSource \"{other}\"");
                let expected = "is not understood and was left out: expected distant, goniometric, \
                                infinite, point, projection or spot";
                self.warn(at, &what, expected);
                parameters.accept_all();
                return Ok(());
            }
        };
        if let Some(message) = light_check::fault(&light) {
            let file = parameters.string("filename");
            let of_file = file.map_or_else(String::new, |file| format!("{}: ", shown(file)));
            return Err(at.diagnostic(of_file + &message));
        }
        self.far_lights.extend(FarLight::new(&light, at));
        self.scene.lights.push(light);
        Ok(())
    }

    /// A light without a surface is in the medium outside.
    pub(super) fn light_media(&self) -> MediumInterface {
        MediumInterface {
            inside: None,
            ..self.state.media
        }
    }

    fn infinite(
        &mut self,
        typed: &Typed<'_>,
        transform: Affine3A,
        scale: f32,
    ) -> Result<LightDesc<lights::sources::Rgb>, Diagnostic> {
        let parameters = &typed.parameters;
        let portal = parameters.vec3s("portal");
        if !parameters.has("filename") && portal.is_none() {
            return Ok(LightDesc::UniformInfinite(UniformInfiniteLightDesc {
                emission: self.emission(typed, "L") * with_illuminance(typed, scale, PI),
                amount: RadianceAmount::default(),
            }));
        }
        let image = if parameters.has("filename") {
            self.light_image(typed)?
        } else {
            one_color(self.emission(typed, "L"))
                .map_err(|error| typed.at.diagnostic(error.to_string()))?
        };
        if image.size()[0] != image.size()[1] {
            let [width, height] = image.size();
            let message = format!(
                "expected a square, equal-area image for an infinite light, found {width} x \
                 {height}: `lights env convert IN OUT --to equal-area` makes one of a lat-long map"
            );
            return Err(typed.at.diagnostic(message));
        }
        let asked = parameters.positive("illuminance");
        let map = EnvironmentMap::EqualArea(image);
        // That of a surface that looks to +z in the map's space, as pbrt has it.
        let of_one = asked.map(|asked| asked / rec709_luminance(map.irradiance(Vec3::Z)));
        let amount = RadianceAmount::Radiometric(scale * of_one.unwrap_or(1.0));
        let Some(portal) = portal else {
            return Ok(LightDesc::ImageInfinite(ImageInfiniteLightDesc {
                transform,
                map,
                amount,
            }));
        };
        let [a, b, c, d] = portal[..] else {
            return Err(typed.at.diagnostic("expected four corners of a portal"));
        };
        // Unlike the map, a portal is in the world whatever the transform in force.
        Ok(LightDesc::PortalInfinite(PortalInfiniteLightDesc {
            transform,
            map,
            amount,
            portal: [a, b, c, d],
        }))
    }

    /// The colour of a light, white by default.
    pub(super) fn emission(&mut self, typed: &Typed<'_>, name: &str) -> Vec3 {
        let emission = typed.parameters.emission(name);
        if emission.is_none() && typed.parameters.has(name) {
            let what = format!("the spectrum of `{name}`");
            self.warn(typed.at, &what, "is not understood and was taken as white");
        }
        emission.unwrap_or(Vec3::ONE)
    }

    pub(super) fn light_image(&mut self, typed: &Typed<'_>) -> Result<Image, Diagnostic> {
        let name = typed.parameters.string("filename");
        let name = name.ok_or_else(|| typed.at.diagnostic("expected \"string filename\""))?;
        let path = self.resolve(name);
        if let Some(known) = self.light_images.get(&path) {
            return Ok(known.clone());
        }
        let file = read_environment_from(&path, self.files);
        let file = file.and_then(|file| self.within_budget(&path, file));
        let file = file.map_err(|error| typed.at.diagnostic(error.to_string()))?;
        self.scene.warnings.extend(file.warning);
        let image = file.image.to_light();
        let image = image.map_err(|error| typed.at.diagnostic(error.to_string()))?;
        self.light_images.insert(path, image.clone());
        Ok(image)
    }
}

/// What is said of a light whose colour is black.
pub(super) const DARK: &str = "gives no light and was left out";

/// Makes sure that the radiance of a light is a picture or a colour, as pbrt does.
pub(super) fn expect_one_color(typed: &Typed<'_>) -> Result<(), Diagnostic> {
    if typed.parameters.has("filename") && typed.parameters.has("L") {
        let message = "expected `filename` or `L`, found both";
        return Err(typed.at.diagnostic(message));
    }
    Ok(())
}

/// A transform without its scale, if that is the same along all axes: the directions of a light
/// have no length.
fn unscaled(transform: Affine3A) -> Affine3A {
    const ROUNDING: f32 = 1e-4;
    let axes = transform.matrix3;
    let lengths = [axes.x_axis, axes.y_axis, axes.z_axis].map(|axis| axis.length());
    let is_alike = |length: f32| (length / lengths[0] - 1.0).abs() <= ROUNDING;
    if !lengths.into_iter().all(is_alike) {
        return transform;
    }
    Affine3A {
        matrix3: axes * lengths[0].recip(),
        ..transform
    }
}

/// Whether the file gives a light no other colour than black.
pub(super) fn is_dark(typed: &Typed<'_>) -> bool {
    let parameters = &typed.parameters;
    let name = match typed.kind.as_str() {
        "point" | "spot" | "goniometric" => "I",
        "distant" | "infinite" | "diffuse" => "L",
        _ => return false,
    };
    parameters.emission(name) == Some(Vec3::ZERO)
}

/// The angle of view in degrees.
pub(super) fn fov(typed: &Typed<'_>) -> f32 {
    let is_angle = |fov: f32| fov > 0.0 && fov < 180.0;
    let fov = typed
        .parameters
        .number_where("fov", is_angle, "between 0 and 180 degrees");
    fov.unwrap_or(90.0)
}

/// A sky of one colour, in as many texels as a portal's sums need.
fn one_color(color: Vec3) -> Result<Image, ImageError> {
    const SIDE: u32 = 32;
    let texels = (0..SIDE * SIDE).flat_map(|_| color.to_array());
    Image::from_f32([SIDE, SIDE], Channels::Rgb, texels.collect::<Vec<_>>())
}

/// The factor of the emission that gives the stated power over this effective solid angle, or
/// `scale`.
fn with_power(typed: &Typed<'_>, scale: f32, solid_angle: f32) -> f32 {
    let power = typed.parameters.positive("power");
    power.map_or(scale, |power| {
        scale * power / (solid_angle * stated_luminance(typed, "I"))
    })
}

/// The factor of the emission that gives the stated illuminance, where emission 1 gives `of_one`,
/// or `scale`.
fn with_illuminance(typed: &Typed<'_>, scale: f32, of_one: f32) -> f32 {
    let asked = typed.parameters.positive("illuminance");
    asked.map_or(scale, |asked| {
        scale * asked / (of_one * stated_luminance(typed, "L"))
    })
}

/// The luminance of a light's colour that stated powers and illuminances are for. As in pbrt it is
/// 1, and an RGB multiplies them; only of a spectrum that has no RGB it is more.
pub(super) fn stated_luminance(typed: &Typed<'_>, name: &str) -> f32 {
    let parameters = &typed.parameters;
    if parameters.kind(name) == Some(ParameterType::Rgb) {
        return 1.0;
    }
    rec709_luminance(parameters.emission(name).unwrap_or(Vec3::ONE))
}
