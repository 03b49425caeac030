use crate::emission::VolumeLight;
use crate::in_scattering::{ScatteringPoint, Visibility, VolumeIntegrator};
use crate::latin_hypercube::LatinHypercube;
use crate::medium::Medium;
use crate::ray::{Ray, Span};
use crate::ray_march::RayMarch;
use light_math::fraction::to_f32;
use light_math::glam::Vec2;
use light_samplers::LightSampler;
use light_sources::{ColorModel, Radiance};

impl<C, M, S, V> VolumeIntegrator<'_, C, M, S, V>
where
    C: ColorModel,
    M: Medium<C> + ?Sized,
    S: LightSampler + ?Sized,
    V: Visibility + ?Sized,
{
    /// The radiance that the medium emits and scatters once toward the start of a ray, by ray
    /// marching.
    ///
    /// Equal steps from one random offset; at each point one light, chosen by the sampler, whose
    /// estimate is divided by its probability. The choices of lights and of points on them come
    /// from a Latin hypercube for the ray, drawn with `seed`. `next_u` gives independent
    /// numbers in `[0, 1)`.
    ///
    /// # Source
    /// `[PBRT4]`, equation 14.1 with single scattering; `[PBRT2]`, section 16.3.
    pub fn single_scattering(
        &self,
        ray: &Ray,
        span: Span,
        seed: u32,
        next_u: &mut impl FnMut() -> f32,
    ) -> VolumeLight<C::Radiance> {
        let Some(mut march) =
            RayMarch::new(self.medium, ray, span, self.step, self.wavelengths, next_u)
        else {
            return VolumeLight::vacuum();
        };
        let triples = LatinHypercube::new(march.steps().n, seed);
        let mut sum = C::Radiance::BLACK;
        for i in 0.. {
            let Some((t, transmittance)) = march.next_point(next_u) else {
                break;
            };
            let at = ScatteringPoint {
                p: ray.at(t),
                wo: -ray.d,
            };
            let here = self.medium.coefficients(at.p, self.wavelengths);
            let [u_light, u0, u1] = triples.point(i);
            let scattered =
                self.in_scattered(at, u_light, Vec2::new(to_f32(u0), to_f32(u1)), next_u);
            sum = sum + transmittance * (here.emission + here.sigma_s * scattered);
        }
        VolumeLight {
            l: sum * march.steps().step,
            transmittance: march.finish(next_u),
        }
    }
}
