//! The share of light that is left at the end of a span: exact, marched, or tracked.

use crate::march::StepSize;
use crate::medium::Medium;
use crate::ray::{Ray, Span};
use light_math::float;
use light_sources::{ColorModel, Radiance};

/// The transmittance where the medium knows it in closed form.
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

/// The transmittance by the extinction at one point of each step, at the same `jitter` in `[0, 1)` in all of them.
/// Consistent, but biased: the exponential of an estimate.
pub fn march<C: ColorModel, M: Medium<C> + ?Sized>(
    medium: &M,
    ray: &Ray,
    span: Span,
    step: StepSize,
    jitter: f32,
    wavelengths: &C::Wavelengths,
) -> C::Radiance {
    let Some(span) = medium.clip(ray, span) else {
        return C::Radiance::splat(1.0);
    };
    let march = step.march(span);
    let thickness = (0..march.n).fold(C::Radiance::BLACK, |sum, i| {
        let t = march.segment(i).t0 + jitter * march.step;
        sum + medium.coefficients(ray.at(t), wavelengths).sigma_t() * march.step
    });
    attenuation(thickness)
}

/// An unbiased estimate of the transmittance, by ratio tracking along the medium's majorants. `next_u` gives independent
/// numbers in `[0, 1)`.
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
    for segment in medium.majorants(ray, span, wavelengths) {
        let mut t = segment.span.t0;
        loop {
            t += free_flight(segment.sigma_maj, next_u());
            if !(t < segment.span.t1) {
                break;
            }
            left = left
                * null_share(
                    medium.coefficients(ray.at(t), wavelengths).sigma_t(),
                    segment.sigma_maj,
                );
            // Light that is nearly all gone lives on with probability 1/2.
            if left.maximum() < 1e-3 {
                if next_u() < 0.5 {
                    return C::Radiance::BLACK;
                }
                left = left * 2.0;
            }
        }
    }
    left
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
    closed_form::<C, M>(medium, ray, span, wavelengths)
        .unwrap_or_else(|| march::<C, M>(medium, ray, span, step, next_u(), wavelengths))
}

/// `exp(-thickness)` in every component.
#[inline]
pub(crate) fn attenuation<R: Radiance>(thickness: R) -> R {
    thickness.map(|x| float::exp(-x))
}

/// A distance with density `sigma exp(-sigma t)`; infinite in vacuum.
#[inline]
pub(crate) fn free_flight(sigma: f32, u: f32) -> f32 {
    -float::ln(1.0 - u) / sigma.max(f32::MIN_POSITIVE)
}

/// The share of a majorant that an extinction leaves: the probability that a tentative collision is none.
#[inline]
pub(crate) fn null_share<R: Radiance>(sigma_t: R, sigma_maj: f32) -> R {
    (sigma_t * (-1.0 / sigma_maj)).map(|x| (1.0 + x).max(0.0))
}
