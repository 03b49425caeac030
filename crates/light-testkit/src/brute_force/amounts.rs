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
pub(super) const SPECTRUM: f64 = 5e-3;

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
    factors_hold(phi, amount, quantities.of(amounts), phi_with)
}

/// The same of surfaces that share an emission, of one of which `phi` is the power.
pub(super) fn surface_amounts_hold<M: Model>(
    truths: &[EmittingSurface<'_, M>],
    phi: Values,
    rng: &mut Rng,
    phi_with: impl Fn(DiffuseEmissionDesc<M>) -> Result<Values, String>,
) -> Result<(), String> {
    let [truth, ..] = truths else {
        return Err("no surface".into());
    };
    let emission = truth.emission;
    let (count, _) = truth.sides();
    let radiance = f64::from(scale(emission.amount));
    let mut mean = Stratified::default();
    let mut area = 0.0;
    for truth in truths {
        mean.add(&truth.mean_times_area(SIDE, rng));
        area += truth.area();
    }
    let mean = mean.scaled(radiance * PI * count);
    let margin = mean.margin(&Stratified::default());
    let nearby = NEARBY * radiance * PI * truth.brightest() * area;
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
    factors_hold(phi, amount, quantities.of(amounts), |amount| {
        phi_with(DiffuseEmissionDesc {
            amount,
            ..emission.clone()
        })
    })
}

impl Quantities {
    /// The amounts in the order of the quantities, with what the light has of each and by how much
    /// chance may move that.
    fn of<A>(&self, amounts: [A; 3]) -> impl Iterator<Item = (A, f64, f64)> + use<A> {
        let known = [
            (self.luminous, 0.0),
            (self.luminous_power, self.chance),
            (self.radiant_power, self.chance),
        ];
        let each = amounts.into_iter().zip(known);
        each.map(|(amount, (quantity, chance))| (amount, quantity, chance))
    }
}

/// Descriptions whose amount is `amount` in some unit, each with what the light of power `phi` has in
/// that unit and by how much chance may move that, have their power in proportion.
pub(super) fn factors_hold<A: Clone + Debug>(
    phi: Values,
    amount: f32,
    known: impl IntoIterator<Item = (A, f64, f64)>,
    phi_with: impl Fn(A) -> Result<Values, String>,
) -> Result<(), String> {
    for (kind, quantity, chance) in known {
        // Of a light without power no factor is known.
        if !(quantity > 0.0 && chance < 0.1) {
            continue;
        }
        let found = phi_with(kind.clone())?;
        let factor = f64::from(amount) / quantity;
        let error = SPECTRUM + 2.0 * Estimate::ROUNDING + chance;
        let is_right =
            |i: usize| (found[i] - phi[i] * factor).abs() <= error * phi[i] * factor + 1e-30;
        if !(0..4).all(is_right) {
            return Err(format!(
                "{kind:?} makes the power {found:?}, not {phi:?} times {factor}"
            ));
        }
    }
    Ok(())
}
