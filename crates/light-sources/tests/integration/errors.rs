//! Invalid descriptions are refused with the name of the field.

use light_sources::glam::{Affine3A, Vec3};
use light_sources::shape::ShapeDesc;
use light_sources::*;

/// The result of adding a description to a set.
fn refusal(desc: LightDesc<Rgb>) -> String {
    let scene = SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere");
    let error = LightSetBuilder::new(scene).add(desc).err();
    error.map_or("accepted".to_owned(), |error| error.to_string())
}

fn image(size: [u32; 2], channels: Channels, value: f32) -> Image {
    let count = (size[0] * size[1]) as usize * channels.count();
    Image::from_f32(size, channels, vec![value; count]).expect("an image")
}

fn flat() -> Affine3A {
    Affine3A::from_scale(Vec3::new(1.0, 1.0, 0.0))
}

fn emission() -> DiffuseEmissionDesc<Rgb> {
    DiffuseEmissionDesc::new(SurfaceColor::Uniform(Vec3::ONE), RadianceAmount::default())
}

#[test]
fn shapes() {
    let transform = Affine3A::IDENTITY;
    let (nan, inf) = (f32::NAN, f32::INFINITY);
    let cases = [
        (
            ShapeDesc::Triangle([Vec3::ZERO, Vec3::X, Vec3::NAN]),
            "triangle, vertices",
        ),
        (
            ShapeDesc::Triangle([Vec3::ZERO, Vec3::X, Vec3::X * 2.0]),
            "triangle, vertices",
        ),
        (ShapeDesc::Quad([Vec3::ZERO; 4]), "quad, corners"),
        (
            ShapeDesc::Quad([Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::splat(inf)]),
            "quad, corners",
        ),
        (
            ShapeDesc::Rectangle {
                corner: Vec3::ZERO,
                edges: [Vec3::X, Vec3::ONE],
            },
            "rectangle, edges",
        ),
        (
            ShapeDesc::Rectangle {
                corner: Vec3::ZERO,
                edges: [Vec3::X, Vec3::ZERO],
            },
            "rectangle, edges",
        ),
        (
            ShapeDesc::Rectangle {
                corner: Vec3::ZERO,
                edges: [Vec3::X * 1e-20, Vec3::Y * 1e-20],
            },
            "rectangle, edges",
        ),
        (
            ShapeDesc::Rectangle {
                corner: Vec3::NAN,
                edges: [Vec3::X, Vec3::Y],
            },
            "rectangle, corner",
        ),
        (
            ShapeDesc::Sphere {
                transform,
                radius: 0.0,
            },
            "sphere, radius",
        ),
        (
            ShapeDesc::Sphere {
                transform,
                radius: nan,
            },
            "sphere, radius",
        ),
        (
            ShapeDesc::Sphere {
                transform: flat(),
                radius: 1.0,
            },
            "transform",
        ),
        (
            ShapeDesc::Disk {
                transform,
                radius: -1.0,
                inner_radius: 0.0,
            },
            "disk, radius",
        ),
        (
            ShapeDesc::Disk {
                transform,
                radius: 1e-21,
                inner_radius: 0.0,
            },
            "disk, radius: must be positive, with an area",
        ),
        (
            ShapeDesc::Disk {
                transform,
                radius: 1.0,
                inner_radius: 1.0,
            },
            "disk, inner_radius",
        ),
        (
            ShapeDesc::Cylinder {
                transform,
                radius: inf,
                length: 1.0,
            },
            "cylinder, radius",
        ),
        (
            ShapeDesc::Cylinder {
                transform,
                radius: 1.0,
                length: nan,
            },
            "cylinder, length",
        ),
        (
            ShapeDesc::Cylinder {
                transform,
                radius: 1e-21,
                length: 1e-20,
            },
            "cylinder, length: must be positive, with an area",
        ),
    ];
    for (shape, field) in cases {
        let emission = emission();
        let said = refusal(LightDesc::Area(AreaLightDesc { shape, emission }));
        let expected = format!("area light, {field}");
        assert!(said.starts_with(&expected), "{shape:?}: {said}");
    }
}

#[test]
fn emissions() {
    let shape = ShapeDesc::Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
    let said = |emission| refusal(LightDesc::Area(AreaLightDesc { shape, emission }));
    assert_eq!(said(emission()), "accepted", "a triangle");
    let negative = SurfaceColor::Uniform(Vec3::NEG_X);
    let negative = DiffuseEmissionDesc::new(negative, RadianceAmount::default());
    assert!(
        said(negative).starts_with("area light, emission: "),
        "negative"
    );
    for tint in [Vec3::NEG_X, Vec3::NAN] {
        let texture = image([1, 1], Channels::Rgb, 1.0).into();
        let color = SurfaceColor::Image { texture, tint };
        let error = said(DiffuseEmissionDesc::new(color, RadianceAmount::default()));
        assert!(
            error.starts_with("area light, emission: "),
            "{tint}: {error}"
        );
    }
    let nan = DiffuseEmissionDesc {
        amount: RadianceAmount::Radiometric(f32::NAN).into(),
        ..emission()
    };
    assert!(said(nan).starts_with("area light, amount: "), "scale NaN");
    let bright = DiffuseEmissionDesc::new(
        SurfaceColor::Image {
            texture: image([1, 1], Channels::Rgb, 1e30).into(),
            tint: Vec3::ONE,
        },
        RadianceAmount::Radiometric(1e30),
    );
    assert!(said(bright).starts_with("area light, amount: "), "overflow");
    for (scale, cutoff) in [(-1.0, None), (f32::INFINITY, None), (1.0, Some(f32::NAN))] {
        let mask = DiffuseEmissionDesc {
            mask: EmissionMask::Alpha(AlphaMask {
                scale,
                cutoff,
                ..image([1, 1], Channels::Gray, 1.5).into()
            }),
            ..emission()
        };
        let error = said(mask);
        assert!(
            error.starts_with("area light, mask: "),
            "{scale}, {cutoff:?}: {error}"
        );
    }
}

#[test]
fn lights_with_pictures() {
    let goniometric = |transform, distribution| {
        refusal(LightDesc::Goniometric(GoniometricLightDesc {
            transform,
            distribution,
            emission: Vec3::ONE,
            amount: IntensityAmount::default(),
            media: MediumInterface::default(),
        }))
    };
    let square = || image([2, 2], Channels::Gray, 1.0);
    let said = goniometric(flat(), square());
    assert!(said.starts_with("goniometric light, transform: "), "{said}");
    let said = goniometric(Affine3A::IDENTITY, image([2, 1], Channels::Gray, 1.0));
    assert!(
        said.starts_with("goniometric light, distribution: "),
        "not square: {said}"
    );
    let said = goniometric(Affine3A::IDENTITY, image([2, 2], Channels::Rgb, 1.0));
    assert!(
        said.starts_with("goniometric light, distribution: "),
        "colours: {said}"
    );

    let projection = |fov| {
        refusal(LightDesc::Projection(ProjectionLightDesc {
            transform: Affine3A::IDENTITY,
            image: square(),
            fov,
            amount: IntensityAmount::default(),
            media: MediumInterface::default(),
        }))
    };
    for fov in [0.0, core::f32::consts::PI, -1.0, f32::NAN, 1e-6] {
        let said = projection(fov);
        assert!(said.starts_with("projection light, fov: "), "{fov}: {said}");
        assert!(said.contains("no picture"), "{fov}: {said}");
    }

    let sky = |map, amount| {
        refusal(LightDesc::ImageInfinite(ImageInfiniteLightDesc {
            transform: Affine3A::IDENTITY,
            map,
            amount: RadianceAmount::Radiometric(amount),
        }))
    };
    let said = sky(
        EnvironmentMap::EqualArea(image([2, 1], Channels::Gray, 1.0)),
        1.0,
    );
    assert!(
        said.starts_with("image infinite light, map: "),
        "not square: {said}"
    );
    let said = sky(EnvironmentMap::EqualArea(square()), -1.0);
    assert!(
        said.starts_with("image infinite light, amount: "),
        "negative: {said}"
    );

    let portal = refusal(LightDesc::PortalInfinite(PortalInfiniteLightDesc {
        transform: Affine3A::IDENTITY,
        map: EnvironmentMap::EqualArea(square()),
        amount: RadianceAmount::default(),
        portal: [Vec3::ZERO, Vec3::Y, Vec3::ONE, Vec3::X],
    }));
    assert!(
        portal.starts_with("portal infinite light, portal: "),
        "{portal}"
    );
}
