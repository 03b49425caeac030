//! The queries that samplers and scenes receive.

use core::cell::RefCell;

use light_bounds::{LightId, LightSampleContext, SampledLight};
use light_math::Aabb;
use light_math::glam::{Affine3A, Vec2, Vec3};
use light_media::{
    Homogeneous, Region, ScatteringPoint, Span, StepSize, Visibility, VolumeIntegrator,
};
use light_samplers::{LightChoices, LightSampler};
use light_sources::{
    LightDesc, LightSetBuilder, RadianceAmount, Rgb, SceneSphere, UniformInfiniteLightDesc,
};

use super::{NothingInTheWay, RAY, TWO, lights, medium};

/// Records the contexts of its queries, and chooses no light.
#[derive(Default)]
struct Recorder(RefCell<Vec<LightSampleContext>>);

impl LightSampler for Recorder {
    fn sample(&self, ctx: &LightSampleContext, _u: u64) -> Option<SampledLight> {
        self.0.borrow_mut().push(*ctx);
        None
    }

    fn pmf(&self, _ctx: &LightSampleContext, _light: LightId) -> f32 {
        0.0
    }

    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        LightChoices::one_by_one(self, ctx, count)
    }

    fn sample_emitter(&self, _u: u64) -> Option<SampledLight> {
        None
    }

    fn pmf_emitter(&self, _light: LightId) -> f32 {
        0.0
    }
}

/// Lights are chosen for the part of the ray that lies in the medium; without an end, for what can
/// be seen of it.
#[test]
fn lights_are_chosen_for_the_part_of_the_ray_in_the_medium() {
    let endless = Span {
        t0: 0.5,
        t1: f32::INFINITY,
    };
    let slab = Aabb::new(Vec3::new(2.0, -1.0, -1.0), Vec3::new(5.0, 1.0, 1.0));
    let slab = Region::new(slab, Affine3A::IDENTITY).expect("a box");
    let most = StepSize::MAX_STEPS as f32;
    for (sigma, region, start, length) in [
        (0.3, slab, 2.0, 3.0),
        // Twenty mean free paths, but no more than so many steps.
        (2.0, Region::UNBOUNDED, 0.5, 10.0),
        (1e-20, Region::UNBOUNDED, 0.5, most),
        (0.0, Region::UNBOUNDED, 0.5, most),
        (-0.0, Region::UNBOUNDED, 0.5, most),
    ] {
        let medium = Homogeneous {
            region,
            ..medium(sigma, sigma * 0.0, 0.0)
        };
        let sampler = Recorder::default();
        let step = StepSize::new(1.0).expect("positive");
        let integrator = VolumeIntegrator {
            medium: &medium,
            lights: &lights(&TWO),
            sampler: &sampler,
            scene: &NothingInTheWay,
            wavelengths: &(),
            step,
            shadow_step: step,
        };
        integrator.next_event(&RAY, endless, 3, 1, &mut || 0.5);
        let expected = LightSampleContext::segment(RAY.at(start), RAY.d * length);
        let asked = sampler.0.into_inner();
        assert_eq!(asked, [expected; 3], "{sigma}: {start} + {length}");
    }
}

/// A dark light costs neither a shadow ray nor a transmittance.
#[test]
fn dark_lights_cause_no_query_of_the_scene() {
    struct Nobody;
    impl Visibility for Nobody {
        fn unoccluded(&self, _from: Vec3, _to: Vec3) -> bool {
            panic!("nobody is asked")
        }
    }
    let scene = SceneSphere::new(Vec3::ZERO, 10.0).expect("a sphere");
    let mut lights = LightSetBuilder::<Rgb>::new(scene);
    let sky = UniformInfiniteLightDesc {
        emission: Vec3::ZERO,
        amount: RadianceAmount::default(),
    };
    lights.add(LightDesc::UniformInfinite(sky)).expect("a sky");
    let step = StepSize::new(1.0).expect("positive");
    let integrator = VolumeIntegrator {
        medium: &medium(0.1, 0.3, 0.0),
        lights: &lights.build(),
        sampler: &Recorder::default(),
        scene: &Nobody,
        wavelengths: &(),
        step,
        shadow_step: step,
    };
    let at = ScatteringPoint {
        p: Vec3::ZERO,
        wo: Vec3::NEG_X,
    };
    let mut none = || -> f32 { panic!("no random number is needed") };
    let light = integrator.scattered_from(LightId(0), at, Vec2::ZERO, &mut none);
    assert_eq!(light, Vec3::ZERO, "dark");
}
