use alloc::sync::Arc;

use light_bounds::LightId;
use light_math::glam::{Affine3A, Quat, Vec2, Vec3};
use light_sources::shape::ShapeDesc;
use light_sources::{
    AreaLightDesc, Channels, DiffuseEmissionDesc, DistantLightDesc, EmissionMask, EnvironmentMap,
    GoniometricLightDesc, Image, ImageInfiniteLightDesc, IntensityAmount, IrradianceAmount,
    LightDesc, LightSet, LightSetBuilder, MediumInterface, MeshIndices, MeshLightDesc,
    PointLightDesc, PortalInfiniteLightDesc, ProjectionLightDesc, RadianceAmount, Rgb, SceneSphere,
    Sides, SpotLightDesc, SunAmount, SunLightDesc, SurfaceColor, Texture, UniformInfiniteLightDesc,
};

use crate::{Rng, own_twin};

/// Lights of every kind, each with a name.
pub(super) struct Lights {
    pub(super) set: LightSet<Rgb>,
    pub(super) names: Vec<(&'static str, LightId)>,
}

impl Lights {
    pub(super) fn len(&self) -> usize {
        self.names.len()
    }
}

/// Lights of every kind and shape in a scene of radius 10 around the origin, all of a few units in
/// size.
pub(super) fn lights() -> Lights {
    let scene = SceneSphere::new(Vec3::ZERO, 10.0).expect("a sphere");
    let mut builder = LightSetBuilder::new(scene);
    let mut sources = Vec::new();
    for (name, desc) in at_points()
        .into_iter()
        .chain(shapes())
        .chain(textured())
        .chain(at_infinity())
        .chain(own(scene))
    {
        let source = builder.add(desc).unwrap_or_else(|e| panic!("{name}: {e}"));
        sources.push((name, source));
    }
    let set = builder.build();
    let id = |source| set.first_id(source).expect("a light of each description");
    let names = sources.into_iter().map(|(name, source)| (name, id(source)));
    Lights {
        names: names.collect(),
        set,
    }
}

type Named = (&'static str, LightDesc<Rgb>);

fn transform() -> Affine3A {
    let turn = Quat::from_rotation_arc(Vec3::Z, Vec3::new(0.6, 0.48, -0.64));
    Affine3A::from_rotation_translation(turn, Vec3::new(1.0, -2.0, 0.5))
}

/// Texels between 0 and 1, every fourth one black.
fn image(size: [u32; 2], channels: Channels, seed: u64) -> Image {
    let mut rng = Rng::new(seed);
    let count = (size[0] * size[1]) as usize * channels.count();
    let texel = |i: usize| if i % 4 == 3 { 0.0 } else { rng.f32() };
    let texels: Vec<f32> = (0..count).map(texel).collect();
    Image::from_f32(size, channels, texels).expect("texels of light")
}

fn at_points() -> Vec<Named> {
    let media = MediumInterface::default();
    let spot = |angle, falloff_start| {
        LightDesc::Spot(SpotLightDesc {
            transform: transform(),
            angle,
            falloff_start,
            emission: Vec3::ONE,
            amount: IntensityAmount::Radiometric(5.0),
            media,
        })
    };
    let point = PointLightDesc {
        position: Vec3::new(1.0, 2.0, 3.0),
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(5.0),
        media,
    };
    let projection = |fov| {
        LightDesc::Projection(ProjectionLightDesc {
            transform: transform(),
            image: image([7, 5], Channels::Rgb, 1),
            fov,
            amount: IntensityAmount::Radiometric(5.0),
            media,
        })
    };
    let goniometric = GoniometricLightDesc {
        transform: transform(),
        distribution: image([16, 16], Channels::Gray, 2),
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(5.0),
        media,
    };
    vec![
        ("point", LightDesc::Point(point)),
        ("spot", spot(0.6, 0.4)),
        ("spot without a core", spot(1.2, 0.0)),
        ("spot without a rim", spot(0.3, 0.3)),
        ("projection", projection(1.0)),
        ("wide projection", projection(2.6)),
        ("goniometric", LightDesc::Goniometric(goniometric)),
    ]
}

fn emission(color: SurfaceColor<Rgb>, sides: Sides) -> DiffuseEmissionDesc<Rgb> {
    DiffuseEmissionDesc {
        sides,
        ..DiffuseEmissionDesc::new(color, RadianceAmount::Radiometric(3.0))
    }
}

fn area(shape: ShapeDesc, sides: Sides) -> LightDesc<Rgb> {
    LightDesc::Area(AreaLightDesc {
        shape,
        emission: emission(SurfaceColor::Uniform(Vec3::ONE), sides),
    })
}

fn triangle(size: f32) -> ShapeDesc {
    let a = Vec3::new(1.0, 1.0, 2.0);
    ShapeDesc::Triangle([a, a + Vec3::X * size, a + Vec3::new(0.3, 0.9, 0.4) * size])
}

fn shapes() -> Vec<Named> {
    let corner = Vec3::new(-1.0, 0.5, 2.0);
    let rectangle = ShapeDesc::Rectangle {
        corner,
        edges: [Vec3::X * 2.0, Vec3::new(0.0, 0.6, 0.8)],
    };
    let twisted = ShapeDesc::Quad([
        corner,
        corner + Vec3::X * 2.0,
        corner + Vec3::Y,
        corner + Vec3::new(2.0, 1.0, 0.7),
    ]);
    let sphere = |radius| ShapeDesc::Sphere {
        transform: transform(),
        radius,
    };
    let disk = |inner_radius| ShapeDesc::Disk {
        transform: transform(),
        radius: 1.5,
        inner_radius,
    };
    let cylinder = ShapeDesc::Cylinder {
        transform: transform(),
        radius: 0.4,
        length: 3.0,
    };
    vec![
        ("triangle", area(triangle(1.5), Sides::Front)),
        ("small triangle", area(triangle(0.01), Sides::Front)),
        ("two-sided triangle", area(triangle(1.0), Sides::Both)),
        ("rectangle", area(rectangle, Sides::Front)),
        ("twisted patch", area(twisted, Sides::Both)),
        ("sphere", area(sphere(1.0), Sides::Front)),
        ("sphere from inside", area(sphere(8.0), Sides::Back)),
        ("disk", area(disk(0.0), Sides::Front)),
        ("ring", area(disk(0.7), Sides::Both)),
        ("cylinder", area(cylinder, Sides::Front)),
    ]
}

fn textured() -> Vec<Named> {
    let picture = || SurfaceColor::Image {
        texture: Texture::new(image([8, 8], Channels::Rgb, 3)),
        tint: Vec3::ONE,
    };
    let mask = EmissionMask::Alpha(image([5, 5], Channels::Gray, 4).into());
    let masked = LightDesc::Area(AreaLightDesc {
        shape: triangle(1.5),
        emission: DiffuseEmissionDesc {
            mask,
            ..emission(picture(), Sides::Front)
        },
    });
    let positions: Arc<[Vec3]> = [
        Vec3::new(-2.0, -2.0, -2.0),
        Vec3::new(-1.0, -2.0, -2.2),
        Vec3::new(-1.0, -1.0, -2.0),
        Vec3::new(-2.0, -1.0, -1.8),
    ]
    .into();
    let mesh = LightDesc::Mesh(MeshLightDesc {
        positions,
        indices: MeshIndices::List([[0, 1, 2], [0, 2, 3]].into()),
        uvs: Some([Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y].into()),
        emission: emission(picture(), Sides::Front),
    });
    vec![("masked triangle", masked), ("textured mesh", mesh)]
}

/// Some of these as lights of a type that sets do not know.
fn own(scene: SceneSphere) -> Vec<Named> {
    let all = at_points()
        .into_iter()
        .chain(shapes())
        .chain(textured())
        .chain(at_infinity());
    let own = all.filter_map(|(name, desc)| {
        let name = match name {
            "spot" => "own spot",
            "sphere" => "own sphere",
            "cylinder" => "own cylinder",
            "masked triangle" => "own masked triangle",
            "wide sun" => "own wide sun",
            "sky" => "own sky",
            "portal" => "own portal",
            _ => return None,
        };
        let twin = own_twin(desc, scene).unwrap_or_else(|e| panic!("{name}: {e}"));
        Some((name, LightDesc::Own(twin)))
    });
    own.collect()
}

fn at_infinity() -> Vec<Named> {
    let amount = RadianceAmount::Radiometric(2.0);
    let distant = DistantLightDesc {
        direction: Vec3::new(0.36, 0.48, 0.8),
        emission: Vec3::ONE,
        amount: IrradianceAmount::Radiometric(2.0),
    };
    let sun = |angular_diameter| {
        LightDesc::Sun(SunLightDesc {
            direction: Vec3::new(0.36, 0.48, 0.8),
            angular_diameter,
            emission: Vec3::ONE,
            amount: SunAmount::Radiance(amount),
        })
    };
    let uniform = UniformInfiniteLightDesc {
        emission: Vec3::ONE,
        amount,
    };
    let rotation = Affine3A::from_quat(Quat::from_rotation_arc(
        Vec3::Z,
        Vec3::new(0.6, 0.48, -0.64),
    ));
    let sky = |map| {
        LightDesc::ImageInfinite(ImageInfiniteLightDesc {
            transform: rotation,
            map,
            amount,
        })
    };
    let equal_area = || EnvironmentMap::EqualArea(image([16, 16], Channels::Rgb, 5));
    let portal = PortalInfiniteLightDesc {
        transform: rotation,
        map: equal_area(),
        amount,
        portal: [
            Vec3::new(-1.0, -1.0, 4.0),
            Vec3::new(-1.0, 2.0, 4.0),
            Vec3::new(3.0, 2.0, 4.0),
            Vec3::new(3.0, -1.0, 4.0),
        ],
    };
    let lat_long = EnvironmentMap::LatLong(image([24, 12], Channels::Rgb, 6));
    vec![
        ("distant", LightDesc::Distant(distant)),
        ("sun", sun(0.009)),
        ("wide sun", sun(1.0)),
        ("uniform sky", LightDesc::UniformInfinite(uniform)),
        ("sky", sky(equal_area())),
        ("lat-long sky", sky(lat_long)),
        ("portal", LightDesc::PortalInfinite(portal)),
    ]
}
