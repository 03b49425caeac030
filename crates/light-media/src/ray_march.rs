use crate::medium::Medium;
use crate::ray::{Ray, Span};
use crate::step_size::{March, StepSize};
use crate::transmittance::{self, ROULETTE_BELOW};
use light_sources::{ColorModel, Radiance};

/// A march along a ray through a medium: equal steps, one random offset for all of them, the
/// transmittance carried from point to point as a product.
pub(crate) struct RayMarch<'a, C: ColorModel, M: ?Sized> {
    medium: &'a M,
    ray: Ray,
    span: Span,
    step: StepSize,
    wavelengths: &'a C::Wavelengths,
    march: March,
    offset: f32,
    next: u32,
    reached: f32,
    transmittance: C::Radiance,
}

impl<'a, C: ColorModel, M: Medium<C> + ?Sized> RayMarch<'a, C, M> {
    /// The march through the part of `span` that lies in the medium; `None` where there is none.
    pub(crate) fn new(
        medium: &'a M,
        ray: &Ray,
        span: Span,
        step: StepSize,
        wavelengths: &'a C::Wavelengths,
        next_u: &mut impl FnMut() -> f32,
    ) -> Option<Self> {
        let span = medium.clip(ray, span)?;
        Some(Self {
            medium,
            ray: *ray,
            span,
            step,
            wavelengths,
            march: step.march(span),
            offset: next_u(),
            next: 0,
            reached: span.t0,
            transmittance: C::Radiance::splat(1.0),
        })
    }

    /// The number of steps and their length.
    pub(crate) const fn steps(&self) -> March {
        self.march
    }

    /// The distance of the next point and the transmittance up to it; `None` at the end, or when
    /// roulette ended the march.
    pub(crate) fn next_point(
        &mut self,
        next_u: &mut impl FnMut() -> f32,
    ) -> Option<(f32, C::Radiance)> {
        if self.next == self.march.n || self.transmittance.is_black() {
            return None;
        }
        let t = self.march.t0 + (self.next as f32 + self.offset) * self.march.step;
        self.next += 1;
        self.advance(t, next_u);
        if self.transmittance.maximum() < ROULETTE_BELOW {
            // Roulette: half of the marches end, the others count twice.
            let survives = next_u() < 0.5;
            self.transmittance = self.transmittance * if survives { 2.0 } else { 0.0 };
        }
        (!self.transmittance.is_black()).then_some((t, self.transmittance))
    }

    /// The transmittance through the whole span.
    pub(crate) fn finish(mut self, next_u: &mut impl FnMut() -> f32) -> C::Radiance {
        if !self.transmittance.is_black() {
            self.advance(self.span.t1, next_u);
        }
        self.transmittance
    }

    fn advance(&mut self, t: f32, next_u: &mut impl FnMut() -> f32) {
        if let Some(part) = Span::new(self.reached, t) {
            let left = transmittance::best_inside::<C, M>(
                self.medium,
                &self.ray,
                part,
                self.step,
                self.wavelengths,
                next_u,
            );
            self.transmittance = self.transmittance * left;
        }
        self.reached = t;
    }
}
