//! Lights give the samples, densities and extents that they gave before, with software float
//! functions on every target.
//!
//! A change that moves them is *value-breaking* and says so in the changelog. The new table is what
//! the failed test prints: `cargo test -p light-sources --features libm --test integration
//! value_stability::`.

use core::f32::consts::FRAC_PI_2;

use light_sources::glam::{Affine3A, Vec2, Vec3};
use light_sources::light_bounds::{LightExtent, LightSampleContext};
use light_sources::light_math::spectrum::photometric::{Lumen, Lux, Nit};
use light_sources::shape::ShapeDesc;
use light_sources::*;
use light_testkit::{Fingerprint, Rng, assert_pinned};

/// What each light gives at [`receivers`], as a fingerprint of all bits.
const PINNED: &[(&str, u64)] = &[
    ("point", 0xc1ae569b2bc51ede),
    ("spot", 0x17cb31bd3e4559e3),
    ("projection", 0x7ea48b3f28c28fdf),
    ("goniometric", 0x70ad9f3b4a391719),
    ("distant", 0xc99086585f2dbba6),
    ("sun", 0x4732a134687b4414),
    ("uniform sky", 0x65b5d5bc44f0a4e1),
    ("equal-area sky", 0xc30aba68775794f2),
    ("lat-long sky", 0x60027183f6a9a632),
    ("portal", 0xb58d78b1aaf3b509),
    ("triangle", 0xd6559e5e9b14e326),
    ("rectangle", 0x9fd628b7985c0a38),
    ("sphere", 0x416309d4ae7fc015),
];

fn gray(resolution: [u32; 2]) -> Image {
    let texels = (0..resolution[0] * resolution[1]).map(|i| (i * 7 % 11) as f32 * 0.25);
    Image::from_f32(resolution, Channels::Gray, texels.collect::<Vec<_>>()).expect("an image")
}

/// Upright, turned, and away from the origin.
fn placed() -> Affine3A {
    Affine3A::from_translation(Vec3::new(0.5, -0.25, 2.0))
        * Affine3A::from_rotation_x(FRAC_PI_2 * 1.75)
}

fn area(shape: ShapeDesc) -> LightDesc<Rgb> {
    let color = SurfaceColor::Uniform(Vec3::new(1.0, 0.5, 0.25));
    let emission = DiffuseEmissionDesc::new(color, RadianceAmount::Luminance(Nit(300.0)));
    AreaLightDesc::new(shape, emission).into()
}

fn lights() -> Vec<(&'static str, LightDesc<Rgb>)> {
    let color = Vec3::new(1.0, 0.75, 0.5);
    let intensity = IntensityAmount::LuminousPower(Lumen(800.0));
    let portal = [
        Vec3::new(1.0, -1.0, 1.0),
        Vec3::new(1.0, 1.0, 1.0),
        Vec3::new(1.0, 1.0, 3.0),
        Vec3::new(1.0, -1.0, 3.0),
    ];
    let sky = |image| ImageInfiniteLightDesc {
        transform: placed(),
        amount: RadianceAmount::Radiometric(2.0),
        ..ImageInfiniteLightDesc::new(image)
    };
    let round = |radius| ShapeDesc::Sphere {
        transform: placed(),
        radius,
    };
    vec![
        (
            "point",
            PointLightDesc::new(Vec3::new(0.5, 1.0, 2.0), color, intensity).into(),
        ),
        (
            "spot",
            SpotLightDesc {
                falloff_start: 0.5,
                ..SpotLightDesc::new(placed(), 1.25, color, intensity)
            }
            .into(),
        ),
        (
            "projection",
            ProjectionLightDesc::new(placed(), gray([5, 3]), 1.5, intensity).into(),
        ),
        (
            "goniometric",
            GoniometricLightDesc::new(placed(), gray([6, 6]), color, intensity).into(),
        ),
        (
            "distant",
            DistantLightDesc::new(
                Vec3::new(1.0, 2.0, 3.0),
                color,
                IrradianceAmount::Illuminance(Lux(500.0)),
            )
            .into(),
        ),
        (
            "sun",
            SunLightDesc::new(
                Vec3::new(-1.0, 0.5, 2.0),
                color,
                IrradianceAmount::Illuminance(Lux(500.0)),
            )
            .into(),
        ),
        (
            "uniform sky",
            UniformInfiniteLightDesc::new(color, RadianceAmount::Radiometric(0.5)).into(),
        ),
        (
            "equal-area sky",
            sky(EnvironmentMap::EqualArea(gray([8, 8]))).into(),
        ),
        (
            "lat-long sky",
            sky(EnvironmentMap::LatLong(gray([9, 5]))).into(),
        ),
        (
            "portal",
            PortalInfiniteLightDesc::new(EnvironmentMap::EqualArea(gray([8, 8])), portal).into(),
        ),
        (
            "triangle",
            area(ShapeDesc::Triangle([
                Vec3::new(0.0, 0.0, 2.0),
                Vec3::new(0.25, 1.0, 2.5),
                Vec3::new(1.0, 0.0, 2.0),
            ])),
        ),
        (
            "rectangle",
            area(ShapeDesc::Rectangle {
                corner: Vec3::new(0.0, 0.0, 2.0),
                edges: [Vec3::Y, Vec3::new(1.0, 0.0, 0.25)],
            }),
        ),
        ("sphere", area(round(0.5))),
    ]
}

/// Points on a surface, in a medium and within the lights' reach.
fn receivers() -> impl Iterator<Item = LightSampleContext> {
    let mut rng = Rng::new(1);
    (0..64).map(move |i| {
        let p = Vec3::new(rng.f32(), rng.f32(), rng.f32()) * 4.0 - 2.0;
        let n = rng.direction();
        match i % 3 {
            0 => LightSampleContext::medium(p),
            _ => LightSampleContext::surface(p, n, n),
        }
    })
}

fn of(light: &LightRef<'_, Rgb>) -> u64 {
    let mut all = Fingerprint::default();
    let mut rng = Rng::new(2);
    let mut number = || Vec2::new(rng.f32(), rng.f32());
    let coverage = PdfCoverage::Complete;
    for ctx in receivers() {
        if let Some(sample) = light.sample_li(&ctx, number(), &(), coverage) {
            all.add(sample.l.to_array());
            all.add(sample.wi.to_array());
            all.add(sample.p_light.to_array());
            all.add(sample.n_light.to_array());
            all.add(sample.uv.to_array());
            all.add([sample.pdf, light.pdf_li(&ctx, sample.wi, coverage)]);
        }
        if let Some(sample) = light.sample_le(number(), number(), &()) {
            all.add(sample.l.to_array());
            all.add(sample.ray.origin.to_array());
            all.add(sample.ray.direction.to_array());
            all.add([sample.pdf.pos, sample.pdf.dir]);
        }
    }
    all.add(light.phi(&()).to_array());
    match light.extent() {
        LightExtent::Bounded(bounds) | LightExtent::Lobe(bounds, _) => {
            all.add(bounds.bounds.min.to_array());
            all.add(bounds.bounds.max.to_array());
            all.add(bounds.w.to_array());
            all.add([bounds.phi, bounds.cos_theta_o, bounds.cos_theta_e]);
        }
        LightExtent::Infinite(bounds) => {
            all.add(bounds.mean.to_array());
            all.add([bounds.fluence]);
        }
    }
    all.value()
}

#[test]
fn values_are_those_of_before() {
    let scene = SceneSphere::new(Vec3::ZERO, 8.0).expect("a sphere");
    let found: Vec<_> = lights()
        .into_iter()
        .map(|(name, desc)| {
            let mut builder = LightSetBuilder::new(scene);
            builder.add(desc).expect("a light");
            let set = builder.build();
            let (_, light) = set.iter().next().expect("one light");
            (name, of(&light))
        })
        .collect();
    assert_pinned(&found, PINNED);
}
