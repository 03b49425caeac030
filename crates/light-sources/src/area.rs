use core::f32::consts::PI;

use crate::color::{ColorModel, Radiance};
use crate::diffuse_emission::DiffuseEmission;
use crate::glam::{Vec2, Vec3};
use crate::light::{AreaLight, Light};
use crate::light_power::LightPower;
use crate::light_sample::{EmittedRay, LePdf, LightLeSample, LightLiSample};
use crate::light_type::LightType;
use crate::medium_interface::MediumInterface;
use crate::pdf_coverage::PdfCoverage;
use crate::shape::{Shape, ShapeSample};
use crate::sides::Sides;
use crate::surface_point::SurfacePoint;
use light_bounds::{LightBounds, LightExtent, LightSampleContext};
use light_math::warp::cosine_hemisphere;
use light_math::{DirectionCone, Frame};

/// A diffuse area light: a shape, and an emission that several shapes may share.
///
/// It is a view, made on demand: a light set stores shapes and emissions apart.
///
/// # Source
/// `[PBRT4]`, section 12.4.
#[derive(Debug)]
pub struct DiffuseAreaLight<'a, C: ColorModel, S> {
    shape: S,
    emission: &'a DiffuseEmission<C>,
    /// The mean of the texture over the shape, if it is stored.
    mean: Option<&'a Vec3>,
}

impl<'a, C: ColorModel, S: Shape> DiffuseAreaLight<'a, C, S> {
    /// The light of `shape` with `emission`.
    #[must_use]
    pub const fn new(shape: S, emission: &'a DiffuseEmission<C>) -> Self {
        Self::with_mean(shape, emission, None)
    }

    /// As [`new`](Self::new), with the mean of the texture over the shape if it is known.
    #[inline]
    pub(crate) const fn with_mean(
        shape: S,
        emission: &'a DiffuseEmission<C>,
        mean: Option<&'a Vec3>,
    ) -> Self {
        Self {
            shape,
            emission,
            mean,
        }
    }

    fn mean(&self) -> Vec3 {
        self.mean
            .copied()
            .unwrap_or_else(|| self.emission.mean(&self.shape))
    }

    /// The surface.
    #[must_use]
    pub const fn shape(&self) -> &S {
        &self.shape
    }

    /// The emission of the surface.
    #[must_use]
    pub const fn emission(&self) -> &'a DiffuseEmission<C> {
        self.emission
    }
}

impl<'a, C: ColorModel, S: Shape> DiffuseAreaLight<'a, C, S> {
    pub(crate) fn light_power(&self) -> LightPower<'a, C> {
        self.emission.power_of(self.shape.area(), self.mean())
    }
}

impl<C: ColorModel, S: Shape> Light<C> for DiffuseAreaLight<'_, C, S> {
    #[inline]
    fn light_type(&self) -> LightType {
        if self.emission.is_visible() {
            LightType::Area
        } else {
            LightType::DeltaPosition
        }
    }

    fn phi(&self, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.light_power().at(wavelengths)
    }

    #[inline]
    fn sample_li(
        &self,
        ctx: &LightSampleContext,
        u: Vec2,
        wavelengths: &C::Wavelengths,
        _coverage: PdfCoverage,
    ) -> Option<LightLiSample<C::Radiance>> {
        let sample = self.shape.sample_toward(ctx, u)?;
        let l = self.emission.l(&sample.at, -sample.wi, wavelengths);
        (!l.is_black()).then_some(LightLiSample {
            l,
            wi: sample.wi,
            pdf: sample.pdf,
            p_light: sample.at.p,
            n_light: sample.at.n,
            uv: sample.at.uv,
        })
    }

    fn pdf_li(&self, ctx: &LightSampleContext, wi: Vec3, _coverage: PdfCoverage) -> f32 {
        self.shape.pdf_toward(ctx, wi)
    }

    fn sample_le(
        &self,
        u1: Vec2,
        u2: Vec2,
        wavelengths: &C::Wavelengths,
    ) -> Option<LightLeSample<C::Radiance>> {
        let ShapeSample { at, pdf } = self.shape.sample(u1)?;
        let direction = match self.emission.sides() {
            Sides::Front => Frame::from_z(at.n).from_local(cosine_hemisphere::sample(u2)),
            Sides::Back => Frame::from_z(-at.n).from_local(cosine_hemisphere::sample(u2)),
            // The first number chooses the side and is rescaled to the full interval.
            Sides::Both => {
                let (x, side) = if u2.x < 0.5 {
                    (u2.x, 1.0)
                } else {
                    (u2.x - 0.5, -1.0)
                };
                let u = Vec2::new(2.0 * x, u2.y);
                let w = cosine_hemisphere::sample(u) * Vec3::new(1.0, 1.0, side);
                Frame::from_z(at.n).from_local(w)
            }
        };
        let l = self.emission.l(&at, direction, wavelengths);
        let ray = EmittedRay {
            origin: at.p,
            direction,
            normal: at.n,
            uv: at.uv,
        };
        let dir = self.pdf_direction(&ray);
        // A surface too small for a density per area emits no rays.
        (!l.is_black() && dir > 0.0 && pdf.is_finite()).then_some(LightLeSample {
            l,
            ray,
            pdf: LePdf { pos: pdf, dir },
        })
    }

    fn pdf_le(&self, ray: &EmittedRay) -> LePdf {
        let at = SurfacePoint {
            p: ray.origin,
            n: ray.normal,
            uv: ray.uv,
        };
        LePdf {
            pos: self.shape.pdf(&at),
            dir: self.pdf_direction(ray),
        }
    }

    fn extent(&self) -> LightExtent {
        // A shape without area has no normal, and no power either: any cone will do.
        let cone = match self.shape.normal_cone() {
            cone if cone.is_empty() => DirectionCone::from_direction(Vec3::Z),
            cone => cone,
        };
        LightExtent::Bounded(LightBounds {
            bounds: self.shape.bounds(),
            w: if cone.is_whole_sphere() {
                cone.w
            } else {
                self.emission.sides().emitting_normal(cone.w)
            },
            phi: self.emission.strength_of(self.shape.area(), self.mean()),
            cos_theta_o: cone.cos_theta,
            cos_theta_e: 0.0,
            two_sided: self.emission.sides() == Sides::Both,
        })
    }

    fn media(&self) -> MediumInterface {
        self.emission.media()
    }
}

impl<C: ColorModel, S: Shape> AreaLight<C> for DiffuseAreaLight<'_, C, S> {
    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        let is_visible = self.emission.is_visible();
        self.shape.hit(origin, direction).filter(|_| is_visible)
    }

    fn l(&self, at: &SurfacePoint, w: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.emission.l(at, w, wavelengths)
    }
}

impl<C: ColorModel, S> DiffuseAreaLight<'_, C, S> {
    /// Density per solid angle of a direction that leaves the surface.
    fn pdf_direction(&self, ray: &EmittedRay) -> f32 {
        let sides = self.emission.sides();
        let cos_theta = ray.normal.dot(ray.direction).abs();
        if sides.emit_toward(ray.normal, ray.direction) {
            cos_theta / (PI * sides.count())
        } else {
            0.0
        }
    }
}
