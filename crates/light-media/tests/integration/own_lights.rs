//! Lights of other types in media: scattered light is that of the lights which they repeat.

use light_math::glam::{Affine3A, Quat, Vec3};
use light_media::phase::HenyeyGreenstein;
use light_media::{
    FirstHit, Homogeneous, Intersection, Phase, Ray, Region, ScatteringNumbers, ScatteringPoint,
    Span, StepSize, Substance, Visibility, VolumeIntegrator,
};
use light_samplers::BvhLightSampler;
use light_sources::shape::ShapeDesc;
use light_sources::{
    AreaLightDesc, DiffuseEmissionDesc, IntensityAmount, LightDesc, LightRef, LightSet,
    LightSetBuilder, PointLightDesc, RadianceAmount, Rgb, SceneSphere, SpotLightDesc, SurfaceColor,
    UniformInfiniteLightDesc,
};
use light_testkit::{Rng, own_twin};

const RAY: Ray = Ray {
    o: Vec3::new(-3.0, 0.1, 0.0),
    d: Vec3::X,
};

/// Rays hit the lights of a set, which say themselves where.
struct Lights<'a>(&'a LightSet<Rgb>);

impl Visibility for Lights<'_> {
    fn unoccluded(&self, from: Vec3, to: Vec3) -> bool {
        let distance = (to - from).length();
        match self.first(from, (to - from) / distance) {
            FirstHit::Light(_, at) => at.p.distance(from) > 0.999 * distance,
            _ => true,
        }
    }
}

impl Intersection for Lights<'_> {
    fn first(&self, from: Vec3, wi: Vec3) -> FirstHit {
        let hits = self.0.iter().filter_map(|(id, light)| {
            let at = light.hit(from, wi)?;
            Some((id, at, at.p.distance(from)))
        });
        match hits.min_by(|(_, _, a), (_, _, b)| a.total_cmp(b)) {
            Some((id, at, _)) => FirstHit::Light(id, at),
            None => FirstHit::Nothing,
        }
    }
}

fn scene() -> SceneSphere {
    SceneSphere::new(Vec3::ZERO, 10.0).expect("a sphere")
}

/// A lamp, a spot, a ball and a sky, as a set has them and as own lights.
fn pair() -> [LightSet<Rgb>; 2] {
    let amount = IntensityAmount::Radiometric(3.0);
    let (lamp, above) = (Vec3::new(1.0, 1.0, 0.5), Vec3::new(-1.0, 2.0, 0.0));
    let down = Quat::from_rotation_arc(Vec3::Z, Vec3::NEG_Y);
    let down = Affine3A::from_rotation_translation(down, above);
    let ball = ShapeDesc::Sphere {
        transform: Affine3A::from_translation(Vec3::new(0.5, -1.0, 0.4)),
        radius: 0.6,
    };
    let color = SurfaceColor::Uniform(Vec3::new(1.0, 0.5, 0.25));
    let emission = DiffuseEmissionDesc::new(color, RadianceAmount::Radiometric(2.0));
    let descs: [LightDesc<Rgb>; 4] = [
        PointLightDesc::new(lamp, Vec3::ONE, amount).into(),
        SpotLightDesc::new(down, 0.5, Vec3::ONE, amount).into(),
        AreaLightDesc::new(ball, emission).into(),
        UniformInfiniteLightDesc::new(Vec3::Z, RadianceAmount::Radiometric(0.2)).into(),
    ];
    let build = |descs: Vec<LightDesc<Rgb>>| {
        let mut builder = LightSetBuilder::new(scene());
        for desc in descs {
            builder.add(desc).expect("a light");
        }
        builder.build()
    };
    let twin = |desc: &LightDesc<Rgb>| own_twin(desc.clone(), scene()).expect("a light").into();
    let own = build(descs.iter().map(twin).collect());
    let is_own = own
        .iter()
        .all(|(_, light)| matches!(light, LightRef::Own(_)));
    assert!(is_own, "all of them");
    [build(descs.into()), own]
}

fn fog() -> Homogeneous<Rgb> {
    let half = Vec3::splat(4.0);
    let around = light_math::Aabb::new(-half, half);
    Homogeneous {
        substance: Substance::new(Vec3::splat(0.05), Vec3::splat(0.2), Vec3::ZERO).expect("valid"),
        phase: Phase::HenyeyGreenstein(HenyeyGreenstein::new(0.4).expect("in range")),
        region: Region::new(around, Affine3A::IDENTITY).expect("a box"),
    }
}

/// Light of every integrator, of 16 seeds each.
fn scattered(lights: &LightSet<Rgb>) -> [Vec<Vec3>; 3] {
    let (medium, scene) = (fog(), Lights(lights));
    let sampler = BvhLightSampler::new(&lights.extents()).expect("valid bounds");
    let step = StepSize::new(0.25).expect("a step");
    let integrator = VolumeIntegrator::<Rgb, _, _, _> {
        medium: &medium,
        lights,
        sampler: &sampler,
        scene: &scene,
        wavelengths: &(),
        step,
        shadow_step: step,
    };
    let span = Span::new(0.0, 6.0).expect("a span");
    let marched = (0..16).map(|seed| {
        let mut rng = Rng::new(seed);
        let seed = rng.u32();
        integrator
            .single_scattering(&RAY, span, seed, &mut || rng.f32())
            .l
    });
    let next_event = (0..16).map(|seed| {
        let mut rng = Rng::new(seed);
        let seed = rng.u32();
        integrator
            .next_event(&RAY, span, 8, seed, &mut || rng.f32())
            .l
    });
    let both_ways = (0..16).map(|seed| {
        let mut rng = Rng::new(seed);
        let at = ScatteringPoint {
            p: Vec3::new(0.3, 0.1, 0.0),
            wo: -RAY.d,
        };
        let mut sum = Vec3::ZERO;
        for _ in 0..64 {
            let numbers = ScatteringNumbers {
                light: rng.u64(),
                point: rng.vec2(),
                direction: rng.vec2(),
            };
            sum += integrator.in_scattered_mis(at, numbers, &mut || rng.f32());
        }
        sum / 64.0
    });
    [marched.collect(), next_event.collect(), both_ways.collect()]
}

#[test]
fn own_lights_scatter_as_their_twins() {
    let [plain, own] = pair();
    let expected = scattered(&plain);
    for values in &expected {
        assert!(values.iter().all(|l| l.min_element() > 0.0), "{values:?}");
    }
    assert_eq!(scattered(&own), expected, "bit for bit");
}

/// Rays that the phase function sends out find own lights: without these the mean is another.
#[test]
fn own_balls_and_skies_are_found_by_rays() {
    let [_, own] = pair();
    let scene = Lights(&own);
    let mut rng = Rng::new(81);
    let p = Vec3::new(0.3, 0.1, 0.0);
    let mut found = [0; 2];
    for _ in 0..2000 {
        let wi = rng.direction();
        match scene.first(p, wi) {
            FirstHit::Light(id, at) => {
                let light = own.get(id).expect("a light of the set");
                found[0] += u32::from(light.l(&at, -wi, &()) != Vec3::ZERO);
            }
            _ => {
                let skies = own.infinite_ids().filter_map(|id| own.get(id));
                let mut sky = skies.map(|light| light.le(p, wi, &()));
                found[1] += u32::from(sky.any(|le| le != Vec3::ZERO));
            }
        }
    }
    assert!(found[0] > 50 && found[0] + found[1] == 2000, "{found:?}");
}
