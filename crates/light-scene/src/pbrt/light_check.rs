use lights::math::spectrum::photometric::Lumen;
use lights::sources::{
    Channels, EnvironmentMap, Image, ImageInfiniteLightDesc, IntensityAmount, LightDesc,
    LightSetBuilder, PortalInfiniteLightDesc, Rgb, SceneSphere,
};

use crate::glam::Vec3;

/// Why no light of finite power can be made of what a file says; the renderer, which finds the same
/// later, knows no line.
pub(super) fn fault(light: &LightDesc<Rgb>) -> Option<String> {
    let tried = match light {
        LightDesc::Point(_)
        | LightDesc::Spot(_)
        | LightDesc::Distant(_)
        | LightDesc::UniformInfinite(_) => light.clone(),
        LightDesc::ImageInfinite(light) => LightDesc::ImageInfinite(ImageInfiniteLightDesc {
            map: black()?,
            ..*light
        }),
        LightDesc::PortalInfinite(light) => LightDesc::PortalInfinite(PortalInfiniteLightDesc {
            map: black()?,
            ..*light
        }),
        LightDesc::Projection(light) => return fault_of_amount(light.amount),
        LightDesc::Goniometric(light) => return fault_of_amount(light.amount),
        _ => return None,
    };
    let mut builder = LightSetBuilder::new(SceneSphere::new(Vec3::ZERO, 1.0).ok()?);
    if let Err(error) = builder.add(tried) {
        return Some(error.to_string());
    }
    let powers = builder.build().powers();
    powers.iter().find_map(|&power| fault_of_power(power))
}

/// A sky without an image, which may be large.
fn black() -> Option<EnvironmentMap> {
    let image = Image::from_f32([1, 1], Channels::Rgb, vec![0.0; 3]);
    image.ok().map(EnvironmentMap::EqualArea)
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
