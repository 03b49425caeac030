use crate::medium::Medium;
use crate::ray::{Ray, Span};
use crate::step_size::StepSize;
use crate::transmittance;
use light_bounds::{LightId, LightSampleContext};
use light_math::glam::{Vec2, Vec3};
use light_samplers::LightSampler;
use light_sources::{ColorModel, Light, LightSet, PdfCoverage, Radiance};

/// The visibility queries of the integrators.
pub trait Visibility {
    /// Whether nothing opaque lies between two points. Surfaces through either point are ignored.
    fn unoccluded(&self, from: Vec3, to: Vec3) -> bool;
}

/// The inputs of single scattering other than the ray: the medium, the lights, a sampler of them,
/// and the visibility of the scene. The example [`fog`][1] renders lamps in fog with it.
///
/// [1]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/fog.rs
#[derive(Debug)]
pub struct VolumeIntegrator<'a, C: ColorModel, M: ?Sized, S: ?Sized, V: ?Sized> {
    /// The medium that scatters.
    pub medium: &'a M,
    /// The lights.
    pub lights: &'a LightSet<C>,
    /// Chooses lights by their ids.
    pub sampler: &'a S,
    /// Visibility between points.
    pub scene: &'a V,
    /// The wavelengths of the query.
    pub wavelengths: &'a C::Wavelengths,
    /// Step length of marches along the ray.
    pub step: StepSize,
    /// Step length of marches between ray and light, which may be larger; used only for media
    /// without a closed form.
    pub shadow_step: StepSize,
}

/// A point in a medium that scatters light toward the eye.
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
    /// One-sample estimate of the direct light at a point that is scattered toward the eye, per
    /// unit of the scattering coefficient: the integral of phase function times radiance, in W m^-2
    /// sr^-1.
    ///
    /// `u_light`, a fraction of 2^64, chooses a light, `u` in `[0, 1)^2` the point on it. The
    /// estimate is divided by the probability of the light, and includes occlusion and attenuation.
    pub fn in_scattered(
        &self,
        at: ScatteringPoint,
        u_light: u64,
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

    /// The same for one given light, not divided by its probability.
    pub fn scattered_from(
        &self,
        light: LightId,
        at: ScatteringPoint,
        u: Vec2,
        next_u: &mut impl FnMut() -> f32,
    ) -> C::Radiance {
        self.weighted_from(light, at, u, |_, _| 1.0, next_u)
    }

    /// The same, times an MIS weight of the densities of the direction by the light and by the
    /// phase function, in sr^-1. Dirac lights, which only light sampling finds, have weight 1.
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
        // An unbounded medium lets nothing through from infinity.
        let distance = if light.light_type().is_infinite() {
            f32::INFINITY
        } else {
            at.p.distance(li.p_light)
        };
        let step = self.shadow_step;
        let left = Span::new(0.0, distance).map_or(C::Radiance::splat(1.0), |span| {
            transmittance::best::<C, M>(self.medium, &ray, span, step, self.wavelengths, next_u)
        });
        li.l * left * factor
    }
}
