use crate::color::ColorModel;
use crate::glam::{Vec2, Vec3};
use crate::light_sample::{EmittedRay, LePdf, LightLeSample, LightLiSample};
use crate::light_type::LightType;
use crate::medium_interface::MediumInterface;
use crate::pdf_coverage::PdfCoverage;
use crate::surface_point::SurfacePoint;
use light_bounds::{LightBounds, LightExtent, LightSampleContext};

/// The interface of all lights. Random inputs `u` lie in `[0, 1)`; nothing here fails or panics.
///
/// A type of your own that implements it joins a [`LightSet`](crate::LightSet) as an
/// [`OwnLight`](crate::OwnLight).
///
/// Vectors are in scene space, directions have unit length and `wi` points toward the light.
pub trait Light<C: ColorModel> {
    /// The kind of light.
    fn light_type(&self) -> LightType;

    /// Emitted power in W, for lights at infinity the power that enters the scene's sphere.
    ///
    /// Infinite above the float range, 3.4e38 W; light samplers refuse the extent of such a light.
    fn phi(&self, wavelengths: &C::Wavelengths) -> C::Radiance;

    /// A direction from which the light arrives at `ctx.p`, with its density; `None` if no
    /// light arrives in the direction of `u`. The side of the surface at `ctx` is not tested: a
    /// direction below the horizon is left to the BSDF.
    ///
    /// The radiance that a surface reflects is estimated by `bsdf * l * |cos| / (pdf * pmf)`, where
    /// `cos` is that at the receiver and `pmf` the probability with which the light was chosen. Of
    /// several choices the sum is divided by their number.
    /// The example [`direct_lighting`][1] takes such samples, and [`mis`][2] weights them against
    /// those of the BSDF.
    ///
    /// [1]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/direct_lighting.rs
    /// [2]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/mis.rs
    fn sample_li(
        &self,
        ctx: &LightSampleContext,
        u: Vec2,
        wavelengths: &C::Wavelengths,
        coverage: PdfCoverage,
    ) -> Option<LightLiSample<C::Radiance>>;

    /// Density in sr^-1 with which [`sample_li`](Self::sample_li) chooses `wi`; 0 for lights in one
    /// point or one direction, and for directions that miss the light.
    fn pdf_li(&self, ctx: &LightSampleContext, wi: Vec3, coverage: PdfCoverage) -> f32;

    /// A ray that leaves the light, chosen by `u1` and `u2`, both uniform in `[0, 1)^2`.
    ///
    /// An area light chooses the origin by `u1` and the direction by `u2`; a light in a point the
    /// direction by `u1`; a light at infinity the direction by `u1` and the origin by `u2`, or the
    /// origin by `u1` if it has one direction.
    ///
    /// The power that the ray carries is `l * cos / (pdf.pos * pdf.dir)`, over the probability of
    /// the light if one was chosen. At a surface, `cos` is the absolute cosine between the ray's
    /// `direction` and its `normal`, because `pdf.pos` is a density per area of that surface. Where
    /// `normal` is zero the factor is 1: a light at a point has an intensity, and lights at
    /// infinity state `pdf.pos` per area across the ray. The mean of that power is
    /// [`phi`](Self::phi). The example [`light_tracing`][1] lets it land on a floor.
    ///
    /// [1]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/light_tracing.rs
    fn sample_le(
        &self,
        u1: Vec2,
        u2: Vec2,
        wavelengths: &C::Wavelengths,
    ) -> Option<LightLeSample<C::Radiance>>;

    /// Densities with which [`sample_le`](Self::sample_le) chooses `ray`, where a Dirac counts as
    /// 0.
    fn pdf_le(&self, ray: &EmittedRay) -> LePdf;

    /// The extent of the light for light samplers.
    fn extent(&self) -> LightExtent;

    /// Bounds of the light in space, direction and power; `None` for lights at infinity.
    fn bounds(&self) -> Option<LightBounds> {
        self.extent().bounded().copied()
    }

    /// The media that the light is in; vacuum for lights at infinity.
    fn media(&self) -> MediumInterface {
        MediumInterface::default()
    }
}

/// A light that rays can hit.
pub trait AreaLight<C: ColorModel>: Light<C> {
    /// The first point of the surface on the ray from `origin` in the unit direction `direction`,
    /// from either side; `None` for a ray that misses it, and for an invisible surface.
    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint>;

    /// Radiance that leaves the surface at `at` in direction `w`, in W m^-2 sr^-1.
    fn l(&self, at: &SurfacePoint, w: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance;
}

/// A light that rays reach by leaving the scene.
pub trait InfiniteLight<C: ColorModel>: Light<C> {
    /// Radiance that arrives along a ray that leaves the scene in `direction`, in W m^-2 sr^-1, at
    /// `origin`, which matters for portals only.
    fn le(&self, origin: Vec3, direction: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance;
}
