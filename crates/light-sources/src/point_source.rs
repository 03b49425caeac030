use crate::color::{ColorModel, Radiance};
use crate::glam::{Vec2, Vec3};
use crate::light::Light;
use crate::light_sample::{EmittedRay, LePdf, LightLeSample, LightLiSample};
use crate::light_type::LightType;
use crate::medium_interface::MediumInterface;
use crate::pdf_coverage::PdfCoverage;
use light_bounds::{EmissionLobe, LightBounds, LightExtent, LightSampleContext};

/// A point light: kinds differ only in the intensity by direction. Every `PointSource` is a
/// [`Light`]. The example [`own_light`][1] puts one into a set, among its lamps.
///
/// [1]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/own_light.rs
///
/// Directions are unit vectors in scene space, away from the light.
pub trait PointSource {
    /// The colour model.
    type Color: ColorModel;

    /// Position, in scene space.
    fn position(&self) -> Vec3;

    /// Intensity in W/sr in the direction `w`.
    fn intensity(&self, w: Vec3, wavelengths: &Wavelengths<Self>) -> Emitted<Self>;

    /// Emitted power in W: the integral of the intensity.
    fn power(&self, wavelengths: &Wavelengths<Self>) -> Emitted<Self>;

    /// A direction with its intensity in W/sr and its density in sr^-1, about in proportion to the
    /// intensity; both `u` lie in `[0, 1)`. `None` when no light is emitted there.
    fn sample_direction(
        &self,
        u1: Vec2,
        u2: Vec2,
        wavelengths: &Wavelengths<Self>,
    ) -> Option<DirectionSample<Emitted<Self>>>;

    /// Density in sr^-1 with which [`sample_direction`](Self::sample_direction) chooses `w`.
    fn direction_pdf(&self, w: Vec3) -> f32;

    /// Bounds in space, direction and power in W.
    fn point_bounds(&self) -> LightBounds;

    /// The moments of the intensity, if they are more precise than the bounds.
    fn lobe(&self) -> Option<EmissionLobe> {
        None
    }

    /// The medium around it, `outside`.
    fn surroundings(&self) -> MediumInterface;
}

type Wavelengths<S> = <<S as PointSource>::Color as ColorModel>::Wavelengths;
type Emitted<S> = <<S as PointSource>::Color as ColorModel>::Radiance;

/// A direction that [`PointSource::sample_direction`] chose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionSample<R> {
    /// Unit direction away from the light.
    pub w: Vec3,
    /// Intensity there, in W/sr.
    pub intensity: R,
    /// Density of `w` in sr^-1, above 0.
    pub pdf: f32,
}

impl<S: PointSource> Light<S::Color> for S {
    fn light_type(&self) -> LightType {
        LightType::DeltaPosition
    }

    fn phi(&self, wavelengths: &Wavelengths<S>) -> Emitted<S> {
        self.power(wavelengths)
    }

    fn sample_li(
        &self,
        ctx: &LightSampleContext,
        _u: Vec2,
        wavelengths: &Wavelengths<S>,
        _coverage: PdfCoverage,
    ) -> Option<LightLiSample<Emitted<S>>> {
        toward(ctx, self.position(), |w| self.intensity(w, wavelengths))
    }

    fn pdf_li(&self, _ctx: &LightSampleContext, _wi: Vec3, _coverage: PdfCoverage) -> f32 {
        0.0
    }

    fn sample_le(
        &self,
        u1: Vec2,
        u2: Vec2,
        wavelengths: &Wavelengths<S>,
    ) -> Option<LightLeSample<Emitted<S>>> {
        let DirectionSample { w, intensity, pdf } = self.sample_direction(u1, u2, wavelengths)?;
        (!intensity.is_black()).then(|| LightLeSample {
            l: intensity,
            ray: EmittedRay::from_point(self.position(), w),
            pdf: LePdf { pos: 1.0, dir: pdf },
        })
    }

    fn pdf_le(&self, ray: &EmittedRay) -> LePdf {
        LePdf {
            pos: 0.0,
            dir: self.direction_pdf(ray.direction),
        }
    }

    fn extent(&self) -> LightExtent {
        let bounds = self.point_bounds();
        match self.lobe() {
            Some(lobe) => LightExtent::Lobe(bounds, lobe),
            None => LightExtent::Bounded(bounds),
        }
    }

    fn media(&self) -> MediumInterface {
        self.surroundings()
    }
}

/// The sample toward a point light: `intensity` of the unit direction away from the light, over the
/// squared distance. `None` if it is black, if the two points coincide, or if the inverse square or
/// the radiance is not a positive finite number.
fn toward<R: Radiance>(
    ctx: &LightSampleContext,
    position: Vec3,
    intensity: impl FnOnce(Vec3) -> R,
) -> Option<LightLiSample<R>> {
    let to_light = position - ctx.p;
    let wi = to_light.try_normalize()?;
    let inv_dist_sq = 1.0 / to_light.length_squared();
    if !(inv_dist_sq > 0.0 && inv_dist_sq.is_finite()) {
        return None;
    }
    let l = intensity(-wi) * inv_dist_sq;
    (!l.is_black() && l.maximum().is_finite()).then_some(LightLiSample {
        l,
        wi,
        pdf: 1.0,
        p_light: position,
        n_light: Vec3::ZERO,
        uv: Vec2::ZERO,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn falls_with_the_squared_distance() {
        let ctx = LightSampleContext::medium(Vec3::ZERO);
        let sample = toward(&ctx, Vec3::Z * 2.0, |w| {
            assert_eq!(w, Vec3::NEG_Z, "away from the light");
            Vec3::ONE
        });
        assert_eq!(
            sample.map(|s| (s.l, s.wi)),
            Some((Vec3::splat(0.25), Vec3::Z)),
            "1 / 4"
        );
    }

    #[test]
    fn no_sample_in_the_dark_nor_where_the_square_fails() {
        let ctx = LightSampleContext::medium(Vec3::ZERO);
        assert!(toward(&ctx, Vec3::Z, |_| Vec3::ZERO).is_none(), "dark");
        for distance in [0.0, 1e-30, 1e30, f32::NAN] {
            let sample = toward(&ctx, Vec3::Z * distance, |_| Vec3::ONE);
            assert!(sample.is_none(), "distance {distance}");
        }
        let near = toward(&ctx, Vec3::Z * 1e-18, |_| Vec3::splat(1e9));
        assert!(near.is_none(), "more light than a float holds: {near:?}");
    }
}
