use light_bounds::LightExtent;
use light_math::glam::DVec3;
use light_sources::{Light, LightLiSample, LightRef, PdfCoverage};

use super::model::{Model, Values};
use super::receiver::Receiver;
use super::stratified::{Stratified, place_in_square};
use crate::{Estimate, Rng};

/// What arrives from a light, in double precision.
pub(super) trait Arriving {
    /// The integral of radiance times the receiver's weight, in cells of which a larger `detail`
    /// makes more; with a twin that moved, the same random points are used.
    fn arriving(&self, receiver: &Receiver, detail: u32, rng: &mut Rng) -> Stratified<4>;

    /// The part of the light so close to its outline that rounding decides whether a direction meets
    /// it.
    fn share_of_edges(&self, receiver: &Receiver, rng: &mut Rng) -> f64;

    /// What would arrive if all of the light were as bright as its brightest point.
    fn most(&self, receiver: &Receiver, rng: &mut Rng) -> f64;

    /// The largest coordinate that the light has to subtract, in scene units.
    fn coordinates(&self) -> f64;
}

/// Rounding of coordinates and directions on the way to a sample, as a part of them.
pub(super) const BACKWARD_ERROR: f64 = 4.0 * f32::EPSILON as f64;

/// Fraction of samples that may lie so close to an edge that their density is that of the other
/// side.
const STRAY: f64 = 2e-3;

/// How far the density of a sample or a ray and that of its query may differ, relatively.
pub(super) const DENSITY_ROUNDING: f32 = 2e-3;

/// So many of them are expected of an event of which chance, at the level of a single test, shows
/// none.
pub(super) const UNSEEN: f64 = 21.0;

/// Rows of cells of the first comparison, and of those that confirm a difference: points that are
/// chosen by area hardly ever lie near a receiver that is close to a surface.
const SIDES: [u32; 3] = [64, 256, 1024];

/// The mean of samples toward the light is what arrives, to chance and to what moves as rounding
/// moves the receiver: the result is exact for a receiver nearby.
pub(super) fn arrival_holds<M: Model>(
    light: &LightRef<'_, M>,
    wavelengths: &M::Wavelengths,
    truth: &impl Arriving,
    receiver: &Receiver,
    rng: &mut Rng,
) -> Result<(), String> {
    let mut fault = String::new();
    let mut sensitivity = None;
    for (detail, side) in [4, 16, 64].into_iter().zip(SIDES) {
        let mut outcome = Outcome::default();
        let side = if is_dirac(light) { 2 } else { side };
        let sampled = Stratified::over_square(side, rng, |u, _| {
            let sample = sample(light, wavelengths, receiver, u);
            outcome.add(light, receiver, sample.as_ref());
            sample.map_or([0.0; 4], |sample| {
                let weight = receiver.weight(sample.wi.as_dvec3()) / f64::from(sample.pdf);
                M::values(sample.l).map(|l| l * weight)
            })
        });
        if let Some(fault) = outcome.fault {
            return Err(format!("{fault} at {receiver:?}"));
        }
        let expected = truth.arriving(receiver, detail, rng);
        let mut margin = sampled.margin(&expected);
        if side == SIDES[2] {
            let unseen = truth.most(receiver, rng) * UNSEEN / f64::from(2 * side * side);
            margin.iter_mut().for_each(|margin| *margin += unseen);
        }
        let off = excess(&sampled.values(), &expected.values(), &margin);
        let is_right = off == [0.0; 4];
        if is_right && outcome.are_strays_few(0.0) {
            return importance_holds(light, receiver, &expected, &margin, rng);
        }
        // Only now, as it costs more than all above.
        let (changes, share) = *sensitivity.get_or_insert_with(|| {
            (
                sensitivity_of(truth, receiver, rng),
                truth.share_of_edges(receiver, rng),
            )
        });
        let is_explained = (0..4).all(|i| off[i] <= changes[i]);
        if is_explained && outcome.are_strays_few(share) {
            return importance_holds(light, receiver, &expected, &margin, rng);
        }
        let [sampled, expected] = [sampled, expected].map(|s| s.values());
        fault = format!(
            "{expected:?} arrives, samples say {sampled:?}, beyond chance by {off:?}, of which \
             rounding explains {changes:?}; {} strays of {}, {share} by rounding, the last {}; \
             at {receiver:?}",
            outcome.strays, outcome.samples, outcome.stray,
        );
    }
    Err(fault)
}

/// How far values are off beyond a margin and the rounding of single precision; infinite for NaN.
/// The first four are channels: between two points of a spectrum the value is rounded as a part of
/// the larger one.
pub(super) fn excess<const N: usize>(
    found: &[f64; N],
    expected: &[f64; N],
    margin: &[f64; N],
) -> [f64; N] {
    const SPECTRUM: f64 = 4.0 * f32::EPSILON as f64;
    let brightest = expected[..4].iter().copied().fold(0.0, f64::max);
    core::array::from_fn(|i| {
        let off = (found[i] - expected[i]).abs() - margin[i];
        let off = off - Estimate::ROUNDING * expected[i].abs() - SPECTRUM * brightest;
        if off.is_nan() {
            f64::INFINITY
        } else {
            off.max(0.0)
        }
    })
}

/// How much more or less arrives where rounding may have moved the receiver: in the worst
/// direction, which the changes along the axes say, and with its normal turned.
fn sensitivity_of(truth: &impl Arriving, receiver: &Receiver, rng: &mut Rng) -> Values {
    const DETAIL: u32 = 4;
    let reach = receiver.p.length().max(truth.coordinates()) * BACKWARD_ERROR;
    let seed = rng.clone();
    let at = |receiver: &Receiver| truth.arriving(receiver, DETAIL, &mut seed.clone()).values();
    let here = at(receiver);
    let change = |moved: &Receiver| {
        let there = at(moved);
        core::array::from_fn(|i| (there[i] - here[i]).abs())
    };
    let mut squares = [0.0; 4];
    for axis in DVec3::AXES {
        let sides = [reach, -reach].map(|reach| change(&receiver.moved(axis * reach)));
        squares = core::array::from_fn(|i| squares[i] + f64::max(sides[0][i], sides[1][i]).powi(2));
    }
    let turns = [(); 6].map(|()| change(&receiver.turned(rng, BACKWARD_ERROR)));
    core::array::from_fn(|i| {
        let turned = turns.iter().map(|turn: &Values| turn[i]);
        squares[i].sqrt() + turned.fold(0.0, f64::max)
    })
}

fn sample<M: Model>(
    light: &LightRef<'_, M>,
    wavelengths: &M::Wavelengths,
    receiver: &Receiver,
    u: [f64; 2],
) -> Option<LightLiSample<M::Radiance>> {
    let u = place_in_square(u);
    light.sample_li(&receiver.ctx, u, wavelengths, PdfCoverage::Complete)
}

/// Where light arrives, the importance is above 0.
fn importance_holds<M: Model>(
    light: &LightRef<'_, M>,
    receiver: &Receiver,
    expected: &Stratified<4>,
    margin: &Values,
    rng: &mut Rng,
) -> Result<(), String> {
    let arrives = (0..4).any(|i| expected.values()[i] > 2.0 * margin[i]);
    let mut own = Rng::new(rng.clone().u64());
    let segments = receiver.segments(&mut own).into_iter().flatten();
    for ctx in segments.chain([receiver.ctx]) {
        let importance = match light.extent() {
            LightExtent::Bounded(bounds) | LightExtent::Lobe(bounds, _) => bounds.importance(&ctx),
            LightExtent::Infinite(bounds) => bounds.fluence,
        };
        if arrives && !(importance > 0.0) {
            return Err(format!(
                "light arrives, the importance is {importance} for {ctx:?}"
            ));
        }
    }
    Ok(())
}

/// What single samples say.
#[derive(Debug, Default)]
struct Outcome {
    samples: u32,
    strays: u32,
    /// What is wrong with one.
    fault: Option<String>,
    stray: String,
}

impl Outcome {
    fn add<M: Model>(
        &mut self,
        light: &LightRef<'_, M>,
        receiver: &Receiver,
        sample: Option<&LightLiSample<M::Radiance>>,
    ) {
        let Some(sample) = sample else {
            return;
        };
        self.samples += 1;
        let is_unit = (sample.wi.length() - 1.0).abs() < 1e-5;
        if !(is_unit && sample.pdf > 0.0 && sample.pdf.is_finite()) {
            self.fault = Some(format!("{sample:?}"));
        }
        let pdf = light.pdf_li(&receiver.ctx, sample.wi, PdfCoverage::Complete);
        let rounding = DENSITY_ROUNDING + blur(receiver, sample);
        let is_same = (pdf - sample.pdf).abs() <= rounding * pdf.max(sample.pdf);
        if is_dirac(light) {
            if pdf != 0.0 {
                self.fault = Some(format!("a density {pdf} of a Dirac"));
            }
        } else if !is_same {
            self.strays += 1;
            self.stray = format!("queried {pdf}, {sample:?}");
        }
        if let Some(fault) = place_fault(light, receiver, sample) {
            self.fault = Some(fault);
        }
    }

    fn are_strays_few(&self, share: f64) -> bool {
        f64::from(self.strays) <= (STRAY + share) * f64::from(self.samples) + 2.0
    }
}

/// Whether the end of the shadow ray lies in the bounds of the light, and in the direction of the
/// sample.
fn place_fault<M: Model>(
    light: &LightRef<'_, M>,
    receiver: &Receiver,
    sample: &LightLiSample<M::Radiance>,
) -> Option<String> {
    let bounds = light.bounds()?.bounds;
    let to_light = sample.p_light.as_dvec3() - receiver.p;
    let size = f64::from(sample.p_light.abs().max_element())
        .max(receiver.p.abs().max_element())
        .max(f64::from(bounds.diagonal().length()));
    let error = 4.0 * BACKWARD_ERROR * size;
    let wi: DVec3 = sample.wi.as_dvec3();
    let aside = to_light.cross(wi).length();
    if aside > error + 1e-6 * to_light.length() {
        return Some(format!("the shadow ray of {sample:?} misses by {aside}"));
    }
    let inside = sample.p_light.clamp(bounds.min, bounds.max);
    let beyond = f64::from((sample.p_light - inside).abs().max_element());
    if beyond > error {
        return Some(format!("{sample:?} is {beyond} outside of {bounds:?}"));
    }
    None
}

/// By how much rounding of the coordinates may change the density of a sample, as a part of it:
/// through the distance, and through the cosine at the light.
fn blur<R>(receiver: &Receiver, sample: &LightLiSample<R>) -> f32 {
    let to_light = sample.p_light - receiver.ctx.p;
    let coordinates = sample.p_light.length().max(receiver.ctx.p.length());
    let height = to_light.dot(sample.n_light).abs();
    let error = BACKWARD_ERROR as f32 * coordinates;
    2.0 * error / to_light.length() + error / height
}

/// Whether every sample has the density 1: an invisible surface is a Dirac by its type, as no ray
/// finds it, but its samples are spread.
fn is_dirac<M: Model>(light: &LightRef<'_, M>) -> bool {
    let is_surface = matches!(light, LightRef::Area(_) | LightRef::Triangle(_));
    light.light_type().is_delta() && !is_surface
}
