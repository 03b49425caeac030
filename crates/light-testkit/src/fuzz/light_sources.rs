use light_bounds::{LightExtent, LightSampleContext, ReceiverKind};
use light_math::glam::{Vec2, Vec3};
use light_samplers::{BvhLightSampler, LightSampler, ReferenceBvhLightSampler};
use light_sources::shape::Shape;
use light_sources::{Light, LightRef, LightSet, LightSetBuilder, PdfCoverage, Rgb};

use super::input::Input;
use super::lights;
use crate::light_agreement::{Demand, is_light, le_agrees, li_agrees};

/// Lights that one input describes.
const MAX_LIGHTS: usize = 4;

/// How far away receivers are.
const FAR: f32 = 1e6;

/// Any description gives a light that obeys the laws, or is refused.
///
/// Powers are finite, extents valid, sampled radiances finite and not negative, sampled densities
/// those that are queried; and what arrives at a receiver has a pmf above zero. For lights
/// and receivers of extreme sizes and positions densities are not compared.
///
/// # Panics
/// If a guarantee is violated.
pub fn light_sources(data: &[u8]) {
    let mut input = Input::new(data);
    let contexts = [Demand::Density, Demand::Range].map(|demand| {
        input.is_tame = demand == Demand::Density;
        (input.receiver(), demand)
    });
    let us = [point(&mut input), point(&mut input), point(&mut input)];
    let set = described(&mut input);
    let demand = if input.is_tame {
        Demand::Density
    } else {
        Demand::Range
    };
    for (_, light) in set.iter() {
        check_power(&light);
        let pairs = us.iter().flat_map(|&u1| us.map(|u2| (u1, u2)));
        for (u1, u2) in pairs {
            let agrees = le_agrees(&light, u1, u2, demand);
            agrees.unwrap_or_else(|fault| panic!("{fault}: {light:?}"));
        }
        for (ctx, demanded) in contexts.iter().filter(|(ctx, _)| is_somewhere(ctx)) {
            let demand = demand.min(*demanded);
            for u in us {
                for coverage in [PdfCoverage::Complete, PdfCoverage::Incomplete] {
                    let agrees = li_agrees(&light, ctx, u, coverage, demand);
                    agrees.unwrap_or_else(|fault| panic!("{fault}: {light:?}"));
                }
            }
        }
    }
    check_samplers(&set, &contexts.map(|(ctx, _)| ctx), &us);
}

/// The lights of an input, all of them tame or none.
fn described(input: &mut Input<'_>) -> LightSet<Rgb> {
    input.is_tame = input.byte() % 2 == 0;
    let scene = lights::scene(input);
    let mut builder = LightSetBuilder::<Rgb>::new(scene);
    for _ in 0..MAX_LIGHTS {
        if input.is_empty() {
            break;
        }
        if let Err(error) = builder.add(lights::light(input)) {
            assert_eq!(error.to_string().lines().count(), 1, "one line: {error}");
        }
    }
    builder.build()
}

/// A point of the unit square, often at an edge.
fn point(input: &mut Input<'_>) -> Vec2 {
    let mut u = || match input.byte() % 8 {
        0 => 0.0,
        1 => light_math::float::ONE_MINUS_EPSILON,
        2 => 0.5,
        _ => input.unit(),
    };
    Vec2::new(u(), u())
}

/// Near enough: the laws hold for these receivers only.
fn is_somewhere(ctx: &LightSampleContext) -> bool {
    let is_near = |v: Vec3| v.abs().max_element() <= FAR;
    let is_short = match *ctx.kind() {
        ReceiverKind::Segment { extent, .. } => is_near(extent),
        _ => true,
    };
    is_near(ctx.p) && is_short && ctx.p_error.max_element() <= 1.0
}

fn check_power(light: &LightRef<'_, Rgb>) {
    let phi = light.phi(&());
    assert!(is_light(phi), "phi is {phi} of {light:?}");
    let is_valid = match light.extent() {
        LightExtent::Bounded(bounds) => bounds.validate().is_ok(),
        LightExtent::Lobe(bounds, lobe) => bounds.validate().is_ok() && lobe.is_valid(),
        LightExtent::Infinite(bounds) => bounds.validate().is_ok(),
    };
    assert!(is_valid, "{:?} of {light:?}", light.extent());
}

/// Whether the power of a surface may be a positive float: by its radiance and its area, of which
/// a needle has little for its length.
fn has_power(light: &LightRef<'_, Rgb>, l: Vec3) -> bool {
    let area = match light {
        LightRef::Area(light) => light.shape().area(),
        LightRef::Triangle(light) => light.shape().area(),
        _ => return true,
    };
    // Both sides.
    let most = 2.0 * core::f64::consts::PI * f64::from(area) * f64::from(l.max_element());
    most >= f64::from(f32::MIN_POSITIVE)
}

/// What arrives, by a sample of the light, has a pmf above zero.
fn check_samplers(set: &LightSet<Rgb>, contexts: &[LightSampleContext], us: &[Vec2]) {
    let extents = set.extents();
    let default = BvhLightSampler::new(&extents).expect("valid extents");
    let reference = ReferenceBvhLightSampler::new(&extents).expect("valid extents");
    for ctx in contexts.iter().filter(|ctx| is_somewhere(ctx)) {
        for (id, light) in set.iter() {
            let arrives = us.iter().find_map(|&u| {
                let sample = light.sample_li(ctx, u, &(), PdfCoverage::Complete)?;
                let above = ctx.ns().is_none_or(|ns| ns.dot(sample.wi) > 1e-4);
                // A contribution that is not a positive float counts as none.
                let irradiance = sample.l.max_element() / sample.pdf;
                let is_light = irradiance > 1e-30 && has_power(&light, sample.l);
                (above && is_light).then_some(sample)
            });
            let Some(sample) = arrives else { continue };
            let pmfs = [default.pmf(ctx, id), reference.pmf(ctx, id)];
            assert!(
                pmfs[0] > 0.0 && pmfs[1] > 0.0,
                "{sample:?} arrives, pmfs are {pmfs:?} at {ctx:?} of {light:?}"
            );
        }
    }
}
