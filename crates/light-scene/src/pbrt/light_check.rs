use lights::math::Aabb;
use lights::math::spectrum::photometric::Lumen;
use lights::sources::{
    Channels, EnvironmentMap, Image, ImageInfiniteLightDesc, IntensityAmount, LightDesc,
    LightSetBuilder, PortalInfiniteLightDesc, RadianceAmount, Rgb, RigidTransform, SceneSphere,
};

use super::file_loc::FileLoc;
use crate::Diagnostic;
use crate::glam::{Affine3A, Vec3};

/// Why no light of finite power can be made of what a file says; the renderer, which finds the same
/// later, knows no line.
pub(super) fn fault(light: &LightDesc<Rgb>) -> Option<String> {
    let tried = match light {
        LightDesc::Point(_)
        | LightDesc::Spot(_)
        | LightDesc::Distant(_)
        | LightDesc::UniformInfinite(_) => light.clone(),
        // The tables of a picture take time, and are made again by the renderer.
        LightDesc::ImageInfinite(light) if is_moderate(&light.map, light.amount) => {
            LightDesc::ImageInfinite(ImageInfiniteLightDesc {
                map: black()?,
                ..*light
            })
        }
        LightDesc::PortalInfinite(light) if is_moderate(&light.map, light.amount) => {
            LightDesc::PortalInfinite(PortalInfiniteLightDesc {
                map: black()?,
                ..*light
            })
        }
        LightDesc::ImageInfinite(_) | LightDesc::PortalInfinite(_) => light.clone(),
        LightDesc::Projection(light) => {
            let fault = fault_of_transform("projection", light.transform);
            return fault.or_else(|| fault_of_amount(light.amount));
        }
        LightDesc::Goniometric(light) => {
            let fault = fault_of_transform("goniometric", light.transform);
            return fault.or_else(|| fault_of_amount(light.amount));
        }
        _ => return None,
    };
    match power_in_unit_scene(tried) {
        Ok(power) => fault_of_power(power),
        Err(message) => Some(message),
    }
}

/// The power of one light in a scene of radius 1.
fn power_in_unit_scene(light: LightDesc<Rgb>) -> Result<f32, String> {
    let scene = SceneSphere::new(Vec3::ZERO, 1.0).map_err(|error| error.to_string())?;
    let mut builder = LightSetBuilder::new(scene);
    builder.add(light).map_err(|error| error.to_string())?;
    let powers = builder.build().powers();
    Ok(powers.iter().sum())
}

/// Whether all of the sphere can be as bright as the brightest texel, and more: no sum is infinite
/// then.
fn is_moderate(map: &EnvironmentMap, amount: RadianceAmount) -> bool {
    const SPHERE: f32 = 4.0 * core::f32::consts::PI;
    let (EnvironmentMap::EqualArea(image) | EnvironmentMap::LatLong(image)) = map;
    let RadianceAmount::Radiometric(scale) = amount else {
        return false;
    };
    let brightest = image.texels().map(Vec3::max_element).fold(0.0, f32::max);
    (3.0 * SPHERE * scale * brightest).is_finite()
}

/// A light at infinity without a portal: its power grows with the square of the scene's radius,
/// which is known at the end of the file.
#[derive(Debug)]
pub(super) struct FarLight {
    power_in_unit_scene: f32,
    fault: Diagnostic,
}

impl FarLight {
    /// `None` for other lights.
    pub(super) fn new(light: &LightDesc<Rgb>, at: FileLoc<'_>) -> Option<Self> {
        let light = match light {
            LightDesc::Distant(_) | LightDesc::UniformInfinite(_) => light.clone(),
            LightDesc::ImageInfinite(light) => LightDesc::ImageInfinite(ImageInfiniteLightDesc {
                map: mean_of(&light.map)?,
                ..*light
            }),
            _ => return None,
        };
        Some(Self {
            power_in_unit_scene: power_in_unit_scene(light).ok()?,
            fault: at.diagnostic("expected a light of finite power in a scene of this size"),
        })
    }

    /// What is said of the first of `lights` whose power is infinite in a scene with these bounds.
    pub(super) fn fault_of(lights: Vec<Self>, bounds: &Aabb) -> Option<Diagnostic> {
        let (_, radius) = bounds.bounding_sphere();
        let is_held = |light: &Self| (light.power_in_unit_scene * radius * radius).is_finite();
        let is_scene = !bounds.is_empty() && (radius * radius).is_finite();
        let mut faulty = lights.into_iter().filter(|light| !is_held(light));
        is_scene.then(|| faulty.next())?.map(|light| light.fault)
    }
}

/// A sky without an image, which may be large.
fn black() -> Option<EnvironmentMap> {
    of_one_color(Vec3::ZERO)
}

/// A sky of the mean colour of an equal-area one, as all those of files are.
fn mean_of(map: &EnvironmentMap) -> Option<EnvironmentMap> {
    match map {
        EnvironmentMap::EqualArea(image) => of_one_color(image.mean()),
        EnvironmentMap::LatLong(_) => None,
    }
}

fn of_one_color(color: Vec3) -> Option<EnvironmentMap> {
    let image = Image::from_f32([1, 1], Channels::Rgb, color.to_array().to_vec());
    image.ok().map(EnvironmentMap::EqualArea)
}

fn fault_of_transform(kind: &str, transform: Affine3A) -> Option<String> {
    let error = RigidTransform::new(transform).err()?;
    Some(format!("{kind} light, {error}"))
}

fn fault_of_amount(amount: IntensityAmount) -> Option<String> {
    match amount {
        IntensityAmount::Radiometric(amount) | IntensityAmount::LuminousPower(Lumen(amount)) => {
            fault_of_power(amount)
        }
        _ => None,
    }
}

/// What is said of a power that is infinite or no number.
pub(super) fn fault_of_power(power: f32) -> Option<String> {
    (!power.is_finite()).then(|| "expected a light of finite power".to_owned())
}
