use light_math::glam::DVec3;
use light_sources::{EmissionMask, Light, LightRef, PdfCoverage, SurfaceColor};

use super::area::{EmittingSurface, scale};
use super::arrival::{Arriving, UNSEEN, arrival_holds, excess};
use super::model::Model;
use super::rays::leaving_holds;
use super::receiver::Receiver;
use super::stratified::{Stratified, place_in_square};
use super::surface::Surface;
use crate::Rng;

/// Receivers of each light.
const RECEIVERS: u32 = 3;

/// Rows of cells for what leaves a light, and of those that confirm a difference.
const SIDES: [u32; 2] = [64, 768];

/// The weight that texels beside a surface may have in its power, all of them together.
pub(super) const NEARBY: f64 = 1e-9;

/// All that is compared for a light on a surface.
pub(super) fn check_surface<M: Model>(
    light: &LightRef<'_, M>,
    power: f32,
    truth: &EmittingSurface<'_, M>,
    unit: f32,
    rng: &mut Rng,
) -> Result<(), String> {
    power_holds(light, power, truth, rng)?;
    let center = truth.surface.at([0.4, 0.6]).p;
    leaving_holds(
        light,
        truth.wavelengths,
        truth.coordinates,
        center,
        rng,
        |side, rng| truth.leaving(side, center, rng),
    )?;
    for _ in 0..RECEIVERS {
        let on = truth.surface.at([rng.f64(), rng.f64()]).p.as_vec3();
        let p = on + rng.direction() * (unit * rng.log_range(0.01, 100.0));
        if truth.distance(p.as_dvec3()) < f64::from(unit) * nearest(&truth.surface) {
            continue;
        }
        let receiver = Receiver::random(rng, p, on);
        arrival_holds(light, truth.wavelengths, truth, &receiver, rng)?;
        density_holds(light, truth, &receiver, rng)?;
    }
    Ok(())
}

/// The least distance of receivers, in units: where points are chosen by area, the mean of a
/// million samples is no number to compare nearer than this.
const fn nearest(surface: &Surface) -> f64 {
    match surface {
        Surface::Triangle(..) => 1e-3,
        _ => 1e-2,
    }
}

/// The power per channel and as one number, and the strength that samplers read.
fn power_holds<M: Model>(
    light: &LightRef<'_, M>,
    power: f32,
    truth: &EmittingSurface<'_, M>,
    rng: &mut Rng,
) -> Result<(), String> {
    let emission = truth.emission;
    let (count, _) = truth.sides();
    let radiance_scale = f64::from(scale(emission.amount)) * core::f64::consts::PI;
    let phi = M::values(light.phi(truth.wavelengths));
    let strength = f64::from(light.bounds().ok_or("no bounds")?.phi);
    let mut fault = String::new();
    for side in SIDES {
        let mean = truth.mean_times_area(side, rng).scaled(radiance_scale);
        let exact = Stratified::default();
        let [r, g, b, mask] = mean.values();
        let error = mean.margin(&exact);
        let relative = |value: f64, error: f64| if value > 0.0 { error / value } else { 0.0 };
        let (values, radiant, most, off) = match &emission.color {
            SurfaceColor::Uniform(color) => {
                let [radiant, radiant_error] = M::radiant(color);
                (
                    M::values_of(color, truth.wavelengths).map(|value| value * mask),
                    [radiant * mask, radiant_error * mask],
                    f64::from(M::maximum(color)) * mask,
                    relative(mask, error[3]),
                )
            }
            SurfaceColor::Image { .. } => {
                let color = DVec3::new(r, g, b);
                let largest = color.max_element();
                // The model's own function takes numbers that a float holds.
                let unit = (color / largest.max(f64::MIN_POSITIVE)).as_vec3();
                let channels = [0, 1, 2].map(|i| relative([r, g, b][i], error[i]));
                (
                    M::values(M::emit_texel(unit, truth.wavelengths)).map(|value| value * largest),
                    [f64::from(M::flux_of_texel(unit).radiant) * largest, 0.0],
                    largest,
                    channels.into_iter().fold(0.0, f64::max),
                )
            }
        };
        let expected = [
            values[0] * count,
            values[1] * count,
            values[2] * count,
            values[3] * count,
            radiant[0] * count,
            most,
        ];
        let found = [phi[0], phi[1], phi[2], phi[3], f64::from(power), strength];
        let mut margin = expected.map(|value| value * off);
        margin[4] += radiant[1] * count * 1.001;
        // Texels beside the surface may count, as rounding may show them.
        let mut share = NEARBY;
        if side == SIDES[1] && mask == 0.0 {
            share = UNSEEN / f64::from(2 * side * side);
        }
        let nearby = share * radiance_scale * truth.brightest() * truth.area();
        margin.iter_mut().for_each(|margin| *margin += nearby);
        let beyond = excess(&found, &expected, &margin);
        if beyond == [0.0; 6] {
            let emits = mask > 0.0 && most > 0.0;
            return match (emits, power > 0.0 && strength > 0.0) {
                (true, false) => Err(format!("power {power}, strength {strength} of a light")),
                _ => Ok(()),
            };
        }
        fault = format!(
            "power per channel, radiant and of bounds {found:?}, not {expected:?}, beyond chance \
             by {beyond:?}"
        );
    }
    Err(fault)
}

/// The density integrates to 1 at most, and to no less than the part of samples that arrive; rays
/// meet the surface where it is seen, with its radiance.
fn density_holds<M: Model>(
    light: &LightRef<'_, M>,
    truth: &EmittingSurface<'_, M>,
    receiver: &Receiver,
    rng: &mut Rng,
) -> Result<(), String> {
    let side = 32;
    let arrives = Stratified::over_square(side, rng, |u, _| {
        let u = place_in_square(u);
        let coverage = PdfCoverage::Complete;
        let sample = light.sample_li(&receiver.ctx, u, truth.wavelengths, coverage);
        [f64::from(u8::from(sample.is_some()))]
    });
    let is_visible = !matches!(truth.emission.mask, EmissionMask::Invisible);
    let mut fault = String::new();
    for detail in [4, 16, 256] {
        let mut integral = Stratified::<4>::default();
        // At a silhouette rounding decides which side is seen.
        let mut on_any_side = 0.0;
        truth.cells(receiver.p, detail, |low, width| {
            integral.add_cell([(); 2].map(|()| {
                let at = low.map(|low| low + width * rng.f64());
                let seen = truth.seen(receiver.p, at, width);
                seen.map_or([0.0; 4], |(place, wi, solid_angle)| {
                    let direction = wi.as_vec3().normalize();
                    let coverage = PdfCoverage::Complete;
                    let pdf = light.pdf_li(&receiver.ctx, direction, coverage);
                    let hit = light.hit(receiver.ctx.p, direction);
                    let l = hit.map_or(0.0, |at| {
                        M::values(light.l(&at, -direction, truth.wavelengths))[3]
                    });
                    let expected = truth.radiance(&place, -wi)[3];
                    on_any_side += truth.brightness(place.uv)[3] * solid_angle * 0.5;
                    [f64::from(pdf), 1.0, l, expected].map(|value| value * solid_angle)
                })
            }));
        });
        let [mass, solid_angle, found, expected] = integral.values();
        let error = integral.margin(&Stratified::default());
        let slack = 4e-3 + error[0];
        let least = arrives.values()[0] - arrives.margin(&Stratified::default())[0];
        let blur = truth.share_of_edges(receiver, rng);
        let is_mass = mass <= 1.0 + slack + blur && mass >= least - slack - blur;
        // Both sums have the same points: only edges differ.
        let is_met = !is_visible
            || (found - expected).abs()
                <= (4e-3 + blur) * on_any_side + error[2].max(error[3]) * 0.5;
        if is_mass && is_met {
            return Ok(());
        }
        fault = format!(
            "density integrates to {mass}, {least} of the samples arrive; rays find {found} of \
             {expected}; chance {error:?}, rounding {blur}, solid angle {solid_angle}, \
             at {receiver:?}"
        );
    }
    Err(fault)
}
