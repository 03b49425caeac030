use crate::medium::Medium;
use crate::ray::{Ray, Span};
use crate::tentative_collisions::{Collision, TentativeCollisions, null_share};
use light_sources::{ColorModel, Radiance};

/// The result of following a path through a medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight<R> {
    /// Distance at which it scatters; `None` when it reaches the end of the span.
    pub scattered_at: Option<f32>,
    /// Factor for the throughput of the path.
    pub weight: R,
    /// Radiance emitted by the medium along the way, seen from the start.
    pub emitted: R,
}

/// Follows a path of throughput `beta` along `ray` to the point where it scatters, or through
/// `span`. Unbiased in every channel, also where the extinction differs from channel to channel.
/// Absorption lowers the weight; it ends no path.
///
/// A collision is real or null with probabilities in proportion to the throughput after either, so
/// that weights stay near 1. `next_u` gives independent numbers in `[0, 1)`.
///
/// # Source
/// Weighted tracking after `[Novak2014]`; the choice by throughput follows `[Kutz2017]`, section
/// 5.1.
pub fn delta_tracking<C: ColorModel, M: Medium<C> + ?Sized>(
    medium: &M,
    ray: &Ray,
    span: Span,
    beta: C::Radiance,
    wavelengths: &C::Wavelengths,
    next_u: &mut impl FnMut() -> f32,
) -> Flight<C::Radiance> {
    let mut flight = Flight {
        scattered_at: None,
        weight: C::Radiance::splat(1.0),
        emitted: C::Radiance::BLACK,
    };
    let Some(span) = medium.clip(ray, span) else {
        return flight;
    };
    let mut collisions = TentativeCollisions::new(medium.majorants(ray, span, wavelengths));
    while let Some(Collision { t, sigma_maj }) = collisions.next(next_u) {
        let here = medium.coefficients(ray.at(t), wavelengths);
        let inv_maj = 1.0 / sigma_maj;
        flight.emitted = flight.emitted + flight.weight * here.emission * inv_maj;

        let real = flight.weight * here.sigma_s * inv_maj;
        let null = flight.weight * null_share(here.sigma_t(), sigma_maj);
        let (p_real, p_null) = ((beta * real).average(), (beta * null).average());
        let total = p_real + p_null;
        if !(total > 0.0) {
            flight.weight = C::Radiance::BLACK;
            return flight;
        }
        // An event whose weight overflows has a negligible probability and is skipped.
        let is_possible = (total / p_real).is_finite();
        if next_u() * total < p_real && is_possible {
            flight.weight = real * (total / p_real);
            flight.scattered_at = Some(t);
            return flight;
        }
        flight.weight = null * (total / p_null);
    }
    flight
}
