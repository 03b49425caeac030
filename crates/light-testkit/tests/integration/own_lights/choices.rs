use light_bounds::{LightExtent, LightSampleContext};
use light_math::glam::{Affine3A, Quat, Vec2, Vec3};
use light_samplers::{
    BvhLightSampler, ExhaustiveLightSampler, LightSampler, PowerLightSampler,
    ReferenceBvhLightSampler,
};
use light_sets::SetLight;
use light_sources::shape::ShapeDesc;
use light_sources::*;
use light_testkit::laws::sampler::*;
use light_testkit::laws::several_choices_follow_their_pmf;
use light_testkit::{Emitter, Rng, SamplerCase, own_twin};

use super::lantern::Lantern;
use super::scene;

/// Kinds of the set beside lanterns, which are own lights.
fn case() -> SamplerCase {
    let mut rng = Rng::new(71);
    let mut place = || 6.0 * (rng.vec3() - 0.5);
    let mut emitters = Vec::new();
    for i in 0..6u8 {
        let (p, intensity) = (place(), 1.0 + f32::from(i));
        emitters.push(Emitter::Set(SetLight::Point { p, intensity }));
        emitters.push(Emitter::Lantern {
            position: place(),
            axis: place().normalize(),
            beam: 20.0,
            stray: 0.1,
            cos_beam: 0.7,
        });
        let corner = place();
        emitters.push(Emitter::Set(SetLight::Triangle {
            vertices: [corner, corner + Vec3::X, corner + 0.5 * place()],
            radiance: 3.0,
            two_sided: i % 2 == 0,
        }));
    }
    emitters.push(Emitter::Sky { radiance: 0.05 });
    emitters.push(Emitter::Sun {
        wi: Vec3::new(0.6, 0.0, 0.8),
        irradiance: 0.5,
    });
    SamplerCase::new("own lights beside others", emitters, 24, 72)
}

/// The set of these lights. Every second light that no own type describes is an own light too,
/// which answers what that light does.
fn set(case: &SamplerCase) -> LightSet<Rgb> {
    let mut builder = LightSetBuilder::new(scene());
    for (i, emitter) in case.emitters.iter().enumerate() {
        let desc = described(emitter);
        let is_mesh = matches!(desc, LightDesc::Mesh(_) | LightDesc::Own(_));
        let desc = if i % 2 == 0 && !is_mesh {
            own_twin(desc, scene()).expect("a light").into()
        } else {
            desc
        };
        builder.add(desc).expect("a light");
    }
    builder.build()
}

fn described(emitter: &Emitter) -> LightDesc<Rgb> {
    let radiometric = RadianceAmount::Radiometric;
    match *emitter {
        Emitter::Set(SetLight::Point { p, intensity }) => {
            PointLightDesc::new(p, Vec3::ONE, IntensityAmount::Radiometric(intensity)).into()
        }
        Emitter::Set(SetLight::Triangle {
            vertices,
            radiance,
            two_sided,
        }) => {
            let color = SurfaceColor::Uniform(Vec3::ONE);
            let sides = if two_sided { Sides::Both } else { Sides::Front };
            let emission = DiffuseEmissionDesc {
                sides,
                ..DiffuseEmissionDesc::new(color, radiometric(radiance))
            };
            MeshLightDesc::new(vertices, vec![[0, 1, 2]], emission).into()
        }
        Emitter::Set(SetLight::Spot { .. }) => unreachable!("the case has none"),
        Emitter::Lantern { .. } => Lantern::own(emitter).expect("a lantern").into(),
        Emitter::Sky { radiance } => {
            UniformInfiniteLightDesc::new(Vec3::ONE, radiometric(radiance)).into()
        }
        Emitter::Sun { wi, irradiance } => {
            let amount = IrradianceAmount::Radiometric(irradiance);
            DistantLightDesc::new(wi, Vec3::ONE, amount).into()
        }
    }
}

fn obeys(sampler: &impl LightSampler) {
    let case = case();
    sampled_pmf_is_the_queried_pmf(&case, sampler);
    pmfs_and_none_sum_to_one(&case, sampler);
    contributing_lights_can_be_chosen(&case, sampler);
    unknown_lights_have_no_pmf(&case, sampler);
    frequencies_match_and_u_stays_uniform(&case, sampler);
    several_choices_follow_their_pmf(&case, sampler);
    invalid_queries_do_not_panic(&case, sampler);
}

#[test]
fn own_lights_are_chosen_by_the_laws() {
    let set = set(&case());
    let owns = || set.iter().filter(|(_, l)| matches!(l, LightRef::Own(_)));
    let lobes = owns().filter(|(_, l)| matches!(l.extent(), LightExtent::Lobe(..)));
    assert_eq!((owns().count(), lobes.count()), (10, 6), "of 20 lights");
    let (extents, powers) = (set.extents(), set.powers());
    obeys(&BvhLightSampler::new(&extents).expect("valid bounds"));
    obeys(&ReferenceBvhLightSampler::new(&extents).expect("valid bounds"));
    obeys(&ExhaustiveLightSampler::new(&extents).expect("valid bounds"));
    obeys(&PowerLightSampler::new(&powers).expect("valid powers"));
}

/// Points, spots, balls and skies, each third a mesh, as a set has them and as own lights.
fn pair() -> [LightSet<Rgb>; 2] {
    let amount = IntensityAmount::Radiometric(2.0);
    let emission = || {
        let color = SurfaceColor::Uniform(Vec3::new(1.0, 0.5, 0.25));
        DiffuseEmissionDesc::new(color, RadianceAmount::Radiometric(3.0))
    };
    let mut builders = [0, 1].map(|_| LightSetBuilder::new(scene()));
    let mut rng = Rng::new(73);
    let mut add = |desc: LightDesc<Rgb>| {
        let twin = match &desc {
            LightDesc::Mesh(_) => desc.clone(),
            _ => own_twin(desc.clone(), scene()).expect("a light").into(),
        };
        for (builder, desc) in builders.iter_mut().zip([desc, twin]) {
            builder.add(desc).expect("a light");
        }
    };
    for _ in 0..40 {
        let (p, turn) = (6.0 * (rng.vec3() - 0.5), rng.direction());
        let turn = Quat::from_rotation_arc(Vec3::Z, turn);
        let transform = Affine3A::from_rotation_translation(turn, p);
        let (radius, corners) = (0.2, [p, p + Vec3::X, p + Vec3::Y]);
        add(PointLightDesc::new(p, Vec3::ONE, amount).into());
        add(SpotLightDesc::new(transform, 0.8, Vec3::ONE, amount).into());
        add(AreaLightDesc::new(ShapeDesc::Sphere { transform, radius }, emission()).into());
        add(MeshLightDesc::new(corners, vec![[0, 1, 2]], emission()).into());
    }
    add(UniformInfiniteLightDesc::new(Vec3::Z, RadianceAmount::Radiometric(0.1)).into());
    builders.map(LightSetBuilder::build)
}

/// Through set and hierarchy an own light gives the irradiance that the light it repeats gives.
#[test]
fn irradiance_by_own_lights_is_that_of_their_twins() {
    let irradiance = |set: &LightSet<Rgb>| {
        let sampler = BvhLightSampler::new(&set.extents()).expect("valid bounds");
        let mut rng = Rng::new(74);
        let values = (0..64).map(|_| {
            let (p, n) = (8.0 * (rng.vec3() - 0.5), rng.direction());
            let ctx = LightSampleContext::surface(p, n, n);
            let mut sum = Vec3::ZERO;
            for choice in sampler.at(&ctx, 16).samples(rng.u64()) {
                let u: Vec2 = rng.vec2();
                let light = set.get(choice.light).expect("a light of the set");
                if let Some(li) = light.sample_li(&ctx, u, &(), PdfCoverage::Complete) {
                    sum += li.l * (li.wi.dot(n).max(0.0) / (li.pdf * choice.pmf));
                }
            }
            sum / 16.0
        });
        values.collect::<Vec<_>>()
    };
    let [plain, own] = pair();
    let expected = irradiance(&plain);
    assert!(
        expected.iter().filter(|e| **e != Vec3::ZERO).count() > 60,
        "{expected:?}"
    );
    assert_eq!(irradiance(&own), expected, "bit for bit");
}
