use super::{Coefficients, DensityGrid, Glow, GridMediumError, Majorants, Medium, Substance};
use crate::phase::Phase;
use crate::ray::{Ray, Span};
use crate::region::Region;
use light_math::Aabb;
use light_math::glam::{Affine3A, Vec3};
use light_sources::{ColorModel, Radiance};

/// A medium whose density and emission are given by grids that fill a box.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize, S: serde::Serialize")
)]
pub struct GridMedium<C: ColorModel, S> {
    substance: Substance<C>,
    phase: Phase,
    region: Region,
    density: DensityGrid<S>,
    glow: Glow<C, S>,
}

impl<C: ColorModel, S: AsRef<[f32]>> GridMedium<C, S> {
    /// The medium in `bounds` of a space that `to_scene` takes to the scene. `density` multiplies
    /// the coefficients of `substance`, and `glow` its emission in addition.
    ///
    /// # Errors
    /// The box is empty, flat or not finite, the transform has no inverse, or extinction or emission
    /// is not finite where the grids are largest.
    pub fn new(
        substance: Substance<C>,
        phase: Phase,
        bounds: Aabb,
        to_scene: Affine3A,
        density: DensityGrid<S>,
        glow: Glow<C, S>,
    ) -> Result<Self, GridMediumError> {
        let most = density.max_value();
        // The emission without glow is a number too: it is multiplied last.
        let most_glow = glow.max_value().max(1.0);
        GridMediumError::check(
            most * substance.max_sigma_t(),
            most * substance.max_emission() * most_glow,
        )?;
        Ok(Self {
            substance,
            phase,
            region: Region::unit_cube(bounds, to_scene)?,
            density,
            glow,
        })
    }
}

impl<C: ColorModel, S: AsRef<[f32]>> Medium<C> for GridMedium<C, S> {
    fn phase(&self) -> &Phase {
        &self.phase
    }

    fn coefficients(&self, p: Vec3, wavelengths: &C::Wavelengths) -> Coefficients<C::Radiance> {
        let Some(p) = self.region.locate(p) else {
            return Coefficients::VACUUM;
        };
        let mut here = self
            .substance
            .at_density(self.density.lookup(p), wavelengths);
        if !here.emission.is_black() {
            here.emission = here.emission * self.glow.at(p, wavelengths);
        }
        here
    }

    fn clip(&self, ray: &Ray, span: Span) -> Option<Span> {
        self.region.clip(ray, span)
    }

    fn majorants(&self, ray: &Ray, span: Span, wavelengths: &C::Wavelengths) -> Majorants<'_> {
        let max_sigma_t = self.substance.sigma_t(wavelengths).maximum();
        let layers = [Some((self.density.majorants(), max_sigma_t)), None];
        let rounding = self.region.rounding(ray, span.t1);
        Majorants::cells(span, layers, &self.region.local_ray(ray), rounding)
    }
}
