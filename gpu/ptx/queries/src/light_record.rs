use bytemuck::{Pod, Zeroable};
use light_bounds::LightSampleContext;
use light_math::Frame;
use light_math::glam::{Affine3A, Mat3, Vec2, Vec3};
use light_sources::shape::{Rectangle, Shape, Sphere, Triangle};
use light_sources::{
    DistantLight, DistantLightDesc, IntensityAmount, IrradianceAmount, Light, LightLiSample,
    PdfCoverage, PointLight, PointLightDesc, RadianceAmount, Rgb, RigidTransform, SceneSphere,
    Sides, SpotLight, SpotLightDesc, UniformInfiniteLight, UniformInfiniteLightDesc,
};

use crate::random::Random;

/// A light as it lies in a buffer: 64 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct LightRecord {
    /// One of the constants below, and 8 for a surface that emits from both sides.
    pub kind: u32,
    /// Corners of a triangle; a corner and edges of a rectangle; position and axis.
    pub p: [[f32; 3]; 3],
    /// Radiance or intensity.
    pub emission: [f32; 3],
    /// Half angle of a spot and where its falloff begins, in radians; the radius of a sphere.
    pub sizes: [f32; 2],
    /// Nothing.
    pub unused: u32,
}

/// What [`LightRecord::kind`] adds for two sides.
const TWO_SIDED: u32 = 8;

/// The radius of the scene about the origin.
const SCENE_RADIUS: f32 = 4.0;

impl LightRecord {
    /// A point light.
    pub const POINT: u32 = 0;
    /// A spot.
    pub const SPOT: u32 = 1;
    /// A distant light.
    pub const DISTANT: u32 = 2;
    /// A uniform sky.
    pub const UNIFORM: u32 = 3;
    /// A triangle.
    pub const TRIANGLE: u32 = 4;
    /// A rectangle.
    pub const RECTANGLE: u32 = 5;
    /// A sphere.
    pub const SPHERE: u32 = 6;
    /// How many kinds there are.
    pub const KINDS: u32 = 7;

    /// A random light of a kind, in a cube of the edge 4 about the origin.
    #[must_use]
    pub fn random(kind: u32, random: &mut Random) -> Self {
        let mut vector = || Vec3::new(random.signed(), random.signed(), random.signed());
        let (place, mut a, mut b, emission) = (2.0 * vector(), vector(), vector(), vector() + 1.5);
        let angle = 0.1 + random.unit();
        if kind == Self::RECTANGLE {
            b = a.cross(b);
        } else if kind == Self::TRIANGLE {
            (a, b) = (place + a, place + b);
        }
        let sides = TWO_SIDED * u32::from(kind >= Self::TRIANGLE && random.unit() < 0.5);
        Self {
            kind: kind | sides,
            p: [place, a, b].map(|v| v.to_array()),
            emission: emission.to_array(),
            sizes: [angle, angle * random.unit()],
            unused: 0,
        }
    }

    /// As [`Light::sample_li`] of the light; `None` as well for a record that describes none.
    #[must_use]
    pub fn sample_li(&self, ctx: &LightSampleContext, u: Vec2) -> Option<LightLiSample<Vec3>> {
        let [a, b, c] = self.p.map(Vec3::from_array);
        let emission = Vec3::from_array(self.emission);
        let scene = SceneSphere::new(Vec3::ZERO, SCENE_RADIUS).ok()?;
        match self.kind % TWO_SIDED {
            Self::POINT => {
                let amount = IntensityAmount::Radiometric(1.0);
                arriving(
                    PointLight::<Rgb>::new(PointLightDesc::new(a, emission, amount)),
                    ctx,
                    u,
                )
            }
            Self::SPOT => {
                let axes = Frame::from_z(b.normalize());
                let axes = Mat3::from_cols(axes.x, axes.y, axes.z);
                let [angle, falloff_start] = self.sizes;
                let transform = Affine3A::from_mat3_translation(axes, a);
                let amount = IntensityAmount::Radiometric(1.0);
                let light = SpotLight::<Rgb>::new(SpotLightDesc {
                    falloff_start,
                    ..SpotLightDesc::new(transform, angle, emission, amount)
                });
                arriving(light, ctx, u)
            }
            Self::DISTANT => {
                let amount = IrradianceAmount::Radiometric(1.0);
                let desc = DistantLightDesc::new(b, emission, amount);
                arriving(DistantLight::<Rgb>::new(desc, scene), ctx, u)
            }
            Self::UNIFORM => {
                let amount = RadianceAmount::Radiometric(1.0);
                let desc = UniformInfiniteLightDesc::new(emission, amount);
                arriving(UniformInfiniteLight::<Rgb>::new(desc, scene), ctx, u)
            }
            Self::TRIANGLE => {
                let shape = Triangle::new([a, b, c], Triangle::DEFAULT_UV).ok()?;
                self.surface(&shape, ctx, u)
            }
            Self::RECTANGLE => self.surface(&Rectangle::new(a, [b, c]).ok()?, ctx, u),
            Self::SPHERE => {
                let transform = Affine3A::from_translation(a);
                let shape = Sphere::new(RigidTransform::new(transform).ok()?, self.sizes[0]);
                self.surface(&shape.ok()?, ctx, u)
            }
            _ => None,
        }
    }

    /// A surface of one colour. The area light of the crate needs an allocator for its textures.
    fn surface(
        &self,
        shape: &impl Shape,
        ctx: &LightSampleContext,
        u: Vec2,
    ) -> Option<LightLiSample<Vec3>> {
        let sides = if self.kind < TWO_SIDED {
            Sides::Front
        } else {
            Sides::Both
        };
        let sample = shape.sample_toward(ctx, u)?;
        let emits = sides.emit_toward(sample.at.n, -sample.wi);
        emits.then_some(LightLiSample {
            l: self.emission.into(),
            wi: sample.wi,
            pdf: sample.pdf,
            p_light: sample.at.p,
            n_light: sample.at.n,
            uv: sample.at.uv,
        })
    }
}

fn arriving<L: Light<Rgb>, E>(
    light: Result<L, E>,
    ctx: &LightSampleContext,
    u: Vec2,
) -> Option<LightLiSample<Vec3>> {
    light.ok()?.sample_li(ctx, u, &(), PdfCoverage::Complete)
}
