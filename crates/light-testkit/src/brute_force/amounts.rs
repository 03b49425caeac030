use core::f64::consts::PI;
use core::fmt::Debug;

use light_math::glam::DVec3;
use light_sources::{
    Candela, DiffuseEmissionDesc, IntensityAmount, Lumen, Nit, RadianceAmount, SurfaceAmount,
    SurfaceColor, Watt,
};

use super::area::{EmittingSurface, scale};
use super::area_checks::NEARBY;
use super::model::{Model, Values};
use super::stratified::Stratified;
use crate::{Estimate, Rng};

/// Rows of cells for the power of a surface.
const SIDE: u32 = 256;

/// The relative error of sums over nanometres, of spectra that they suit.
const SPECTRUM: f64 = 5e-3;

/// What is known of a light whose amount is radiometric, in double precision.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quantities {
    /// Of its white: luminance, or intensity.
    pub(super) luminous: f64,
    pub(super) luminous_power: f64,
    pub(super) radiant_power: f64,
    /// By how much chance, and texels beside a surface, may move the powers, as a part of them.
    pub(super) chance: f64,
}

/// The same light with an amount in each unit of intensity and power: as much brighter as the
/// amount is larger than what the light has.
pub(super) fn intensities_hold(
    quantities: &Quantities,
    phi: Values,
    rng: &mut Rng,
    phi_with: impl Fn(IntensityAmount) -> Result<Values, String>,
) -> Result<(), String> {
    let amount = rng.log_range(1e-2, 1e5);
    let amounts = [
        IntensityAmount::LuminousIntensity(Candela(amount)),
        IntensityAmount::LuminousPower(Lumen(amount)),
        IntensityAmount::RadiantPower(Watt(amount)),
    ];
    factors_hold(quantities, phi, amount, amounts, phi_with)
}

/// The same of a surface.
pub(super) fn surface_amounts_hold<M: Model>(
    truth: &EmittingSurface<'_, M>,
    phi: Values,
    rng: &mut Rng,
    phi_with: impl Fn(DiffuseEmissionDesc<M>) -> Result<Values, String>,
) -> Result<(), String> {
    let emission = truth.emission;
    let (count, _) = truth.sides();
    let radiance = f64::from(scale(emission.amount));
    let mean = truth
        .mean_times_area(SIDE, rng)
        .scaled(radiance * PI * count);
    let margin = mean.margin(&Stratified::default());
    let nearby = NEARBY * radiance * PI * truth.brightest() * truth.area();
    let chance: Values = core::array::from_fn(|i| (margin[i] + nearby) / mean.values()[i]);
    let [r, g, b, mask] = mean.values();
    let quantities = match &emission.color {
        SurfaceColor::Uniform(color) => {
            let [radiant, error] = M::radiant(color);
            if error > SPECTRUM * radiant {
                return Ok(());
            }
            Quantities {
                luminous: M::luminous(color) * radiance,
                luminous_power: M::luminous(color) * mask,
                radiant_power: radiant * mask,
                chance: chance[3],
            }
        }
        SurfaceColor::Image { tint, .. } => Quantities {
            luminous: M::flux_of(tint.as_dvec3())[0] * radiance,
            luminous_power: M::flux_of(DVec3::new(r, g, b))[0],
            radiant_power: M::flux_of(DVec3::new(r, g, b))[1],
            chance: chance.into_iter().fold(0.0, f64::max),
        },
    };
    let amount = rng.log_range(1e-2, 1e5);
    let amounts = [
        RadianceAmount::Luminance(Nit(amount)).into(),
        SurfaceAmount::LuminousPower(Lumen(amount)),
        SurfaceAmount::RadiantPower(Watt(amount)),
    ];
    factors_hold(&quantities, phi, amount, amounts, |amount| {
        phi_with(DiffuseEmissionDesc {
            amount,
            ..emission.clone()
        })
    })
}

/// The amounts in the order of the quantities.
fn factors_hold<A: Copy + Debug>(
    quantities: &Quantities,
    phi: Values,
    amount: f32,
    amounts: [A; 3],
    phi_with: impl Fn(A) -> Result<Values, String>,
) -> Result<(), String> {
    let known = [
        (quantities.luminous, 0.0),
        (quantities.luminous_power, quantities.chance),
        (quantities.radiant_power, quantities.chance),
    ];
    for (kind, (quantity, chance)) in amounts.into_iter().zip(known) {
        // Of a light without power no factor is known.
        if !(quantity > 0.0 && chance < 0.1) {
            continue;
        }
        let found = phi_with(kind)?;
        let factor = f64::from(amount) / quantity;
        let error = SPECTRUM + 2.0 * Estimate::ROUNDING + chance;
        let is_right =
            |i: usize| (found[i] - phi[i] * factor).abs() <= error * phi[i] * factor + 1e-30;
        if !(0..4).all(is_right) {
            return Err(format!(
                "{kind:?} makes the power {found:?}, not {phi:?} times {factor}, of {quantities:?}"
            ));
        }
    }
    Ok(())
}
