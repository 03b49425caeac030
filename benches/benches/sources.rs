//! Every light and shape: a sample toward a point, and its density.

mod settings;

use benches::Queries;
use criterion::{Criterion, criterion_group, criterion_main};
use lights::bounds::{LightId, LightSampleContext};
use lights::glam::{Affine3A, Vec2, Vec3};
use lights::sources::shape::ShapeDesc;
use lights::sources::*;

/// A square image with uneven texels.
fn image(size: u32, channels: Channels) -> Image {
    let texel = |i| {
        [0.1 + (i * 37 % 101) as f32; 3]
            .into_iter()
            .take(channels.count())
    };
    let texels: Vec<f32> = (0..size * size).flat_map(texel).collect();
    Image::from_f32([size, size], channels, texels).expect("an image")
}

/// One of each kind, about two units above the points that are asked from.
fn lights() -> Vec<(&'static str, LightDesc<Rgb>)> {
    let above = Affine3A::from_translation(Vec3::new(0.0, 0.0, 2.0));
    let down = above * Affine3A::from_rotation_x(core::f32::consts::PI);
    let corner = Vec3::new(-0.5, -0.5, 2.0);
    let (x, y) = (Vec3::X, Vec3::Y);
    let corners = [corner, corner + y, corner + x, corner + x + y];
    let shape = |shape| {
        let color = SurfaceColor::Uniform(Vec3::ONE);
        let mut emission = DiffuseEmissionDesc::new(color, RadianceAmount::default());
        emission.sides = Sides::Both;
        LightDesc::Area(AreaLightDesc { shape, emission })
    };
    let (amount, media) = (IntensityAmount::default(), MediumInterface::default());
    vec![
        (
            "point",
            LightDesc::Point(PointLightDesc {
                position: above.translation.into(),
                emission: Vec3::ONE,
                amount,
                media,
            }),
        ),
        (
            "spot",
            LightDesc::Spot(SpotLightDesc {
                transform: down,
                angle: 0.9,
                falloff_start: 0.6,
                emission: Vec3::ONE,
                amount,
                media,
            }),
        ),
        (
            "projection",
            LightDesc::Projection(ProjectionLightDesc {
                transform: down,
                image: image(64, Channels::Rgb),
                fov: 1.5,
                amount,
                media,
            }),
        ),
        (
            "goniometric",
            LightDesc::Goniometric(GoniometricLightDesc {
                transform: down,
                distribution: image(64, Channels::Gray),
                emission: Vec3::ONE,
                amount,
                media,
            }),
        ),
        (
            "triangle",
            shape(ShapeDesc::Triangle([corners[0], corners[1], corners[2]])),
        ),
        (
            "rectangle",
            shape(ShapeDesc::Rectangle {
                corner,
                edges: [y, x],
            }),
        ),
        (
            "quad",
            shape(ShapeDesc::Quad([
                corners[0],
                corners[1],
                corners[2],
                corners[3] + Vec3::Z * 0.3,
            ])),
        ),
        (
            "sphere",
            shape(ShapeDesc::Sphere {
                transform: above,
                radius: 0.5,
            }),
        ),
        (
            "disk",
            shape(ShapeDesc::Disk {
                transform: down,
                radius: 0.5,
                inner_radius: 0.0,
            }),
        ),
        (
            "cylinder",
            shape(ShapeDesc::Cylinder {
                transform: above,
                radius: 0.2,
                length: 1.0,
            }),
        ),
        (
            "distant",
            LightDesc::Distant(DistantLightDesc {
                direction: Vec3::Z,
                emission: Vec3::ONE,
                amount: IrradianceAmount::default(),
            }),
        ),
        (
            "uniform infinite",
            LightDesc::UniformInfinite(UniformInfiniteLightDesc {
                emission: Vec3::ONE,
                amount: RadianceAmount::default(),
            }),
        ),
        (
            "image infinite",
            LightDesc::ImageInfinite(ImageInfiniteLightDesc {
                map: EnvironmentMap::EqualArea(image(256, Channels::Rgb)),
                transform: Affine3A::IDENTITY,
                amount: RadianceAmount::default(),
            }),
        ),
        (
            "image infinite, lat-long",
            LightDesc::ImageInfinite(ImageInfiniteLightDesc::new(EnvironmentMap::LatLong(image(
                256,
                Channels::Rgb,
            )))),
        ),
        (
            "portal",
            LightDesc::PortalInfinite(PortalInfiniteLightDesc {
                map: EnvironmentMap::EqualArea(image(256, Channels::Rgb)),
                transform: Affine3A::IDENTITY,
                amount: RadianceAmount::default(),
                portal: [corners[0], corners[1], corners[3], corners[2]],
            }),
        ),
    ]
}

fn sources(c: &mut Criterion) {
    let scene = SceneSphere::new(Vec3::ZERO, 10.0).expect("a sphere");
    let mut builder = LightSetBuilder::<Rgb>::new(scene);
    let mut names = Vec::new();
    for (name, desc) in lights() {
        let source = builder.add(desc).unwrap_or_else(|e| panic!("{name}: {e}"));
        names.push((name, source));
    }
    let set = builder.build();
    let queries = Queries::new(|rng| {
        let p = Vec3::new(rng.range(-1.0, 1.0), rng.range(-1.0, 1.0), 0.0);
        (LightSampleContext::surface(p, Vec3::Z, Vec3::Z), rng.vec2())
    });
    for (name, source) in names {
        let id = set.first_id(source).unwrap_or(LightId(0));
        let light = set.get(id).expect("the light");
        let sample =
            |ctx: &LightSampleContext, u: Vec2| light.sample_li(ctx, u, &(), PdfCoverage::Complete);
        let mut asked = queries.clone();
        c.bench_function(&format!("sample_li/{name}"), |b| {
            b.iter(|| {
                let (ctx, u) = asked.next_query();
                sample(&ctx, u)
            });
        });
        let mut asked = queries.clone();
        let mut toward = Queries::new(|_| {
            let (ctx, u) = asked.next_query();
            (ctx, sample(&ctx, u).map_or(Vec3::Z, |s| s.wi))
        });
        c.bench_function(&format!("pdf_li/{name}"), |b| {
            b.iter(|| {
                let (ctx, wi) = toward.next_query();
                light.pdf_li(&ctx, wi, PdfCoverage::Complete)
            });
        });
    }
}

criterion_group! {
    name = benches;
    config = settings::criterion();
    targets = sources
}
criterion_main!(benches);
