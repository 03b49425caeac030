use crate::emission::VolumeLight;
use crate::in_scattering::{ScatteringPoint, Visibility, VolumeIntegrator};
use crate::latin_hypercube::LatinHypercube;
use crate::medium::{Coefficients, Medium};
use crate::ray::{Ray, Span};
use crate::step_size::StepSize;
use crate::transmittance;
use crate::truncated_exponential::TruncatedExponential;
use light_bounds::{LightId, LightSampleContext};
use light_math::glam::{Vec2, Vec3};
use light_math::warp::Equiangular;
use light_math::{float, fraction};
use light_samplers::LightSampler;
use light_sources::{ColorModel, Light, Radiance};

/// Optical thickness at which an unbounded ray is first tried to be cut off.
const OPAQUE: f32 = 20.0;

/// Where less than this share of the light at the start of an unbounded ray arrives, it is cut off.
const CUT_OFF: f32 = 1e-8;

impl<C, M, S, V> VolumeIntegrator<'_, C, M, S, V>
where
    C: ColorModel,
    M: Medium<C> + ?Sized,
    S: LightSampler + ?Sized,
    V: Visibility + ?Sized,
{
    /// The radiance that the medium emits and scatters once toward the start of a ray, from
    /// `samples` points.
    ///
    /// Unlike [`single_scattering`](Self::single_scattering), which marches, this samples lights.
    /// The sampler chooses all lights in one call, for the whole ray. Each light then gets a point
    /// of the ray: half of the points are equiangular about the light, half in proportion to the
    /// transmittance, weighted by the balance heuristic. Unbiased where the
    /// transmittance has a closed form. `next_u` gives independent numbers in `[0, 1)`.
    ///
    /// # Source
    /// `[Kulla2012]`, sections 4 and 5. Choosing the lights for the whole ray is not in the paper.
    pub fn next_event(
        &self,
        ray: &Ray,
        span: Span,
        samples: u32,
        seed: u32,
        next_u: &mut impl FnMut() -> f32,
    ) -> VolumeLight<C::Radiance> {
        let Some(whole) = self.medium.clip(ray, span) else {
            return VolumeLight::vacuum();
        };
        let left = |span, next_u: &mut _| {
            transmittance::best_inside::<C, M>(
                self.medium,
                ray,
                span,
                self.step,
                self.wavelengths,
                next_u,
            )
        };
        let transmittance = left(whole, next_u);
        let (part, dying) = self.reach(ray, whole, transmittance);
        let numbers = LatinHypercube::new(samples, seed);
        let mut sum = C::Radiance::BLACK;

        // Emission, at points in proportion to the transmittance.
        for i in 0..numbers.len() {
            let [_, _, _, u] = numbers.point_f32(i);
            let x = dying.sample(u);
            let t = part.t0 + x;
            let here = self.medium.coefficients(ray.at(t), self.wavelengths);
            if !here.emission.is_black() {
                let before = Span { t0: part.t0, t1: t };
                sum = sum + left(before, next_u) * here.emission * (1.0 / dying.pdf(x));
            }
        }

        // Scattering, at points for each light.
        let context = LightSampleContext::segment(ray.at(part.t0), ray.d * part.length());
        let choices = self.sampler.at(&context, numbers.len());
        let u = fraction::from_f32(next_u(), fraction::from_f32(next_u(), 0));
        for (i, chosen) in (0..).zip(choices.samples(u)) {
            let [u_t, u0, u1] = numbers.point_f32(i);
            let (t, pdf) = match self.seen_from(chosen.light, ray, part) {
                Some(even) => {
                    let t = if u_t < 0.5 {
                        even.sample(2.0 * u_t)
                    } else {
                        part.t0 + dying.sample(2.0 * u_t - 1.0)
                    };
                    (t, 0.5 * (even.pdf(t) + dying.pdf(t - part.t0)))
                }
                None => {
                    let x = dying.sample(u_t);
                    (part.t0 + x, dying.pdf(x))
                }
            };
            let at = ScatteringPoint {
                p: ray.at(t),
                wo: -ray.d,
            };
            let here = self.medium.coefficients(at.p, self.wavelengths);
            if here.sigma_s.is_black() {
                continue;
            }
            let scattered = self.scattered_from(chosen.light, at, Vec2::new(u0, u1), next_u);
            if !scattered.is_black() {
                let before = Span { t0: part.t0, t1: t };
                let weight = 1.0 / (pdf * chosen.pmf);
                sum = sum + left(before, next_u) * here.sigma_s * scattered * weight;
            }
        }
        VolumeLight {
            l: sum * (1.0 / numbers.len() as f32),
            transmittance,
        }
    }

    /// The part of a ray in the medium before the cut-off, and the transmittance along it.
    fn reach(&self, ray: &Ray, whole: Span, through: C::Radiance) -> (Span, TruncatedExponential) {
        if whole.t1.is_finite() {
            let dying = falling_to(through.average(), whole.length());
            return (whole, dying);
        }
        let farthest = self.step.length() * StepSize::MAX_STEPS as f32;
        let start = self.medium.coefficients(ray.at(whole.t0), self.wavelengths);
        let rate = start.sigma_t().average();
        let mut length = if rate > 0.0 {
            farthest.min(OPAQUE / rate)
        } else {
            farthest
        };
        loop {
            let t1 = whole.t0 + length;
            let part = Span { t1, ..whole };
            let arriving = self.arriving_from_end(ray, part, &start);
            // One colour may reach much farther than all of them do on average. Not a number, where
            // nothing shines at the start, ends the search.
            if !(arriving > CUT_OFF) || length == farthest {
                return (part, falling_to(arriving, part.length()));
            }
            length = farthest.min(2.0 * length);
        }
    }

    /// How much of what is emitted and scattered at the end of a span arrives, relative to what is
    /// at its start.
    fn arriving_from_end(&self, ray: &Ray, span: Span, start: &Coefficients<C::Radiance>) -> f32 {
        let thickness = self.medium.optical_thickness(ray, span, self.wavelengths);
        let (end, thickness) = match thickness {
            Some(thickness) => (
                self.medium.coefficients(ray.at(span.t1), self.wavelengths),
                thickness,
            ),
            None => (*start, start.sigma_t() * span.length()),
        };
        let arriving = transmittance::attenuation(thickness) * (end.sigma_s + end.emission);
        arriving.average() / (start.sigma_s + start.emission).average()
    }

    /// The equiangular distribution along the ray about a light; `None` for lights at infinity.
    fn seen_from(&self, light: LightId, ray: &Ray, part: Span) -> Option<Equiangular> {
        let to_light: Vec3 = self.lights.get(light)?.bounds()?.centroid() - ray.o;
        Equiangular::new(to_light, ray.d, part.t0, part.t1)
    }
}

/// The distances up to `length` with a density that falls to the share `left`.
fn falling_to(left: f32, length: f32) -> TruncatedExponential {
    let thickness = -float::ln(left.clamp(f32::MIN_POSITIVE, 1.0));
    TruncatedExponential::new(thickness / length, length)
}
