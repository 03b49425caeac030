use crate::medium::Medium;
use crate::ray::{Ray, Span};
use crate::ray_march::RayMarch;
use crate::step_size::StepSize;
use light_sources::{ColorModel, Radiance};

/// Radiance and transmittance along a ray through a medium: with the radiance `lo` at the end of
/// the ray, `lo * transmittance + l` arrives at its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VolumeLight<R> {
    /// Radiance added by the medium, in W m^-2 sr^-1.
    pub l: R,
    /// Transmittance of the whole span.
    pub transmittance: R,
}

impl<R: Radiance> VolumeLight<R> {
    /// The values of a ray through vacuum.
    #[must_use]
    pub fn vacuum() -> Self {
        Self {
            l: R::BLACK,
            transmittance: R::splat(1.0),
        }
    }
}

/// The radiance that a medium emits along `span` toward the start of `ray`, in W m^-2 sr^-1, and
/// the transmittance of the span; without in-scattering.
///
/// Marches in equal steps from one random offset, as the first two editions of the pbrt book
/// do. `next_u` gives independent numbers in `[0, 1)`.
///
/// # Source
/// `[PBRT4]`, equation 14.1 without its in-scattering term.
pub fn emission<C: ColorModel, M: Medium<C> + ?Sized>(
    medium: &M,
    ray: &Ray,
    span: Span,
    step: StepSize,
    wavelengths: &C::Wavelengths,
    next_u: &mut impl FnMut() -> f32,
) -> VolumeLight<C::Radiance> {
    let Some(mut march) = RayMarch::new(medium, ray, span, step, wavelengths, next_u) else {
        return VolumeLight::vacuum();
    };
    let mut sum = C::Radiance::BLACK;
    while let Some((t, transmittance)) = march.next_point(next_u) {
        sum = sum + transmittance * medium.coefficients(ray.at(t), wavelengths).emission;
    }
    VolumeLight {
        l: sum * march.steps().step,
        transmittance: march.finish(next_u),
    }
}
