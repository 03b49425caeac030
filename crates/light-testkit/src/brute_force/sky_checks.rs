use light_bounds::{InfiniteBounds, LightExtent};
use light_math::glam::DVec3;
use light_sources::{Light, LightRef, PdfCoverage};

use super::arrival::Arriving;
use super::model::Model;
use super::receiver::Receiver;
use super::sky_truth::{Sky, SkyTruth};
use super::stratified::{Stratified, place_in_square};
use crate::{Estimate, Rng};

/// Fraction of directions that rounding may put on a neighbouring texel, or beyond an edge.
const STRAY: f64 = 4e-3;

/// Rows of cells of the first comparison, and of the one that confirms a difference.
const SIDES: [u32; 2] = [64, 512];

/// The density integrates to 1 where all directions have one, and rays that leave the scene find
/// what is there.
pub(super) fn density_holds<M: Model>(
    light: &LightRef<'_, M>,
    wavelengths: &M::Wavelengths,
    truth: &SkyTruth,
    receiver: &Receiver,
    rng: &mut Rng,
) -> Result<(), String> {
    if matches!(truth.sky, Sky::Distant(..)) {
        return Ok(());
    }
    for coverage in [PdfCoverage::Complete, PdfCoverage::Incomplete] {
        for side in SIDES {
            match density_at(light, wavelengths, truth, receiver, coverage, side, rng) {
                Ok(()) => break,
                Err(fault) if side == SIDES[1] => return Err(fault),
                Err(_) => {}
            }
        }
    }
    Ok(())
}

/// The comparison with two points in each of `side` by `side` cells.
fn density_at<M: Model>(
    light: &LightRef<'_, M>,
    wavelengths: &M::Wavelengths,
    truth: &SkyTruth,
    receiver: &Receiver,
    coverage: PdfCoverage,
    side: u32,
    rng: &mut Rng,
) -> Result<(), String> {
    let integral = Stratified::<4>::over_square(truth.side(side), rng, |at, _| {
        let Some(part) = truth.part(at, Some(receiver.p)) else {
            return [0.0; 4];
        };
        let w = part.w.as_vec3().normalize();
        let pdf = f64::from(light.pdf_li(&receiver.ctx, w, coverage));
        let found = M::values(light.le(receiver.ctx.p, w, wavelengths))[3];
        let covered = if pdf > 0.0 { part.l[3] } else { 0.0 };
        [pdf, found, part.l[3], covered].map(|value| value * part.solid_angle)
    });
    let sampled = Stratified::<4>::over_square(side, rng, |u, _| {
        let u = place_in_square(u);
        let sample = light.sample_li(&receiver.ctx, u, wavelengths, coverage);
        sample.map_or([0.0; 4], |sample| {
            let l = M::values(sample.l)[3] / f64::from(sample.pdf);
            [1.0, 0.0, 0.0, l]
        })
    });
    let margin = integral.margin(&sampled);
    let [mass, found, expected, covered] = integral.values();
    let [arrives, _, _, estimate] = sampled.values();
    let edges = STRAY + truth.share_of_edges(receiver, rng);
    let is_mass = (mass - arrives).abs() <= edges + margin[0];
    let is_found = (found - expected).abs() <= edges * expected + margin[1].max(margin[2]);
    let is_estimate = (estimate - covered).abs() <= edges * covered + margin[3];
    if is_mass && is_found && is_estimate {
        return Ok(());
    }
    Err(format!(
        "{coverage:?}: the density integrates to {mass}, {arrives} of the samples arrive; rays \
         find {found} of {expected}; samples say {estimate} of {covered}; chance {margin:?}, edges \
         {edges}; at {receiver:?}"
    ))
}

/// The fluence by the brightest channel, the mean direction and the cone.
pub(super) fn bounds_hold<M: Model>(
    light: &LightRef<'_, M>,
    wavelengths: &M::Wavelengths,
    truth: &SkyTruth,
    rng: &mut Rng,
) -> Result<(), String> {
    let LightExtent::Infinite(bounds) = light.extent() else {
        return Err("a light at infinity has bounds".into());
    };
    // In a corner of the angles of a portal few points hide a large solid angle.
    moments_hold::<M>(&bounds, truth, 128, rng)
        .or_else(|_| moments_hold::<M>(&bounds, truth, 1024, rng))?;
    for _ in 0..256 {
        if let Some(sample) = light.sample_le(rng.vec2(), rng.vec2(), wavelengths) {
            let w = -sample.ray.direction;
            let cos = w.dot(bounds.cone.w);
            if !bounds.cone.is_whole_sphere() && cos < bounds.cone.cos_theta - 1e-6 {
                return Err(format!("{w} is outside of {:?}", bounds.cone));
            }
        }
    }
    Ok(())
}

/// The fluence and the mean direction, by `side` rows of cells.
fn moments_hold<M: Model>(
    bounds: &InfiniteBounds,
    truth: &SkyTruth,
    side: u32,
    rng: &mut Rng,
) -> Result<(), String> {
    let integral = Stratified::<7>::over_square(truth.side(side), rng, |at, _| {
        truth.part(at, None).map_or([0.0; 7], |part| {
            let [r, g, b, l] = part.l.map(|value| value * part.solid_angle);
            let [x, y, z] = (part.w * l).to_array();
            [x, y, z, l, r, g, b]
        })
    });
    let [x, y, z, fluence, ..] = integral.values();
    let margin = integral.margin(&Stratified::default());
    let mean = DVec3::new(x, y, z) / fluence;
    let off = (bounds.mean.as_dvec3() - mean).abs().max_element();
    let largest = |margin: &[f64]| margin.iter().copied().fold(0.0, f64::max);
    let chance = largest(&margin[..4]) / fluence;
    // The channels of a sky have one shape where it is not coloured.
    if fluence > 0.0 && off > 2.0 * chance + Estimate::ROUNDING {
        return Err(format!(
            "the mean direction is {mean}, bounds say {:?}",
            bounds.mean
        ));
    }
    let is_bright = fluence > 0.0;
    if is_bright != (bounds.fluence > 0.0) && is_bright {
        return Err(format!("fluence {fluence}, bounds say {}", bounds.fluence));
    }
    if M::is_linear() {
        let [.., r, g, b] = integral.values();
        let most = r.max(g).max(b);
        let is_picture = matches!(truth.sky, Sky::Image(..) | Sky::Portal(..));
        let off = (f64::from(bounds.fluence) - most).abs();
        if is_picture && off > largest(&margin[4..]) + Estimate::ROUNDING * most {
            return Err(format!("fluence {most}, bounds say {}", bounds.fluence));
        }
    }
    Ok(())
}
