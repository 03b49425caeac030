use super::{Coefficients, DensityGrid, Majorants, Medium, Substance};
use crate::phase::Phase;
use crate::ray::{Ray, Span};
use crate::region::{Region, RegionError};
use light_math::Aabb;
use light_math::glam::{Affine3A, Quat, Vec3};
use light_sources::ColorModel;

/// A medium whose density, and whose glow if it has one, varies over a grid that fills a box.
#[derive(Clone, Debug)]
pub struct GridMedium<C: ColorModel, S> {
    substance: Substance<C>,
    phase: Phase,
    region: Region,
    density: DensityGrid<S>,
    glow: Option<DensityGrid<S>>,
}

impl<C: ColorModel, S> GridMedium<C, S> {
    /// The medium in `bounds` of a space that `to_scene` takes to the scene. `density` multiplies the coefficients of
    /// `substance`; `glow`, where given, its emission once more.
    ///
    /// # Errors
    /// The box is empty, flat or not finite, or the transform has no inverse.
    pub fn new(
        substance: Substance<C>,
        phase: Phase,
        bounds: Aabb,
        to_scene: Affine3A,
        density: DensityGrid<S>,
        glow: Option<DensityGrid<S>>,
    ) -> Result<Self, RegionError> {
        Region::new(bounds, to_scene)?;
        // The box becomes the unit cube, so that grids are looked up without another change of space.
        let from_cube = Affine3A::from_scale_rotation_translation(
            bounds.diagonal(),
            Quat::IDENTITY,
            bounds.min,
        );
        let region = Region::new(Aabb::new(Vec3::ZERO, Vec3::ONE), to_scene * from_cube)?;
        Ok(Self {
            substance,
            phase,
            region,
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
        if !self.region.contains(p) {
            return Coefficients::VACUUM;
        }
        let p = self.region.local_point(p);
        let glow = self.glow.as_ref().map_or(1.0, |grid| grid.lookup(p));
        self.substance
            .at_density(self.density.lookup(p), glow, wavelengths)
    }

    fn clip(&self, ray: &Ray, span: Span) -> Option<Span> {
        self.region.clip(ray, span)
    }

    fn optical_thickness(
        &self,
        _ray: &Ray,
        _span: Span,
        _wavelengths: &C::Wavelengths,
    ) -> Option<C::Radiance> {
        None
    }

    fn majorants(&self, ray: &Ray, span: Span, _wavelengths: &C::Wavelengths) -> Majorants<'_> {
        let unit_ray = self.region.local_ray(ray);
        Majorants::cells(
            span,
            self.substance.max_sigma_t(),
            self.density.majorants(),
            &unit_ray,
        )
    }
}
