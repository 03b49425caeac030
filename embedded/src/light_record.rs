use light_bounds::{LightBounds, LightExtent, LightSampleContext};
use light_math::Frame;
use light_math::glam::{Affine3A, Mat3, Vec2, Vec3};
use light_sources::shape::{Shape, Triangle};
use light_sources::{
    IntensityAmount, Light, LightLiSample, PdfCoverage, PointLight, PointLightDesc, Rgb, Sides,
    SpotLight, SpotLightDesc,
};

/// A light of the scene as it lies in flash: 52 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct LightRecord {
    /// One of the constants below.
    pub(crate) kind: u32,
    /// The vertices of a triangle; the position of a point light; position and axis of a spot.
    pub(crate) p: [[f32; 3]; 3],
    /// The radiance of a triangle, or the intensity of the others.
    pub(crate) emission: f32,
    /// The half angle of a spot and where its falloff begins, in radians.
    pub(crate) angles: [f32; 2],
}

impl LightRecord {
    pub(crate) const ONE_SIDED_TRIANGLE: u32 = 0;
    pub(crate) const TWO_SIDED_TRIANGLE: u32 = 1;
    pub(crate) const POINT: u32 = 2;
    pub(crate) const SPOT: u32 = 3;

    /// The light; `None` if the record describes none.
    pub(crate) fn light(&self) -> Option<StoredLight> {
        let [a, b, c] = self.p.map(Vec3::from_array);
        let emission = Vec3::splat(self.emission);
        let amount = IntensityAmount::Radiometric(1.0);
        match self.kind {
            Self::ONE_SIDED_TRIANGLE | Self::TWO_SIDED_TRIANGLE => Some(StoredLight::Triangle {
                shape: Triangle::new([a, b, c], Triangle::DEFAULT_UV).ok()?,
                radiance: emission,
                sides: if self.kind == Self::TWO_SIDED_TRIANGLE {
                    Sides::Both
                } else {
                    Sides::Front
                },
            }),
            Self::POINT => {
                let light = PointLight::new(PointLightDesc::new(a, emission, amount));
                light.ok().map(StoredLight::Point)
            }
            Self::SPOT => {
                let axes = Frame::from_z(b);
                let axes = Mat3::from_cols(axes.x, axes.y, axes.z);
                let [angle, falloff_start] = self.angles;
                let transform = Affine3A::from_mat3_translation(axes, a);
                let light = SpotLight::new(SpotLightDesc {
                    falloff_start,
                    ..SpotLightDesc::new(transform, angle, emission, amount)
                });
                light.ok().map(StoredLight::Spot)
            }
            _ => None,
        }
    }
}

/// A light of the scene as queries use it.
pub(crate) enum StoredLight {
    /// A surface of one colour. `DiffuseAreaLight` needs an allocator for its textures.
    Triangle {
        shape: Triangle,
        radiance: Vec3,
        sides: Sides,
    },
    Point(PointLight<Rgb>),
    Spot(SpotLight<Rgb>),
}

impl StoredLight {
    /// As [`Light::sample_li`].
    pub(crate) fn sample_li(
        &self,
        ctx: &LightSampleContext,
        u: Vec2,
    ) -> Option<LightLiSample<Vec3>> {
        match self {
            Self::Triangle {
                shape,
                radiance,
                sides,
            } => {
                let sample = shape.sample_toward(ctx, u)?;
                let shines = sides.emit_toward(sample.at.n, -sample.wi);
                shines.then_some(LightLiSample {
                    l: *radiance,
                    wi: sample.wi,
                    pdf: sample.pdf,
                    p_light: sample.at.p,
                    n_light: sample.at.n,
                    uv: sample.at.uv,
                })
            }
            Self::Point(light) => light.sample_li(ctx, u, &(), PdfCoverage::Complete),
            Self::Spot(light) => light.sample_li(ctx, u, &(), PdfCoverage::Complete),
        }
    }

    /// What the tree knows of it.
    #[allow(dead_code, reason = "the build script asks, the firmware does not")]
    pub(crate) fn extent(&self) -> LightExtent {
        match self {
            Self::Triangle {
                shape,
                radiance,
                sides,
            } => LightExtent::Bounded(LightBounds {
                bounds: shape.bounds(),
                w: shape.normal_cone().w,
                phi: core::f32::consts::PI * shape.area() * radiance.max_element(),
                cos_theta_o: 1.0,
                cos_theta_e: 0.0,
                two_sided: *sides == Sides::Both,
            }),
            Self::Point(light) => light.extent(),
            Self::Spot(light) => light.extent(),
        }
    }
}
