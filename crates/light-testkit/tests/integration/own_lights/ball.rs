use alloc::sync::Arc;

use light_bounds::{LightBounds, LightExtent, LightSampleContext};
use light_math::Frame;
use light_math::glam::{Affine3A, Vec2, Vec3};
use light_math::warp::cosine_hemisphere;
use light_sources::shape::{AnyShape, Shape, ShapeDesc, ShapeSample};
use light_sources::*;

use core::f32::consts::PI;

/// A ball that is darker toward its rim, as the sun is: where the surface is seen under the cosine
/// `mu` its radiance is `radiance * (1 - DARKENING * (1 - mu))`.
pub(crate) struct Ball {
    shape: AnyShape,
    radiance: f32,
}

pub(crate) const DARKENING: f32 = 0.6;

impl Ball {
    pub(crate) fn own(center: Vec3, radius: f32, radiance: f32) -> OwnLight<Rgb> {
        let transform = Affine3A::from_translation(center);
        let shape = ShapeDesc::Sphere { transform, radius };
        OwnLight::Area(Arc::new(Self {
            shape: shape.build().expect("a sphere"),
            radiance,
        }))
    }

    fn pdf_direction(ray: &EmittedRay) -> f32 {
        cosine_hemisphere::pdf(ray.normal.dot(ray.direction).max(0.0))
    }
}

impl Light<Rgb> for Ball {
    fn light_type(&self) -> LightType {
        LightType::Area
    }

    /// The integral of the radiance times the cosine over the half sphere is
    /// `pi * (1 - DARKENING / 3)`.
    fn phi(&self, (): &()) -> Vec3 {
        Vec3::splat(PI * (1.0 - DARKENING / 3.0) * self.shape.area() * self.radiance)
    }

    fn sample_li(
        &self,
        ctx: &LightSampleContext,
        u: Vec2,
        (): &(),
        _: PdfCoverage,
    ) -> Option<LightLiSample<Vec3>> {
        let toward = self.shape.sample_toward(ctx, u)?;
        let l = self.l(&toward.at, -toward.wi, &());
        (l != Vec3::ZERO).then_some(LightLiSample {
            l,
            wi: toward.wi,
            pdf: toward.pdf,
            p_light: toward.at.p,
            n_light: toward.at.n,
            uv: toward.at.uv,
        })
    }

    fn pdf_li(&self, ctx: &LightSampleContext, wi: Vec3, _: PdfCoverage) -> f32 {
        self.shape.pdf_toward(ctx, wi)
    }

    fn sample_le(&self, u1: Vec2, u2: Vec2, (): &()) -> Option<LightLeSample<Vec3>> {
        let ShapeSample { at, pdf } = self.shape.sample(u1)?;
        let direction = Frame::from_z(at.n).from_local(cosine_hemisphere::sample(u2));
        let ray = EmittedRay {
            origin: at.p,
            direction,
            normal: at.n,
            uv: at.uv,
        };
        let dir = Self::pdf_direction(&ray);
        (dir > 0.0).then(|| LightLeSample {
            l: self.l(&at, direction, &()),
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
            dir: Self::pdf_direction(ray),
        }
    }

    /// The power as if it were as bright everywhere as in its middle.
    fn extent(&self) -> LightExtent {
        LightExtent::Bounded(LightBounds {
            bounds: self.shape.bounds(),
            w: Vec3::Z,
            phi: PI * self.shape.area() * self.radiance,
            cos_theta_o: -1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        })
    }
}

impl AreaLight<Rgb> for Ball {
    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        self.shape.hit(origin, direction)
    }

    fn l(&self, at: &SurfacePoint, w: Vec3, (): &()) -> Vec3 {
        let mu = at.n.dot(w);
        let dimmed = self.radiance * (1.0 - DARKENING * (1.0 - mu));
        Vec3::splat(if mu > 0.0 { dimmed } else { 0.0 })
    }
}
