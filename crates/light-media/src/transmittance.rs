//! Transmittance of a span: in closed form, by marching, or by ratio tracking.

use crate::medium::Medium;
use crate::ray::{Ray, Span};
use crate::step_size::StepSize;
use crate::tentative_collisions::{Collision, TentativeCollisions, null_share};
use light_math::float;
use light_sources::{ColorModel, Radiance};

/// Below this transmittance a march or a track goes on with probability 1/2, and then counts twice.
pub(crate) const ROULETTE_BELOW: f32 = 1e-3;

/// The transmittance in closed form, if the medium has one.
pub fn closed_form<C: ColorModel, M: Medium<C> + ?Sized>(
    medium: &M,
    ray: &Ray,
    span: Span,
    wavelengths: &C::Wavelengths,
) -> Option<C::Radiance> {
    let Some(span) = medium.clip(ray, span) else {
        return Some(C::Radiance::splat(1.0));
    };
    medium
        .optical_thickness(ray, span, wavelengths)
        .map(attenuation)
}

/// The transmittance by the extinction at one point of each step, at the same offset `jitter` in
/// `[0, 1)` in all of them. Consistent, but biased: the exponential of an estimate.
pub fn march<C: ColorModel, M: Medium<C> + ?Sized>(
    medium: &M,
    ray: &Ray,
    span: Span,
    step: StepSize,
    jitter: f32,
    wavelengths: &C::Wavelengths,
) -> C::Radiance {
    match medium.clip(ray, span) {
        Some(span) => march_inside::<C, M>(medium, ray, span, step, jitter, wavelengths),
        None => C::Radiance::splat(1.0),
    }
}

/// The same for a span that lies in the medium.
fn march_inside<C: ColorModel, M: Medium<C> + ?Sized>(
    medium: &M,
    ray: &Ray,
    span: Span,
    step: StepSize,
    jitter: f32,
    wavelengths: &C::Wavelengths,
) -> C::Radiance {
    let march = step.march(span);
    let thickness = (0..march.n).fold(C::Radiance::BLACK, |sum, i| {
        let t = march.segment(i).t0 + jitter * march.step;
        sum + medium.coefficients(ray.at(t), wavelengths).sigma_t() * march.step
    });
    attenuation(thickness)
}

/// An unbiased estimate of the transmittance, by ratio tracking along the medium's majorants.
/// `next_u` gives independent numbers in `[0, 1)`.
///
/// # Source
/// `[Novak2014]`, section 4.
pub fn ratio_tracking<C: ColorModel, M: Medium<C> + ?Sized>(
    medium: &M,
    ray: &Ray,
    span: Span,
    wavelengths: &C::Wavelengths,
    next_u: &mut impl FnMut() -> f32,
) -> C::Radiance {
    let mut left = C::Radiance::splat(1.0);
    let Some(span) = medium.clip(ray, span) else {
        return left;
    };
    let mut collisions = TentativeCollisions::new(medium.majorants(ray, span, wavelengths));
    while let Some(Collision { t, sigma_maj }) = collisions.next(next_u) {
        let here = medium.coefficients(ray.at(t), wavelengths);
        left = left * null_share(here.sigma_t(), sigma_maj);
        if left.maximum() < ROULETTE_BELOW {
            if next_u() < 0.5 {
                return C::Radiance::BLACK;
            }
            left = left * 2.0;
        }
    }
    left
}

/// The closed form where there is one, ratio tracking elsewhere: unbiased everywhere.
pub fn unbiased<C: ColorModel, M: Medium<C> + ?Sized>(
    medium: &M,
    ray: &Ray,
    span: Span,
    wavelengths: &C::Wavelengths,
    next_u: &mut impl FnMut() -> f32,
) -> C::Radiance {
    closed_form::<C, M>(medium, ray, span, wavelengths)
        .unwrap_or_else(|| ratio_tracking::<C, M>(medium, ray, span, wavelengths, next_u))
}

/// The closed form where there is one, a jittered march elsewhere.
pub fn best<C: ColorModel, M: Medium<C> + ?Sized>(
    medium: &M,
    ray: &Ray,
    span: Span,
    step: StepSize,
    wavelengths: &C::Wavelengths,
    next_u: &mut impl FnMut() -> f32,
) -> C::Radiance {
    match medium.clip(ray, span) {
        Some(span) => best_inside::<C, M>(medium, ray, span, step, wavelengths, next_u),
        None => C::Radiance::splat(1.0),
    }
}

/// The same for a span that lies in the medium.
pub(crate) fn best_inside<C: ColorModel, M: Medium<C> + ?Sized>(
    medium: &M,
    ray: &Ray,
    span: Span,
    step: StepSize,
    wavelengths: &C::Wavelengths,
    next_u: &mut impl FnMut() -> f32,
) -> C::Radiance {
    medium
        .optical_thickness(ray, span, wavelengths)
        .map_or_else(
            || march_inside::<C, M>(medium, ray, span, step, next_u(), wavelengths),
            attenuation,
        )
}

/// `exp(-thickness)` in every component.
#[inline]
pub(crate) fn attenuation<R: Radiance>(thickness: R) -> R {
    thickness.map(|x| float::exp(-x))
}
