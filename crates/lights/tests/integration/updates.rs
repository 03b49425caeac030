//! A sampler that is refitted to lights that changed keeps its promises, and weighs lights at
//! infinity as a new one does.

use lights::bounds::{LightId, LightSampleContext};
use lights::glam::{Affine3A, Vec3};
use lights::math::fraction::stratum;
use lights::samplers::{BvhLightSampler, LightSampler};
use lights::sources::*;

fn lamp(position: Vec3, intensity: f32) -> LightDesc<Rgb> {
    let amount = IntensityAmount::Radiometric(intensity);
    PointLightDesc::new(position, Vec3::ONE, amount).into()
}

fn sun(direction: Vec3, irradiance: f32) -> LightDesc<Rgb> {
    let amount = IrradianceAmount::Radiometric(irradiance);
    DistantLightDesc::new(direction, Vec3::ONE, amount).into()
}

fn sky(angle: f32) -> LightDesc<Rgb> {
    let texels = [0.1, 0.5, 0.2, 0.9];
    let image = Image::from_f32([2, 2], Channels::Gray, texels).expect("an image");
    LightDesc::ImageInfinite(ImageInfiniteLightDesc {
        transform: Affine3A::from_rotation_x(angle),
        map: EnvironmentMap::EqualArea(image),
        amount: RadianceAmount::default(),
    })
}

#[test]
fn a_refitted_sampler_follows_updates() {
    let scene = SceneSphere::new(Vec3::ZERO, 10.0).expect("a sphere");
    let mut builder = LightSetBuilder::<Rgb>::new(scene);
    let mut add = |desc| builder.add(desc).expect("a light");
    let (turning, moving) = (add(sky(0.0)), add(lamp(Vec3::Y, 1.0)));
    for x in 0..50u8 {
        add(lamp(Vec3::new(x.into(), 1.0, 3.0), 1.0));
    }
    let setting = add(sun(Vec3::Y, 1.0));
    let mut lights = builder.build();
    let mut extents = lights.extents();
    let mut refitted = BvhLightSampler::new(&extents).expect("bounds");

    for step in 0..6u8 {
        let t = f32::from(step);
        // The sun is off for two steps.
        let irradiance = if step / 2 == 1 { 0.0 } else { 0.5 };
        let changes = [
            (moving, lamp(Vec3::new(4.0 * t, 2.0, 0.0), 5.0)),
            (turning, sky(t)),
            (setting, sun(Vec3::new(t, 1.0, 0.0), irradiance)),
        ];
        for (source, desc) in changes {
            lights.update(source, desc).expect("the same kind");
        }
        lights.extents_into(&mut extents);
        refitted.refit(&extents).expect("as many lights");
        let built = BvhLightSampler::new(&extents).expect("bounds");
        let floor = LightSampleContext::surface(Vec3::new(t, 0.0, 0.0), Vec3::Y, Vec3::Y);
        let pmf = |sampler: &BvhLightSampler, id| sampler.pmf(&floor, id);
        let total: f32 = lights.iter().map(|(id, _)| pmf(&refitted, id)).sum();
        assert!((total - 1.0).abs() < 1e-4, "{total} in step {step}");
        let is_lit = pmf(&refitted, LightId(52)) > 0.0;
        assert_eq!(is_lit, irradiance > 0.0, "the sun in step {step}");
        // The tree's estimates differ after a refit, those of the sky and the sun do not.
        let infinite = |sampler| {
            let pmfs = lights.infinite_ids().map(|id| pmf(sampler, id));
            let total: f32 = pmfs.clone().sum();
            (total, pmfs.map(|pmf| pmf / total).collect::<Vec<_>>())
        };
        let ((total, refitted_shares), (_, built_shares)) = (infinite(&refitted), infinite(&built));
        for (refitted, built) in refitted_shares.into_iter().zip(built_shares) {
            // Before they are divided they are whole parts of 2^16, one for each given in advance.
            let close = (refitted - built).abs() < 4.0 / 65536.0 / total;
            assert!(close, "{refitted} refitted, {built} built in step {step}");
        }
        for i in 0..64 {
            let u = stratum(i, 64, 1 << 63);
            if let Some(choice) = refitted.sample(&floor, u) {
                assert_eq!(
                    choice.pmf,
                    pmf(&refitted, choice.light),
                    "{u} in step {step}"
                );
            }
        }
    }
}
