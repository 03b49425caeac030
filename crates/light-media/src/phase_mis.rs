use crate::in_scattering::{ScatteringPoint, Visibility, VolumeIntegrator};
use crate::medium::Medium;
use crate::ray::{Ray, Span};
use crate::transmittance;
use light_bounds::{LightId, LightSampleContext};
use light_math::glam::{Vec2, Vec3};
use light_math::mis;
use light_samplers::LightSampler;
use light_sources::{ColorModel, Light, PdfCoverage, Radiance, SurfacePoint};

/// The ray query with which phase function samples find lights.
pub trait Intersection: Visibility {
    /// The first hit of a ray from a point of the medium in the unit direction `wi`.
    fn first(&self, from: Vec3, wi: Vec3) -> FirstHit;
}

/// The first hit of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FirstHit {
    /// A point of a light with a surface.
    Light(LightId, SurfacePoint),
    /// A surface without emission.
    Dark,
    /// Nothing: the ray leaves the scene.
    Nothing,
}

/// The random numbers of [`VolumeIntegrator::in_scattered_mis`]: the points in `[0, 1)^2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScatteringNumbers {
    /// Chooses the light: a fraction of 2^64.
    pub light: u64,
    /// Chooses the point on it.
    pub point: Vec2,
    /// Chooses the direction of the phase function.
    pub direction: Vec2,
}

impl<C, M, S, V> VolumeIntegrator<'_, C, M, S, V>
where
    C: ColorModel,
    M: Medium<C> + ?Sized,
    S: LightSampler + ?Sized,
    V: Intersection + ?Sized,
{
    /// The same as [`in_scattered`](Self::in_scattered), from two samples: one of a light, one of
    /// the phase function, each weighted by the power heuristic. Reduces noise for large lights and
    /// peaked phase functions.
    ///
    /// # Source
    /// `[Veach1997]`, section 9.2.
    pub fn in_scattered_mis(
        &self,
        at: ScatteringPoint,
        numbers: ScatteringNumbers,
        next_u: &mut impl FnMut() -> f32,
    ) -> C::Radiance {
        let ctx = LightSampleContext::medium(at.p);
        let mut sum = C::Radiance::BLACK;
        if let Some(chosen) = self.sampler.sample(&ctx, numbers.light) {
            let weight = |density: f32, phase: f32| mis::power(density * chosen.pmf, phase);
            let light = self.weighted_from(chosen.light, at, numbers.point, weight, next_u);
            sum = sum + light * (1.0 / chosen.pmf);
        }
        let sample = self.medium.phase().sample(at.wo, numbers.direction);
        // Value and density of the phase function are the same number, so the weight alone is left.
        let weight = |light: LightId| {
            let density = self.lights.get(light).map_or(0.0, |source| {
                source.pdf_li(&ctx, sample.wi, PdfCoverage::Complete)
            });
            mis::power(sample.pdf, self.sampler.pmf(&ctx, light) * density)
        };
        let ray = Ray {
            o: at.p,
            d: sample.wi,
        };
        let (seen, t1) = match self.scene.first(at.p, sample.wi) {
            FirstHit::Dark => return sum,
            FirstHit::Light(light, point) => {
                let source = self.lights.get(light);
                let l = source.map_or(C::Radiance::BLACK, |source| {
                    source.l(&point, -sample.wi, self.wavelengths)
                });
                (l * weight(light), at.p.distance(point.p))
            }
            FirstHit::Nothing => {
                let sky = self.lights.infinite_ids().filter_map(|light| {
                    let l = self
                        .lights
                        .get(light)?
                        .le(at.p, sample.wi, self.wavelengths);
                    (!l.is_black()).then(|| l * weight(light))
                });
                (
                    sky.fold(C::Radiance::BLACK, |sum, l| sum + l),
                    f32::INFINITY,
                )
            }
        };
        match Span::new(0.0, t1) {
            Some(span) if !seen.is_black() => {
                let left = transmittance::best::<C, M>(
                    self.medium,
                    &ray,
                    span,
                    self.shadow_step,
                    self.wavelengths,
                    next_u,
                );
                sum + seen * left
            }
            _ => sum,
        }
    }
}
