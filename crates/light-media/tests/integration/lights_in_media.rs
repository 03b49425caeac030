//! Light from lights of every kind, scattered at one point: closed forms and quadrature, with and
//! without the weights of multiple importance sampling.

use light_math::glam::{Affine3A, Vec3};
use light_media::PhaseFunction;
use light_media::phase::HenyeyGreenstein;
use light_media::{
    FirstHit, Homogeneous, Intersection, Phase, Region, ScatteringNumbers, ScatteringPoint,
    StepSize, Substance, Visibility, VolumeIntegrator,
};
use light_samplers::{LightSampler, PowerLightSampler, UniformLightSampler};
use light_sources::shape::ShapeDesc;
use light_sources::{
    AreaLightDesc, DiffuseEmissionDesc, DistantLightDesc, IntensityAmount, IrradianceAmount,
    LightDesc, LightSet, LightSetBuilder, MediumInterface, PointLightDesc, RadianceAmount, Rgb,
    SceneSphere, SurfaceColor, UniformInfiniteLightDesc,
};
use light_testkit::{Cap, Estimate, Rng};

use crate::support::ball::{Ball, CENTRE, RADIUS};

const HALF_SIZE: f32 = 4.0;
const G: f32 = 0.5;
const AT: ScatteringPoint = ScatteringPoint {
    p: Vec3::new(0.1, -0.2, 0.3),
    wo: Vec3::NEG_Z,
};

/// A scene that is empty, or dark in all directions.
struct Emptiness(FirstHit);

impl Visibility for Emptiness {
    fn unoccluded(&self, _from: Vec3, _to: Vec3) -> bool {
        self.0 == FirstHit::Nothing
    }
}

impl Intersection for Emptiness {
    fn first(&self, _from: Vec3, _wi: Vec3) -> FirstHit {
        self.0
    }
}

fn phase() -> HenyeyGreenstein {
    HenyeyGreenstein::new(G).expect("in range")
}

/// Extinction 0.25 in a box, so that light from the sky comes in.
fn fog() -> Homogeneous<Rgb> {
    Homogeneous {
        substance: Substance::new(Vec3::splat(0.05), Vec3::splat(0.2), Vec3::ZERO).expect("valid"),
        phase: Phase::HenyeyGreenstein(phase()),
        region: Region::new(
            light_math::Aabb::new(Vec3::splat(-HALF_SIZE), Vec3::splat(HALF_SIZE)),
            Affine3A::IDENTITY,
        )
        .expect("a box"),
    }
}

/// How much of the light from far away in the direction `wi` is left.
fn left_from_afar(wi: Vec3) -> f64 {
    let to_wall = |i: usize| (HALF_SIZE.copysign(wi[i]) - AT.p[i]) / wi[i];
    let t = (0..3).map(to_wall).fold(f32::INFINITY, f32::min);
    (-0.25 * f64::from(t)).exp()
}

fn value(wi: Vec3) -> f64 {
    phase().value(-AT.wo.dot(wi)).into()
}

fn lights(descs: impl IntoIterator<Item = LightDesc<Rgb>>) -> LightSet<Rgb> {
    let scene = SceneSphere::new(Vec3::ZERO, 10.0).expect("a sphere");
    let mut lights = LightSetBuilder::new(scene);
    for desc in descs {
        lights.add(desc).expect("a light");
    }
    lights.build()
}

fn estimate<S: LightSampler, V: Intersection>(
    lights: &LightSet<Rgb>,
    sampler: &S,
    scene: &V,
    samples: u32,
) -> [Estimate; 2] {
    let step = StepSize::new(0.5).expect("positive");
    let fog = fog();
    let integrator = VolumeIntegrator {
        medium: &fog,
        lights,
        sampler,
        scene,
        wavelengths: &(),
        step,
        shadow_step: step,
    };
    let mut rng = Rng::new(31);
    [false, true].map(|mis| {
        Estimate::of(samples, || {
            let numbers = ScatteringNumbers {
                light: rng.u64(),
                point: rng.vec2(),
                direction: rng.vec2(),
            };
            let mut next_u = || rng.f32();
            let l = if mis {
                integrator.in_scattered_mis(AT, numbers, &mut next_u)
            } else {
                integrator.in_scattered(AT, numbers.light, numbers.point, &mut next_u)
            };
            l.x.into()
        })
    })
}

fn point() -> (LightDesc<Rgb>, Vec3) {
    let position = Vec3::new(1.5, 1.0, 0.4);
    let desc = PointLightDesc {
        position,
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(5.0),
        media: MediumInterface::default(),
    };
    (LightDesc::Point(desc), position)
}

/// No other strategy finds a Dirac light, so its samples count in full, and there is no noise in
/// them.
#[test]
fn dirac_lights_have_closed_forms() {
    let (point, position) = point();
    let to = position - AT.p;
    let d = f64::from(to.length());
    let of_point = value(to.normalize()) * 5.0 / (d * d) * (-0.25 * d).exp();

    let direction = Vec3::new(0.3, 0.5, 0.8).normalize();
    let distant = LightDesc::Distant(DistantLightDesc {
        direction,
        emission: Vec3::ONE,
        amount: IrradianceAmount::Radiometric(2.0),
    });
    let of_distant = value(direction) * 2.0 * left_from_afar(direction);

    for (what, desc, truth) in [("point", point, of_point), ("distant", distant, of_distant)] {
        let lights = lights([desc]);
        let sampler = UniformLightSampler::new(1);
        for found in estimate(&lights, &sampler, &Emptiness(FirstHit::Nothing), 64) {
            assert!(
                (found.mean / truth - 1.0).abs() < 1e-5 && found.standard_error < 1e-6 * truth,
                "{what}: {found:?}, {truth}"
            );
        }
        for found in estimate(&lights, &sampler, &Emptiness(FirstHit::Dark), 64) {
            assert_eq!(found.mean, 0.0, "{what}: in the dark");
        }
    }
}

/// An occluder behind the point blocks samples of the phase function, not of the light.
struct DarkBehind;

impl Visibility for DarkBehind {
    fn unoccluded(&self, _from: Vec3, _to: Vec3) -> bool {
        true
    }
}

impl Intersection for DarkBehind {
    fn first(&self, _from: Vec3, _wi: Vec3) -> FirstHit {
        FirstHit::Dark
    }
}

#[test]
fn what_is_dark_takes_nothing_from_the_light() {
    let (desc, position) = point();
    let lights = lights([desc]);
    let to = position - AT.p;
    let d = f64::from(to.length());
    let truth = value(to.normalize()) * 5.0 / (d * d) * (-0.25 * d).exp();
    for found in estimate(&lights, &UniformLightSampler::new(1), &DarkBehind, 16) {
        assert!(
            (found.mean / truth - 1.0).abs() < 1e-5,
            "{found:?}, {truth}"
        );
    }
}

/// A ball and a sky, each chosen with another probability than the other: both estimates have the
/// mean that quadrature gives. A probability that is missing in either weight of a pair of samples
/// would show.
#[test]
fn weighted_samples_of_lights_and_of_the_phase_function_add_up() {
    let color = SurfaceColor::Uniform(Vec3::splat(3.0));
    let ball = LightDesc::Area(AreaLightDesc {
        shape: ShapeDesc::Sphere {
            transform: Affine3A::from_translation(CENTRE),
            radius: RADIUS,
        },
        emission: DiffuseEmissionDesc::new(color, RadianceAmount::default()),
    });
    let sky = LightDesc::UniformInfinite(UniformInfiniteLightDesc {
        emission: Vec3::splat(2.0),
        amount: RadianceAmount::default(),
    });
    let lights = lights([ball, sky]);
    let to = CENTRE - AT.p;
    let half = f64::from(RADIUS / to.length()).asin();
    let of_ball = Cap::new(to, half).integrate(1e-5, |wi| {
        let t = Ball::distance(AT.p, wi).unwrap_or_default();
        3.0 * value(wi) * (-0.25 * f64::from(t)).exp()
    });
    let of_sky = Cap::new(-to, core::f64::consts::PI - half)
        .integrate(1e-5, |wi| 2.0 * value(wi) * left_from_afar(wi));
    let truth = of_ball + of_sky;
    for powers in [[0.2, 0.8], [0.85, 0.15]] {
        let sampler = PowerLightSampler::new(&powers).expect("powers");
        for found in estimate(&lights, &sampler, &Ball, 1 << 17) {
            assert!(
                found.agrees_with(truth),
                "chosen by {powers:?}: {found:?}, {truth}"
            );
        }
    }
}
