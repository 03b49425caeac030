use core::f64::consts::PI;

use light_math::glam::DVec3;
use light_sources::{
    IrradianceAmount, Light, LightDesc, LightSetBuilder, Lux, Nit, RadianceAmount, SceneSphere,
    SunAmount,
};

use super::amounts::{SPECTRUM, factors_hold};
use super::model::{Model, Values};
use crate::Rng;

/// The same light at infinity with an amount in each photometric unit: as much brighter as the amount
/// is larger than what the light has.
pub(super) fn amounts_hold<M: Model>(
    desc: &LightDesc<M>,
    scene: SceneSphere,
    phi: Values,
    wavelengths: &M::Wavelengths,
    rng: &mut Rng,
) -> Result<(), String> {
    let amount = rng.log_range(1e-2, 1e5);
    let known = described::<M>(desc, amount)
        .into_iter()
        .map(|(desc, quantity)| (desc, quantity, 0.0));
    factors_hold(phi, amount, known, |desc| {
        let mut builder = LightSetBuilder::<M>::new(scene);
        let source = builder.add(desc).map_err(|e| e.to_string())?;
        let set = builder.build();
        let id = set.first_id(source).ok_or("no id")?;
        Ok(M::values(set.get(id).ok_or("no light")?.phi(wavelengths)))
    })
}

/// The description with `amount` in each unit, and what the light has in that unit.
fn described<M: Model>(desc: &LightDesc<M>, amount: f32) -> Vec<(LightDesc<M>, f64)> {
    let color = match desc {
        LightDesc::Distant(light) => Some(&light.emission),
        LightDesc::Sun(light) => Some(&light.emission),
        LightDesc::UniformInfinite(light) => Some(&light.emission),
        _ => None,
    };
    let luminous = match color.map(|color| (color, M::radiant(color))) {
        None => M::flux_of(DVec3::ONE)[0],
        // Sums over nanometres do not suit a line.
        Some((_, [radiant, error])) if error > SPECTRUM * radiant => return vec![],
        Some((color, _)) => M::luminous(color),
    };
    let has = luminous * radiometric(desc);
    let nit = RadianceAmount::Luminance(Nit(amount));
    let sky = RadianceAmount::of_sky(Lux(amount));
    let lux = IrradianceAmount::Illuminance(Lux(amount));
    let with_radiance = |amount: RadianceAmount| {
        let mut desc = desc.clone();
        match &mut desc {
            LightDesc::Sun(light) => light.amount = SunAmount::Radiance(amount),
            LightDesc::UniformInfinite(light) => light.amount = amount,
            LightDesc::ImageInfinite(light) => light.amount = amount,
            LightDesc::PortalInfinite(light) => light.amount = amount,
            other => unreachable!("{other:?} has no radiance"),
        }
        desc
    };
    match desc.clone() {
        LightDesc::Distant(mut light) => {
            light.amount = lux;
            vec![(light.into(), has)]
        }
        LightDesc::Sun(mut light) => {
            let half = 0.5 * f64::from(light.angular_diameter);
            let projected = PI * half.sin().powi(2);
            let [radiance, irradiance] = match light.amount {
                SunAmount::Radiance(_) => [has, has * projected],
                _ => [has / projected, has],
            };
            light.amount = SunAmount::Irradiance(lux);
            vec![
                (light.into(), irradiance),
                (with_radiance(nit), radiance),
                (with_radiance(sky), PI * radiance),
            ]
        }
        _ => vec![(with_radiance(nit), has), (with_radiance(sky), PI * has)],
    }
}

/// The factor of the emission.
fn radiometric<M: Model>(desc: &LightDesc<M>) -> f64 {
    let radiance = match desc {
        LightDesc::Distant(light) => match light.amount {
            IrradianceAmount::Radiometric(scale) => return scale.into(),
            other => unreachable!("{other:?} is not drawn"),
        },
        LightDesc::Sun(light) => match light.amount {
            SunAmount::Irradiance(IrradianceAmount::Radiometric(scale)) => return scale.into(),
            SunAmount::Radiance(amount) => amount,
            other => unreachable!("{other:?} is not drawn"),
        },
        LightDesc::UniformInfinite(light) => light.amount,
        LightDesc::ImageInfinite(light) => light.amount,
        LightDesc::PortalInfinite(light) => light.amount,
        other => unreachable!("{other:?} is not at infinity"),
    };
    match radiance {
        RadianceAmount::Radiometric(scale) => scale.into(),
        other => unreachable!("{other:?} is not drawn"),
    }
}
