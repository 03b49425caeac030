//! Each kind of light is refused by its name and by the field that is wrong.

use light_sources::glam::{Affine2, Affine3A, Quat, Vec2, Vec3};
use light_sources::shape::ShapeDesc;
use light_sources::*;

const IDENTITY: Affine3A = Affine3A::IDENTITY;
const MEDIA: MediumInterface = MediumInterface {
    inside: None,
    outside: None,
};

fn refusal(desc: LightDesc<Rgb>) -> String {
    let scene = SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere");
    let error = LightSetBuilder::new(scene).add(desc).err();
    error.map_or("accepted".to_owned(), |error| error.to_string())
}

#[track_caller]
fn assert_refused(desc: LightDesc<Rgb>, field: &str) {
    let said = refusal(desc);
    assert!(said.starts_with(field), "{field}, not: {said}");
}

fn flat() -> Affine3A {
    Affine3A::from_scale(Vec3::new(1.0, 1.0, 0.0))
}

/// So bright that no radiance fits into a float with an amount of as much again.
const BRIGHT: f32 = 1e30;

fn bright(channels: Channels) -> Image {
    Image::from_f32([2, 2], channels, vec![BRIGHT; 4 * channels.count()]).expect("an image")
}

fn point(position: Vec3, amount: f32) -> LightDesc<Rgb> {
    LightDesc::Point(PointLightDesc {
        position,
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(amount),
        media: MEDIA,
    })
}

fn spot(transform: Affine3A, amount: f32) -> LightDesc<Rgb> {
    LightDesc::Spot(SpotLightDesc {
        transform,
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(amount),
        angle: 1.0,
        falloff_start: 0.5,
        media: MEDIA,
    })
}

fn goniometric(amount: f32) -> LightDesc<Rgb> {
    LightDesc::Goniometric(GoniometricLightDesc {
        transform: IDENTITY,
        distribution: bright(Channels::Gray),
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(amount),
        media: MEDIA,
    })
}

fn projection(transform: Affine3A, amount: f32) -> LightDesc<Rgb> {
    LightDesc::Projection(ProjectionLightDesc {
        transform,
        image: bright(Channels::Rgb),
        fov: 1.0,
        amount: IntensityAmount::Radiometric(amount),
        media: MEDIA,
    })
}

#[test]
fn lights_in_one_place() {
    assert_refused(point(Vec3::NAN, 1.0), "point light, position: ");
    assert_refused(point(Vec3::ZERO, -1.0), "point light, amount: ");
    assert_refused(spot(flat(), 1.0), "spot light, transform: ");
    assert_refused(spot(IDENTITY, f32::NAN), "spot light, amount: ");
    assert_refused(goniometric(-1.0), "goniometric light, amount: ");
    assert_refused(goniometric(BRIGHT), "goniometric light, amount: ");
    assert_refused(projection(flat(), 1.0), "projection light, transform: ");
    assert_refused(projection(IDENTITY, -1.0), "projection light, amount: ");
    assert_refused(projection(IDENTITY, BRIGHT), "projection light, amount: ");
}

#[test]
fn meshes() {
    let mesh = |indices: [[u32; 3]; 1], scale| {
        let texture = Texture::new(bright(Channels::Gray));
        let white = SurfaceColor::Uniform(Vec3::ONE);
        LightDesc::Mesh(MeshLightDesc {
            positions: [Vec3::ZERO, Vec3::X, Vec3::Y].into(),
            indices: indices.into(),
            uvs: None,
            emission: DiffuseEmissionDesc {
                mask: EmissionMask::Alpha(AlphaMask {
                    scale,
                    ..texture.into()
                }),
                ..DiffuseEmissionDesc::new(white, RadianceAmount::default())
            },
        })
    };
    assert_eq!(refusal(mesh([[0, 1, 2]], 1.0)), "accepted", "a mesh");
    assert_refused(mesh([[0, 1, 3]], 1.0), "mesh light, indices: ");
    assert_refused(mesh([[0, 1, 2]], -1.0), "mesh light, mask: ");
}

#[test]
fn lights_at_infinity() {
    let distant = |direction, amount| {
        LightDesc::Distant(DistantLightDesc {
            direction,
            emission: Vec3::ONE,
            amount: IrradianceAmount::Radiometric(amount),
        })
    };
    assert_refused(distant(Vec3::ZERO, 1.0), "distant light, direction: ");
    assert_refused(distant(Vec3::Z, -1.0), "distant light, amount: ");
    let sun = |angular_diameter, amount| {
        LightDesc::Sun(SunLightDesc {
            direction: Vec3::Z,
            angular_diameter,
            emission: Vec3::ONE,
            amount: SunAmount::Radiance(RadianceAmount::Radiometric(amount)),
        })
    };
    assert_refused(sun(-1.0, 1.0), "sun light, angular_diameter: ");
    assert_refused(sun(0.01, -1.0), "sun light, amount: ");
    let uniform = UniformInfiniteLightDesc {
        emission: Vec3::ONE,
        amount: RadianceAmount::Radiometric(-1.0),
    };
    let uniform = LightDesc::UniformInfinite(uniform);
    assert_refused(uniform, "uniform infinite light, amount: ");
    let map = || EnvironmentMap::EqualArea(bright(Channels::Rgb));
    let image = LightDesc::ImageInfinite(ImageInfiniteLightDesc {
        transform: flat(),
        map: map(),
        amount: RadianceAmount::default(),
    });
    assert_refused(image, "image infinite light, transform: ");
    let portal = |transform, amount| {
        LightDesc::PortalInfinite(PortalInfiniteLightDesc {
            transform,
            map: map(),
            amount: RadianceAmount::Radiometric(amount),
            portal: [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y],
        })
    };
    assert_refused(portal(flat(), 1.0), "portal infinite light, transform: ");
    assert_refused(portal(IDENTITY, BRIGHT), "portal infinite light, amount: ");
}

#[test]
fn mappings() {
    let area = |mapping: TextureMapping, of_mask: TextureMapping| {
        let image = Image::from_f32([1, 1], Channels::Gray, vec![1.0]).expect("an image");
        let texture = Texture::new(image);
        let mask = EmissionMask::Alpha(AlphaMask {
            mapping: Some(of_mask),
            ..texture.clone().into()
        });
        let tint = Vec3::ONE;
        let color = SurfaceColor::Image { texture, tint };
        let emission = DiffuseEmissionDesc {
            mapping,
            mask,
            ..DiffuseEmissionDesc::new(color, RadianceAmount::default())
        };
        AreaLightDesc::new(ShapeDesc::sphere(Vec3::ZERO, 1.0), emission).into()
    };
    let plain = TextureMapping::default();
    assert_eq!(refusal(area(plain, plain)), "accepted", "a mapping");
    for wrong in [f32::NAN, f32::INFINITY] {
        for transform in [
            Affine2::from_scale(Vec2::new(1.0, wrong)),
            Affine2::from_translation(Vec2::new(wrong, 0.0)),
        ] {
            let mapping = TextureMapping { transform, ..plain };
            assert_refused(area(mapping, plain), "area light, mapping: transform");
            assert_refused(area(plain, mapping), "area light, mask: ");
        }
    }
}

#[test]
fn quads_whose_corners_go_around() {
    let quad = |corners: [Vec3; 4]| {
        let build = ShapeDesc::Quad(corners).build();
        build.map_or_else(|error| error.to_string(), |_| "accepted".to_owned())
    };
    let turn = Quat::from_axis_angle(Vec3::new(2.0, 1.0, 2.0) / 3.0, 0.8);
    for far in [0.0, 10.0, 1e3] {
        let place = |(x, y, z)| turn * Vec3::new(x, y, z) + Vec3::new(1.0, 0.7, -0.3) * far;
        let rows = [(0.0, 0.0), (1.0, 0.0), (0.1, 1.5), (0.8, 1.4)];
        let rows = rows.map(|(x, y)| place((x, y, 0.0)));
        let [p00, p10, p01, p11] = rows;
        assert_eq!(quad(rows), "accepted", "rows, {far} away");
        for around in [[p00, p10, p11, p01], [p00, p11, p01, p10]] {
            let said = quad(around);
            assert!(said.starts_with("quad, corners: two sides cross"), "{said}");
        }
        // One corner turns the other way: the outline does not cross itself.
        let dent = [p00, p10, p01, place((0.3, 0.3, 0.0))];
        assert_eq!(quad(dent), "accepted", "a dent, {far} away");
        let bent = [p00, p10, p11, place((0.1, 1.5, 0.3))];
        assert_eq!(quad(bent), "accepted", "not flat, {far} away");
    }
}
