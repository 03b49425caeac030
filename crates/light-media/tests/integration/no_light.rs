//! Rays and points that no light reaches: the answers are exact, and nothing is asked of the scene
//! or of random numbers.

use light_bounds::LightId;
use light_math::Aabb;
use light_math::glam::{Affine3A, Vec2, Vec3};
use light_media::phase::Isotropic;
use light_media::{
    Homogeneous, Phase, Ray, Region, ScatteringPoint, Span, StepSize, Substance, Visibility,
    VolumeIntegrator, VolumeLight,
};
use light_samplers::UniformLightSampler;
use light_sources::{
    IntensityAmount, LightDesc, LightSet, LightSetBuilder, MediumInterface, PointLightDesc, Rgb,
    SceneSphere, SpotLightDesc,
};

/// A scene that must not be asked.
struct Untouched;

impl Visibility for Untouched {
    fn unoccluded(&self, from: Vec3, to: Vec3) -> bool {
        panic!("no light goes from {to} to {from}")
    }
}

fn fog(region: Region) -> Homogeneous<Rgb> {
    Homogeneous {
        substance: Substance::new(Vec3::splat(0.1), Vec3::splat(0.4), Vec3::ZERO).expect("valid"),
        phase: Phase::Isotropic(Isotropic),
        region,
    }
}

fn lights(desc: Option<LightDesc<Rgb>>) -> LightSet<Rgb> {
    let scene = SceneSphere::new(Vec3::ZERO, 10.0).expect("a sphere");
    let mut lights = LightSetBuilder::new(scene);
    if let Some(desc) = desc {
        lights.add(desc).expect("a light");
    }
    lights.build()
}

fn point(position: Vec3, intensity: f32) -> LightDesc<Rgb> {
    LightDesc::Point(PointLightDesc {
        position,
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(intensity),
        media: MediumInterface::default(),
    })
}

/// A spot above the origin that shines up.
fn spot() -> LightDesc<Rgb> {
    LightDesc::Spot(SpotLightDesc {
        transform: Affine3A::from_translation(Vec3::Z),
        angle: 0.5,
        falloff_start: 0.4,
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(1.0),
        media: MediumInterface::default(),
    })
}

const AT: ScatteringPoint = ScatteringPoint {
    p: Vec3::ZERO,
    wo: Vec3::NEG_Z,
};

fn integrator<'a, V>(
    medium: &'a Homogeneous<Rgb>,
    lights: &'a LightSet<Rgb>,
    sampler: &'a UniformLightSampler,
    scene: &'a V,
) -> VolumeIntegrator<'a, Rgb, Homogeneous<Rgb>, UniformLightSampler, V> {
    let step = StepSize::new(0.5).expect("positive");
    VolumeIntegrator {
        medium,
        lights,
        sampler,
        scene,
        wavelengths: &(),
        step,
        shadow_step: step,
    }
}

#[test]
fn a_ray_beside_the_medium_sees_nothing_of_it() {
    let far = Aabb::new(Vec3::splat(10.0), Vec3::splat(11.0));
    let medium = fog(Region::new(far, Affine3A::IDENTITY).expect("a box"));
    let (lights, sampler) = (
        lights(Some(point(Vec3::Y, 1.0))),
        UniformLightSampler::new(1),
    );
    let integrator = integrator(&medium, &lights, &sampler, &Untouched);
    let ray = Ray {
        o: Vec3::ZERO,
        d: Vec3::X,
    };
    let span = Span { t0: 0.0, t1: 5.0 };
    let mut none = || -> f32 { panic!("no random number is needed") };
    let seen = [
        integrator.next_event(&ray, span, 4, 1, &mut none),
        integrator.single_scattering(&ray, span, 1, &mut none),
    ];
    assert_eq!(seen, [VolumeLight::vacuum(); 2], "next event, marched");
}

#[test]
fn missing_lights_and_lights_that_face_away_scatter_nothing() {
    let medium = fog(Region::UNBOUNDED);
    let mut none = || -> f32 { panic!("no random number is needed") };
    for (desc, count, what) in [
        (None, 0, "no light to choose"),
        (None, 1, "a light that the set does not hold"),
        (Some(spot()), 1, "a spot that shines away"),
    ] {
        let (lights, sampler) = (lights(desc), UniformLightSampler::new(count));
        let integrator = integrator(&medium, &lights, &sampler, &Untouched);
        let found = integrator.in_scattered(AT, 1 << 63, Vec2::splat(0.5), &mut none);
        assert_eq!(found, Vec3::ZERO, "{what}");
    }
}

/// So near that the squared distance is no float, a light has no direction.
#[test]
fn a_light_at_the_point_itself() {
    let medium = fog(Region::UNBOUNDED);
    for (distance, intensity) in [(1e-23, 1e-30f32), (0.0, 1.0)] {
        let lights = lights(Some(point(Vec3::Z * distance, intensity)));
        let sampler = UniformLightSampler::new(1);
        let integrator = integrator(&medium, &lights, &sampler, &Untouched);
        let found = integrator.scattered_from(LightId(0), AT, Vec2::ZERO, &mut || 0.5);
        assert_eq!(found, Vec3::ZERO, "{distance}");
    }
}
