//! Whether the densities that samples of a light carry are those that are queried, one sample at a
//! time.

use core::f32::consts::TAU;

use light_bounds::LightSampleContext;
use light_math::glam::{Vec2, Vec3};
use light_sources::{EmittedRay, LePdf, Light, LightRef, LightType, PdfCoverage, Rgb};

/// How far two ways to compute one density may differ, relatively: rounding of grazing and of tiny
/// shapes.
const ROUNDING: f32 = 2e-3;

/// Cosines of grazing angles, at which densities grow without bound, and are not compared.
const GRAZING: f32 = 1e-3;

/// Sines of the angles by which a direction is turned where it lies so near to an edge, of a shape
/// or a texel, that its density is that of the other side.
const NEAR: [f32; 3] = [1.2e-7, 1e-6, 1e-5];

/// Directions in which it is turned: the corner of a texel of an equal-area image has 43 degrees on
/// the sphere where the square's diagonals meet the equator.
const ASIDES: u8 = 32;

/// What a sample must satisfy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Demand {
    /// It is finite and in range: all that shapes of any size and receivers anywhere promise.
    Range,
    /// Its density is the queried one: where sizes and distances are of scenes.
    Density,
}

/// What is wrong with a sample of arriving light; `Ok(false)` if there is none.
pub(crate) fn li_agrees(
    light: &LightRef<'_, Rgb>,
    ctx: &LightSampleContext,
    u: Vec2,
    coverage: PdfCoverage,
    demand: Demand,
) -> Result<bool, String> {
    let Some(sample) = light.sample_li(ctx, u, &(), coverage) else {
        return Ok(false);
    };
    let pdf = light.pdf_li(ctx, sample.wi, coverage);
    let fault = |what: &str| {
        let (light, bounds) = (light.light_type(), light.extent());
        Err(format!(
            "{what}: {sample:?}, queried {pdf}, for {u}, {coverage:?}, at {ctx:?} of {light:?} \
             {bounds:?}"
        ))
    };
    if !is_light(sample.l) {
        return fault("radiance");
    }
    if !((sample.wi.length() - 1.0).abs() < 1e-4 && sample.p_light.is_finite()) {
        return fault("direction or place");
    }
    if !(sample.pdf > 0.0 && sample.pdf.is_finite()) {
        return fault("density");
    }
    // A surface that no ray meets is a Dirac to others, but is sampled by its area.
    let has_surface = sample.n_light != Vec3::ZERO;
    if light.light_type().is_delta() && !has_surface {
        return match (sample.pdf, pdf) {
            (1.0, 0.0) => Ok(true),
            _ => fault("densities of a Dirac"),
        };
    }
    if demand == Demand::Range {
        return Ok(true);
    }
    if has_surface && sample.n_light.dot(sample.wi).abs() < GRAZING {
        return Ok(true);
    }
    if !near(sample.wi, sample.pdf, |wi| light.pdf_li(ctx, wi, coverage)) {
        return fault("another density");
    }
    let l = |wi, channel: usize| light.le(ctx.p, wi, &())[channel];
    if light.light_type() == LightType::Infinite
        && !(0..3).all(|channel| near(sample.wi, sample.l[channel], |wi| l(wi, channel)))
    {
        return fault("another radiance");
    }
    Ok(true)
}

/// What is wrong with a ray that leaves a light; `Ok(false)` if there is none.
pub(crate) fn le_agrees(
    light: &LightRef<'_, Rgb>,
    u1: Vec2,
    u2: Vec2,
    demand: Demand,
) -> Result<bool, String> {
    let Some(sample) = light.sample_le(u1, u2, &()) else {
        return Ok(false);
    };
    let ray = sample.ray;
    let queried = light.pdf_le(&ray);
    let fault = |what: &str| {
        let (light, bounds) = (light.light_type(), light.extent());
        Err(format!(
            "{what}: {sample:?}, queried {queried:?}, for {u1}, {u2} of {light:?} {bounds:?}"
        ))
    };
    if !is_light(sample.l) {
        return fault("radiance");
    }
    if !((ray.direction.length() - 1.0).abs() < 1e-4 && ray.origin.is_finite()) {
        return fault("direction or origin");
    }
    let LePdf { pos, dir } = sample.pdf;
    if !(pos > 0.0 && pos.is_finite() && dir > 0.0 && dir.is_finite()) {
        return fault("density");
    }
    if demand == Demand::Range || sample.l == Vec3::ZERO {
        return Ok(true);
    }
    let asked = |direction| light.pdf_le(&EmittedRay { direction, ..ray });
    // A Dirac counts as 1 in a sample, as 0 in a query.
    let is_pos = is_dirac(pos, queried.pos) || near(ray.direction, pos, |w| asked(w).pos);
    let is_dir = is_dirac(dir, queried.dir) || near(ray.direction, dir, |w| asked(w).dir);
    if !(is_pos && is_dir) {
        return fault("another density");
    }
    Ok(true)
}

fn is_dirac(sampled: f32, queried: f32) -> bool {
    sampled == 1.0 && queried == 0.0
}

/// Finite and not negative.
pub(crate) fn is_light(l: Vec3) -> bool {
    l.is_finite() && l.min_element() >= 0.0
}

/// Whether a function of directions has the `expected` value in `w`, or lies below it in one
/// direction next to `w` and above it in another: there it has an edge, or is so steep that the
/// rounding of `w` shows.
fn near(w: Vec3, expected: f32, value: impl Fn(Vec3) -> f32) -> bool {
    let here = value(w);
    if (here - expected).abs() <= ROUNDING * here.max(expected) {
        return true;
    }
    let (x, y) = w.normalize().any_orthonormal_pair();
    let (mut low, mut high) = (here, here);
    for by in NEAR {
        for k in 0..ASIDES {
            let (sin, cos) = (f32::from(k) * (TAU / f32::from(ASIDES))).sin_cos();
            let beside = value((w + (x * cos + y * sin) * by).normalize());
            (low, high) = (low.min(beside), high.max(beside));
        }
    }
    low * (1.0 - ROUNDING) <= expected && expected <= high * (1.0 + ROUNDING)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_and_slopes_are_excused_and_other_values_are_not() {
        let step = |w: Vec3| if w.x > 5e-6 { 2.0 } else { 0.0 };
        assert!(near(Vec3::Z, 2.0, step), "beside an edge");
        assert!(!near(Vec3::Z, 4.0, step), "twice what is beside an edge");
        let far = Vec3::new(0.01, 0.0, 1.0).normalize();
        assert!(!near(far, 0.0, step), "away from the edge");
        let corner = |w: Vec3| {
            if w.y.abs() < 0.38 * w.x - 1e-7 {
                2.0
            } else {
                0.0
            }
        };
        for turn in 0..90 {
            let (sin, cos) = (turn as f32).to_radians().sin_cos();
            let turned =
                |w: Vec3| corner(Vec3::new(w.x * cos - w.y * sin, w.x * sin + w.y * cos, w.z));
            assert!(
                near(Vec3::Z, 2.0, turned),
                "beside a corner turned by {turn}"
            );
        }
        let steep = |w: Vec3| 1.0 + 1e5 * w.x;
        assert!(near(Vec3::Z, 1.5, steep), "a slope");
        assert!(!near(Vec3::Z, 4.0, steep), "beyond a slope");
    }
}
