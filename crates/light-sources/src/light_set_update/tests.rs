use super::*;
use crate::amount::{IntensityAmount, IrradianceAmount, RadianceAmount};
use crate::channels::Channels;
use crate::diffuse_emission_desc::{DiffuseEmissionDesc, SurfaceColor};
use crate::distant::DistantLightDesc;
use crate::glam::{Affine3A, Vec2, Vec3};
use crate::image::Image;
use crate::image_infinite_desc::{EnvironmentMap, ImageInfiniteLightDesc};
use crate::light_ref::LightRef;
use crate::light_set_builder::LightSetBuilder;
use crate::mesh::MeshLightDesc;
use crate::pdf_coverage::PdfCoverage;
use crate::point::{PointLightDesc, PointLightError};
use crate::rgb::Rgb;
use crate::scene_sphere::SceneSphere;
use alloc::string::ToString;
use light_bounds::LightSampleContext;

fn lamp(position: Vec3, intensity: f32) -> LightDesc<Rgb> {
    let amount = IntensityAmount::Radiometric(intensity);
    PointLightDesc::new(position, Vec3::ONE, amount).into()
}

fn mesh(triangles: usize, at: Vec3) -> LightDesc<Rgb> {
    let color = SurfaceColor::Uniform(Vec3::ONE);
    LightDesc::Mesh(MeshLightDesc {
        positions: [at, at + Vec3::X, at + Vec3::Y].into(),
        indices: alloc::vec![[0, 1, 2]; triangles].into(),
        uvs: None,
        emission: DiffuseEmissionDesc::new(color, RadianceAmount::Radiometric(1.0)),
    })
}

fn sun(direction: Vec3, irradiance: f32) -> LightDesc<Rgb> {
    let amount = IrradianceAmount::Radiometric(irradiance);
    DistantLightDesc::new(direction, Vec3::ONE, amount).into()
}

fn sky(image: &Image, angle: f32, radiance: f32) -> LightDesc<Rgb> {
    LightDesc::ImageInfinite(ImageInfiniteLightDesc {
        transform: Affine3A::from_rotation_x(angle),
        map: EnvironmentMap::EqualArea(image.clone()),
        amount: RadianceAmount::Radiometric(radiance),
    })
}

fn image(brightest: usize) -> Image {
    let mut texels = alloc::vec![0.25; 64];
    texels[brightest] = 10.0;
    Image::from_f32([8, 8], Channels::Gray, texels).expect("an image")
}

fn set(descs: &[LightDesc<Rgb>]) -> LightSet<Rgb> {
    let mut builder = LightSetBuilder::new(SceneSphere::new(Vec3::ZERO, 5.0).expect("a sphere"));
    for desc in descs {
        builder.add(desc.clone()).expect("a light");
    }
    builder.build()
}

/// What a set answers about all of its lights: bounds, powers, samples.
fn answers(set: &LightSet<Rgb>) -> alloc::string::String {
    let ctx = LightSampleContext::surface(Vec3::new(0.1, 0.2, -3.0), Vec3::Z, Vec3::Z);
    let sample = |light: LightRef<'_, Rgb>| {
        let u = Vec2::new(0.3, 0.6);
        light.sample_li(&ctx, u, &(), PdfCoverage::Incomplete)
    };
    let samples: Vec<_> = set.iter().map(|(_, light)| sample(light)).collect();
    alloc::format!("{:?} {:?} {samples:?}", set.extents(), set.powers())
}

#[test]
fn an_updated_set_is_the_set_that_would_be_built() {
    let (old, other) = (image(3), image(40));
    let before = [
        sky(&old, 0.0, 1.0),
        lamp(Vec3::ZERO, 1.0),
        mesh(3, Vec3::ZERO),
        sun(Vec3::Z, 1.0),
        lamp(Vec3::X, 2.0),
    ];
    let changes = [
        (1, lamp(Vec3::Y, 3.0)),
        (2, mesh(3, Vec3::Z)),
        (3, sun(Vec3::X, 0.5)),
        (0, sky(&old, 0.7, 1.0)),
        (0, sky(&old, 0.7, 2.0)),
        (0, sky(&other, 0.7, 2.0)),
        (4, lamp(Vec3::Z, 0.0)),
    ];
    let (mut updated, mut descs) = (set(&before), before);
    let mut extents = updated.extents();
    let buffer = extents.as_ptr();
    for (source, desc) in changes {
        let was = answers(&updated);
        updated
            .update(SourceId(source), desc.clone())
            .expect("the same kind");
        descs[source as usize] = desc;
        assert_ne!(answers(&updated), was, "source {source} changes");
        assert_eq!(answers(&updated), answers(&set(&descs)), "source {source}");
        updated.extents_into(&mut extents);
        assert_eq!(
            alloc::format!("{extents:?}"),
            alloc::format!("{:?}", updated.extents()),
            "the buffer holds these extents alone"
        );
        assert_eq!(extents.as_ptr(), buffer, "no new buffer");
    }
}

#[test]
fn a_sky_that_turns_keeps_its_tables() {
    let (old, other) = (image(3), image(40));
    let mut set = set(&[sky(&old, 0.0, 1.0)]);
    let tables = |set: &LightSet<Rgb>| set.lists.image_infinites[0].table_address();
    let first = tables(&set);
    let turned = set.update(SourceId(0), sky(&old.clone(), 1.0, 3.0));
    assert_eq!(turned, Ok(()), "the same kind");
    assert_eq!(tables(&set), first, "shared texels");
    let changed = set.update(SourceId(0), sky(&other, 1.0, 3.0));
    assert_eq!(changed, Ok(()), "the same kind");
    assert_ne!(tables(&set), first, "another picture");

    // The same texels by another map are another sky, and are kept as such.
    let lat_long = |angle, radiance| {
        LightDesc::ImageInfinite(ImageInfiniteLightDesc {
            transform: Affine3A::from_rotation_x(angle),
            map: EnvironmentMap::LatLong(other.clone()),
            amount: RadianceAmount::Radiometric(radiance),
        })
    };
    let square = tables(&set);
    let kinds = set.update(SourceId(0), lat_long(0.0, 1.0));
    assert_eq!(kinds, Ok(()), "the same kind");
    let first = tables(&set);
    assert_ne!(first, square, "another map");
    let was = answers(&set);
    let turned = set.update(SourceId(0), lat_long(1.0, 2.0));
    assert_eq!(turned, Ok(()), "the same kind");
    assert_eq!(tables(&set), first, "shared texels, lat-long");
    assert_ne!(answers(&set), was, "turned");
}

#[test]
fn what_would_move_ids_is_refused_and_changes_nothing() {
    let mut set = set(&[mesh(3, Vec3::ZERO), lamp(Vec3::ZERO, 1.0)]);
    let was = answers(&set);
    let count = LightUpdateError::OtherCount {
        expected: 3,
        given: 4,
    };
    let rule = LightUpdateError::Description(LightDescError::Point(PointLightError::Position));
    let cases = [
        (
            0,
            mesh(4, Vec3::ZERO),
            count,
            "a source of 3 lights cannot become one of 4",
        ),
        (
            1,
            sun(Vec3::Z, 1.0),
            LightUpdateError::OtherKind,
            "a source cannot become another kind of light",
        ),
        (
            2,
            lamp(Vec3::ZERO, 1.0),
            LightUpdateError::UnknownSource,
            "the set has no such source",
        ),
        (
            1,
            lamp(Vec3::NAN, 1.0),
            rule,
            "point light, position: must be finite",
        ),
    ];
    for (source, desc, error, text) in cases {
        assert_eq!(set.update(SourceId(source), desc), Err(error), "{text}");
        assert_eq!(error.to_string(), text, "in words");
        assert_eq!(answers(&set), was, "{text}");
    }
    assert!(rule.source().is_some(), "has a cause");
    assert!(count.source().is_none(), "is the cause");
}
