//! Next-event scattering along a ray: unequal lights, emission, opaque media, the gain by
//! stratification, and its queries of samplers and scenes.

#![expect(clippy::cast_possible_truncation, reason = "quadrature in f64")]

mod estimates;
mod queries;

use light_math::glam::Vec3;
use light_media::phase::Isotropic;
use light_media::{Homogeneous, Phase, Ray, Region, Substance, Visibility};
use light_sources::{
    IntensityAmount, LightDesc, LightSet, LightSetBuilder, MediumInterface, PointLightDesc, Rgb,
    SceneSphere,
};

const RAY: Ray = Ray {
    o: Vec3::ZERO,
    d: Vec3::X,
};

struct NothingInTheWay;

impl Visibility for NothingInTheWay {
    fn unoccluded(&self, _from: Vec3, _to: Vec3) -> bool {
        true
    }
}

fn medium(sigma_a: f32, sigma_s: f32, le: f32) -> Homogeneous<Rgb> {
    let [sigma_a, sigma_s, le] = [sigma_a, sigma_s, le].map(Vec3::splat);
    Homogeneous {
        substance: Substance::new(sigma_a, sigma_s, le).expect("valid"),
        phase: Phase::Isotropic(Isotropic),
        region: Region::UNBOUNDED,
    }
}

fn lights(points: &[(Vec3, f32)]) -> LightSet<Rgb> {
    let scene = SceneSphere::new(Vec3::ZERO, 10.0).expect("a sphere");
    let mut lights = LightSetBuilder::new(scene);
    for &(position, intensity) in points {
        let desc = PointLightDesc {
            position,
            emission: Vec3::ONE,
            amount: IntensityAmount::Radiometric(intensity),
            media: MediumInterface::default(),
        };
        lights.add(LightDesc::Point(desc)).expect("a light");
    }
    lights.build()
}

const TWO: [(Vec3, f32); 2] = [
    (Vec3::new(0.5, 1.0, 0.0), 4.0),
    (Vec3::new(2.5, -0.6, 0.3), 1.0),
];
