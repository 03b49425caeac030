//! How bright the lights of an input are.

use light_math::spectrum::photometric::{Candela, Lumen, Lux, Nit, Watt};
use light_sources::{IntensityAmount, IrradianceAmount, RadianceAmount, SurfaceAmount};

use super::input::Input;

/// The largest brightness of a described light.
pub(super) const BRIGHTEST: f32 = 1e9;

pub(super) fn bright(input: &mut Input<'_>) -> f32 {
    input.amount(BRIGHTEST)
}

pub(super) fn intensity(input: &mut Input<'_>) -> IntensityAmount {
    let (kind, amount) = (input.byte() % 6, bright(input));
    match kind {
        0 => IntensityAmount::LuminousIntensity(Candela(amount)),
        1 => IntensityAmount::LuminousPower(Lumen(amount)),
        2 => IntensityAmount::RadiantPower(Watt(amount)),
        _ => IntensityAmount::Radiometric(amount),
    }
}

pub(super) fn irradiance(input: &mut Input<'_>) -> IrradianceAmount {
    let (kind, amount) = (input.byte() % 4, bright(input));
    match kind {
        0 => IrradianceAmount::Illuminance(Lux(amount)),
        _ => IrradianceAmount::Radiometric(amount),
    }
}

pub(super) fn radiance(input: &mut Input<'_>) -> RadianceAmount {
    let (kind, amount) = (input.byte() % 4, bright(input));
    match kind {
        0 => RadianceAmount::Luminance(Nit(amount)),
        _ => RadianceAmount::Radiometric(amount),
    }
}

pub(super) fn surface_amount(input: &mut Input<'_>) -> SurfaceAmount {
    match input.byte() % 4 {
        0 => SurfaceAmount::LuminousPower(Lumen(bright(input))),
        1 => SurfaceAmount::RadiantPower(Watt(bright(input))),
        _ => radiance(input).into(),
    }
}
