use crate::march::StepSize;
use crate::medium::Medium;
use crate::ray::{Ray, Span};
use crate::transmittance;
use light_bounds::{LightId, LightSampleContext};
use light_math::glam::{Vec2, Vec3};
use light_samplers::LightSampler;
use light_sources::{ColorModel, Light, LightSet, LightType, PdfCoverage, Radiance};

/// What the integrators must know of the geometry.
pub trait Visibility {
    /// Whether nothing opaque lies between two points; a surface that one of them lies on does not
    /// count.
    fn unoccluded(&self, from: Vec3, to: Vec3) -> bool;
}

/// Everything that light scattered in a medium depends on but the ray: the medium, the lights, a
/// way to choose one of them, and what stands in their way.
#[derive(Debug)]
pub struct VolumeIntegrator<'a, C: ColorModel, M: ?Sized, S: ?Sized, V: ?Sized> {
    /// The medium that scatters.
    pub medium: &'a M,
    /// The lights.
    pub lights: &'a LightSet<C>,
    /// Chooses among them, by their ids.
    pub sampler: &'a S,
    /// Hides them.
    pub scene: &'a V,
    /// What colours are asked for.
    pub wavelengths: &'a C::Wavelengths,
    /// Steps of marches along a ray.
    pub step: StepSize,
    /// Steps of marches between ray and light, which may be coarser; only media without closed
    /// forms need them.
    pub shadow_step: StepSize,
}

/// A point in a medium at which light is scattered toward the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScatteringPoint {
    /// The point.
    pub p: Vec3,
    /// Unit direction toward the eye.
    pub wo: Vec3,
}

impl<C, M, S, V> VolumeIntegrator<'_, C, M, S, V>
where
    C: ColorModel,
    M: Medium<C> + ?Sized,
    S: LightSampler + ?Sized,
    V: Visibility + ?Sized,
{
    /// One-sample estimate of the light that arrives at a point straight from the lights and is
    /// scattered toward the eye, per unit of the scattering coefficient: the integral of phase
    /// function times radiance, in W m^-2 sr^-1.
    ///
    /// `u_light` chooses a light, by whose probability the estimate is divided, `u` in `[0, 1)^2`
    /// the point on it. Occlusion and the attenuation between light and point are taken into
    /// account.
    pub fn in_scattered(
        &self,
        at: ScatteringPoint,
        u_light: f64,
        u: Vec2,
        next_u: &mut impl FnMut() -> f32,
    ) -> C::Radiance {
        match self
            .sampler
            .sample(&LightSampleContext::medium(at.p), u_light)
        {
            Some(chosen) => self.scattered_from(chosen.light, at, u, next_u) * (1.0 / chosen.pmf),
            None => C::Radiance::BLACK,
        }
    }

    /// The same from one given light, without its probability.
    pub fn scattered_from(
        &self,
        light: LightId,
        at: ScatteringPoint,
        u: Vec2,
        next_u: &mut impl FnMut() -> f32,
    ) -> C::Radiance {
        self.weighted_from(light, at, u, |_, _| 1.0, next_u)
    }

    /// The same, times a weight of the densities of the direction by the light and by the phase
    /// function, in sr^-1; Dirac lights, which no other strategy finds, have the weight 1.
    pub(crate) fn weighted_from(
        &self,
        light: LightId,
        at: ScatteringPoint,
        u: Vec2,
        weight: impl Fn(f32, f32) -> f32,
        next_u: &mut impl FnMut() -> f32,
    ) -> C::Radiance {
        let ctx = LightSampleContext::medium(at.p);
        let Some(light) = self.lights.get(light) else {
            return C::Radiance::BLACK;
        };
        let sample = light.sample_li(&ctx, u, self.wavelengths, PdfCoverage::Complete);
        let Some(li) = sample else {
            return C::Radiance::BLACK;
        };
        let phase = self.medium.phase().pdf(at.wo, li.wi);
        let weight = if light.light_type().is_delta() {
            1.0
        } else {
            weight(li.pdf, phase)
        };
        let factor = weight * phase / li.pdf;
        if li.l.is_black() || !(factor > 0.0) || !self.scene.unoccluded(at.p, li.p_light) {
            return C::Radiance::BLACK;
        }
        let ray = Ray { o: at.p, d: li.wi };
        let distance = match light.light_type() {
            LightType::DeltaPosition | LightType::Area => at.p.distance(li.p_light),
            // Fog without end lets nothing through from infinity.
            LightType::DeltaDirection | LightType::Infinite => f32::INFINITY,
        };
        let left = match Span::new(0.0, distance) {
            Some(span) => transmittance::best::<C, M>(
                self.medium,
                &ray,
                span,
                self.shadow_step,
                self.wavelengths,
                next_u,
            ),
            None => C::Radiance::splat(1.0),
        };
        li.l * left * factor
    }
}
