//! A light behind a `LightRef` gives the results of the light itself: surfaces alone have a
//! radiance that leaves them, skies alone one that arrives.

use light_sources::glam::{Affine3A, Vec2, Vec3};
use light_sources::light_bounds::{LightGroups, LightId, LightSampleContext};
use light_sources::light_math::SphereMap;
use light_sources::shape::{AnyShape, ShapeDesc};
use light_sources::*;

fn image() -> Image {
    Image::from_f32([2, 2], Channels::Gray, [1.0, 0.5, 0.25, 2.0]).expect("an image")
}

fn media() -> MediumInterface {
    MediumInterface {
        inside: MediumId::new(3),
        outside: MediumId::new(5),
    }
}

/// One light of each kind.
fn descs() -> [LightDesc<Rgb>; 11] {
    let transform = Affine3A::IDENTITY;
    let media = media();
    let amount = IntensityAmount::Radiometric(3.0);
    let radiance = RadianceAmount::Radiometric(2.0);
    let emission = || DiffuseEmissionDesc {
        media,
        ..DiffuseEmissionDesc::new(SurfaceColor::Uniform(Vec3::ONE), radiance)
    };
    let map = EnvironmentMap::EqualArea(image());
    [
        LightDesc::Point(PointLightDesc {
            position: Vec3::ZERO,
            emission: Vec3::ONE,
            amount,
            media,
        }),
        LightDesc::Spot(SpotLightDesc {
            transform,
            emission: Vec3::ONE,
            amount,
            angle: 1.0,
            falloff_start: 0.5,
            media,
        }),
        LightDesc::Projection(ProjectionLightDesc {
            transform,
            image: image(),
            fov: 1.0,
            amount,
            media,
        }),
        LightDesc::Goniometric(GoniometricLightDesc {
            transform,
            distribution: image(),
            emission: Vec3::ONE,
            amount,
            media,
        }),
        LightDesc::Distant(DistantLightDesc {
            direction: Vec3::Z,
            emission: Vec3::ONE,
            amount: IrradianceAmount::Radiometric(1.0),
        }),
        LightDesc::Sun(SunLightDesc {
            direction: Vec3::NEG_Z,
            angular_diameter: 0.02,
            emission: Vec3::ONE,
            amount: SunAmount::Radiance(radiance),
        }),
        LightDesc::UniformInfinite(UniformInfiniteLightDesc {
            emission: Vec3::ONE,
            amount: radiance,
        }),
        LightDesc::ImageInfinite(ImageInfiniteLightDesc {
            map: map.clone(),
            transform,
            amount: radiance,
        }),
        LightDesc::PortalInfinite(PortalInfiniteLightDesc {
            map,
            transform,
            amount: radiance,
            portal: [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y],
        }),
        LightDesc::Area(AreaLightDesc {
            shape: ShapeDesc::Rectangle {
                corner: Vec3::ZERO,
                edges: [Vec3::X, Vec3::Y],
            },
            emission: emission(),
        }),
        LightDesc::Mesh(MeshLightDesc {
            positions: [Vec3::ZERO, Vec3::X, Vec3::Y].into(),
            indices: [[0, 1, 2]].into(),
            uvs: None,
            emission: emission(),
        }),
    ]
}

fn set(descs: impl IntoIterator<Item = LightDesc<Rgb>>) -> LightSet<Rgb> {
    let scene = SceneSphere::new(Vec3::ZERO, 4.0).expect("a sphere");
    let mut builder = LightSetBuilder::new(scene);
    for desc in descs {
        builder.add(desc).expect("a light");
    }
    builder.build()
}

fn lights() -> LightSet<Rgb> {
    set(descs())
}

/// A place of the square and of the triangle, seen from the front.
fn front() -> SurfacePoint {
    SurfacePoint {
        p: Vec3::new(0.25, 0.25, 0.0),
        n: Vec3::Z,
        uv: Vec2::splat(0.25),
    }
}

#[test]
fn lights_are_in_the_media_of_their_descriptions() {
    for (_, light) in lights().iter() {
        let expected = if light.bounds().is_some() {
            media()
        } else {
            MediumInterface::default()
        };
        assert_eq!(light.media(), expected, "{light:?}");
    }
}

/// What rays do not meet, only samples of the light find.
#[test]
fn invisible_surfaces_are_found_by_samples_alone() {
    for (mask, expected) in [
        (EmissionMask::Opaque, LightType::Area),
        (EmissionMask::Invisible, LightType::DeltaPosition),
    ] {
        let white = SurfaceColor::<Rgb>::Uniform(Vec3::ONE);
        let emission = DiffuseEmissionDesc {
            mask,
            ..DiffuseEmissionDesc::new(white, RadianceAmount::default())
        };
        let shape = ShapeDesc::Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
        let scene = SceneSphere::new(Vec3::ZERO, 4.0).expect("a sphere");
        let mut builder = LightSetBuilder::new(scene);
        let desc = AreaLightDesc { shape, emission };
        builder.add(LightDesc::Area(desc)).expect("a light");
        let set = builder.build();
        let light = set.get(LightId(0)).expect("the triangle");
        assert_eq!(light.light_type(), expected, "{light:?}");
        let ctx = LightSampleContext::medium(Vec3::new(0.25, 0.25, 1.0));
        let coverage = PdfCoverage::Complete;
        let sample = light.sample_li(&ctx, Vec2::splat(0.5), &(), coverage);
        let sample = sample.expect("a sample of either");
        assert_eq!(
            light.pdf_li(&ctx, sample.wi, coverage),
            sample.pdf,
            "{light:?}"
        );
        let met = light.hit(ctx.p, Vec3::NEG_Z).is_some();
        assert_eq!(met, expected == LightType::Area, "{light:?}");
    }
}

#[test]
fn surfaces_alone_have_a_radiance_that_leaves_them() {
    let set = lights();
    let mut surfaces = 0;
    let above = Vec3::new(0.25, 0.25, 1.0);
    for (_, light) in set.iter() {
        let is_surface = matches!(light, LightRef::Area(_) | LightRef::Triangle(_));
        surfaces += u32::from(is_surface);
        let expected = if is_surface {
            Vec3::splat(2.0)
        } else {
            Vec3::ZERO
        };
        assert_eq!(light.l(&front(), Vec3::Z, &()), expected, "{light:?}");
        assert_eq!(light.l(&front(), Vec3::NEG_Z, &()), Vec3::ZERO, "{light:?}");
        let met = light.hit(above, Vec3::NEG_Z).map(|at| at.p);
        assert_eq!(met, is_surface.then_some(front().p), "{light:?}");
    }
    assert_eq!(surfaces, 2, "a square and a triangle");
}

/// Three times as bright is three times the power, for every kind.
#[test]
fn descriptions_become_brighter() {
    let before = lights();
    let after = set(descs().map(|mut desc| {
        assert!(desc.scale(3.0), "{desc:?}");
        desc
    }));
    for ((id, light), (_, bright)) in before.iter().zip(after.iter()) {
        let [light, bright] = [light, bright].map(|light| light.phi(&()).x);
        assert!(light > 0.0, "{id:?}: {light}");
        let near = (bright / light - 3.0).abs() < 1e-5;
        assert!(near, "{id:?}: {light}, {bright}");
    }
    let skies = descs().map(|desc| desc.is_sky());
    let count = skies.iter().filter(|is_sky| **is_sky).count();
    assert_eq!(count, 4, "suns and skies: {skies:?}");
}

/// An image or a mask varies the radiance of a surface, also if its texels are alike.
#[test]
fn uniform_surfaces_have_one_radiance() {
    let texture = || Texture::from(image());
    let white = SurfaceColor::<Rgb>::Uniform(Vec3::ONE);
    let shown = SurfaceColor::Image {
        texture: texture(),
        tint: Vec3::ONE,
    };
    let mask = || EmissionMask::Alpha(texture().into());
    for (color, mask, expected) in [
        (&white, EmissionMask::Opaque, Some(Vec3::splat(2.0))),
        (&white, EmissionMask::Invisible, Some(Vec3::splat(2.0))),
        (&white, mask(), None),
        (&shown, EmissionMask::Opaque, None),
    ] {
        let desc = DiffuseEmissionDesc {
            mask,
            ..DiffuseEmissionDesc::new(color.clone(), RadianceAmount::Radiometric(2.0))
        };
        let what = format!("{desc:?}");
        let emission = DiffuseEmission::new(desc, [] as [AnyShape; 0]).expect("an emission");
        assert_eq!(emission.uniform_radiance(&()), expected, "{what}");
    }
}

#[test]
fn skies_alone_have_a_radiance_that_arrives() {
    let set = lights();
    let mut skies = 0;
    for (_, light) in set.iter() {
        let is_sky = matches!(
            light,
            LightRef::Sun(_)
                | LightRef::UniformInfinite(_)
                | LightRef::ImageInfinite(_)
                | LightRef::PortalInfinite(_)
        );
        skies += u32::from(is_sky);
        // From above through the portal to the sun.
        let le = light.le(Vec3::new(0.5, 0.5, 1.0), Vec3::NEG_Z, &());
        assert_eq!(le != Vec3::ZERO, is_sky, "{light:?}: {le}");
        let is_infinite = light.light_type() == LightType::Infinite;
        assert_eq!(is_infinite, is_sky, "{light:?}");
    }
    assert_eq!(skies, 4, "of each kind");
}

/// A set answers by kind what the light itself answers.
#[test]
fn densities_and_groups_are_those_of_the_light() {
    let mut set = lights();
    assert!(!set.is_empty(), "one of each kind");
    let ctx = LightSampleContext::medium(Vec3::new(0.4, 0.3, 0.8));
    let complete = PdfCoverage::Complete;
    let mut compared = 0;
    for (_, light) in set.iter() {
        if let Some(sample) = light.sample_li(&ctx, Vec2::splat(0.3), &(), complete) {
            let is_delta = light.light_type().is_delta();
            let expected = if is_delta { 0.0 } else { sample.pdf };
            let pdf = light.pdf_li(&ctx, sample.wi, complete);
            assert!(
                (pdf - expected).abs() <= 1e-4 * expected,
                "{pdf}: {light:?}"
            );
            compared += u32::from(!is_delta);
        }
    }
    assert!(compared >= 4, "{compared} densities");

    let all = vec![LightGroups::ALL; set.len()];
    assert_eq!(set.groups(), all, "none are named");
    let key = LightGroups::of(3);
    set.set_groups(SourceId(2), key).expect("a source");
    let expected = set.iter().map(|(id, _)| match set.source_of(id) {
        Some((SourceId(2), _)) => key,
        _ => LightGroups::ALL,
    });
    assert_eq!(set.groups(), expected.collect::<Vec<_>>(), "of one source");
    let unknown = set.set_groups(SourceId(99), key);
    assert_eq!(unknown, Err(LightUpdateError::UnknownSource), "no source");
}

/// A square map of equal areas stays as it is, another is refused, and a lat-long map is resampled.
#[test]
fn maps_become_equal_area_maps() {
    let square = EnvironmentMap::EqualArea(image());
    let kept = square.clone().into_equal_area().expect("a square");
    assert_eq!(kept, square, "as it is");
    let wide = Image::from_f32([2, 1], Channels::Gray, [1.0, 2.0]).expect("an image");
    let refused = EnvironmentMap::EqualArea(wide.clone()).into_equal_area();
    assert_eq!(refused, Err(ImageInfiniteLightError::NotSquare), "2 by 1");
    let resampled = EnvironmentMap::LatLong(wide)
        .into_equal_area()
        .expect("any size");
    assert_eq!(resampled.sphere_map(), SphereMap::EqualArea, "resampled");
}
