//! Short descriptions are the long ones with their remaining fields at rest, and every kind of
//! description joins a set as it is.

use core::f32::consts::FRAC_PI_3;
use core::fmt::Debug;

use light_sources::glam::{Affine3A, Vec3};
use light_sources::shape::ShapeDesc;
use light_sources::*;

const COLOR: Vec3 = Vec3::new(1.0, 0.5, 0.25);
const INTENSITY: IntensityAmount = IntensityAmount::Radiometric(3.0);

fn image(width: u32, height: u32) -> Image {
    let texels = vec![0.5; (width * height) as usize];
    Image::from_f32([width, height], Channels::Gray, texels).expect("an image")
}

fn emission() -> DiffuseEmissionDesc<Rgb> {
    let amount = RadianceAmount::Radiometric(2.0);
    DiffuseEmissionDesc::new(SurfaceColor::Uniform(COLOR), amount)
}

fn triangle() -> [Vec3; 3] {
    [Vec3::ZERO, Vec3::X, Vec3::Y]
}

#[track_caller]
fn assert_same(short: impl Into<LightDesc<Rgb>>, long: LightDesc<Rgb>) {
    let text = |desc: &dyn Debug| format!("{desc:?}");
    assert_eq!(text(&short.into()), text(&long), "field by field");
}

#[test]
fn constructors_fill_in_what_is_at_rest() {
    let transform = Affine3A::from_translation(Vec3::X);
    let vacuum = MediumInterface::default();
    assert_same(
        PointLightDesc::new(Vec3::Y, COLOR, INTENSITY),
        LightDesc::Point(PointLightDesc {
            position: Vec3::Y,
            emission: COLOR,
            amount: INTENSITY,
            media: vacuum,
        }),
    );
    assert_same(
        SpotLightDesc::new(transform, FRAC_PI_3, COLOR, INTENSITY),
        LightDesc::Spot(SpotLightDesc {
            transform,
            angle: FRAC_PI_3,
            falloff_start: FRAC_PI_3,
            emission: COLOR,
            amount: INTENSITY,
            media: vacuum,
        }),
    );
    let amount = IrradianceAmount::Radiometric(4.0);
    assert_same(
        DistantLightDesc::new(Vec3::Z, COLOR, amount),
        LightDesc::Distant(DistantLightDesc {
            direction: Vec3::Z,
            emission: COLOR,
            amount,
        }),
    );
    let amount = RadianceAmount::Radiometric(5.0);
    assert_same(
        UniformInfiniteLightDesc::new(COLOR, amount),
        LightDesc::UniformInfinite(UniformInfiniteLightDesc {
            emission: COLOR,
            amount,
        }),
    );
    let map = EnvironmentMap::EqualArea(image(2, 2));
    assert_same(
        ImageInfiniteLightDesc::new(map.clone()),
        LightDesc::ImageInfinite(ImageInfiniteLightDesc {
            transform: Affine3A::IDENTITY,
            map,
            amount: RadianceAmount::Radiometric(1.0),
        }),
    );
    let shape = || ShapeDesc::Triangle(triangle());
    assert_same(
        AreaLightDesc::new(shape(), emission()),
        LightDesc::Area(AreaLightDesc {
            shape: shape(),
            emission: emission(),
        }),
    );
    assert_same(
        MeshLightDesc::new(triangle(), vec![[0, 1, 2]], emission()),
        LightDesc::Mesh(MeshLightDesc {
            positions: triangle().into(),
            indices: vec![[0, 1, 2]].into(),
            uvs: None,
            emission: emission(),
        }),
    );
}

#[test]
fn every_kind_of_description_joins_a_set() {
    let scene = SceneSphere::new(Vec3::ZERO, 2.0).expect("a sphere");
    let mut lights = LightSetBuilder::<Rgb>::new(scene);
    let transform = Affine3A::IDENTITY;
    let media = MediumInterface::default();
    let map = EnvironmentMap::EqualArea(image(2, 2));
    let sources = [
        lights.add(PointLightDesc::new(Vec3::Y, COLOR, INTENSITY)),
        lights.add(SpotLightDesc::new(transform, FRAC_PI_3, COLOR, INTENSITY)),
        lights.add(GoniometricLightDesc {
            transform,
            distribution: image(2, 2),
            emission: COLOR,
            amount: INTENSITY,
            media,
        }),
        lights.add(AreaLightDesc::new(
            ShapeDesc::Triangle(triangle()),
            emission(),
        )),
        lights.add(MeshLightDesc::new(triangle(), vec![[0, 1, 2]], emission())),
        lights.add(DistantLightDesc::new(
            Vec3::Z,
            COLOR,
            IrradianceAmount::Radiometric(1.0),
        )),
        lights.add(SunLightDesc {
            direction: Vec3::Z,
            angular_diameter: 0.01,
            emission: COLOR,
            amount: SunAmount::Irradiance(IrradianceAmount::Radiometric(1.0)),
        }),
        lights.add(UniformInfiniteLightDesc::new(
            COLOR,
            RadianceAmount::default(),
        )),
        lights.add(ImageInfiniteLightDesc::new(map)),
    ];
    let kinds = |light: LightRef<'_, Rgb>| match light {
        LightRef::Point(_) => 0,
        LightRef::Spot(_) => 1,
        LightRef::Goniometric(_) => 2,
        LightRef::Area(_) => 3,
        LightRef::Triangle(_) => 4,
        LightRef::Distant(_) => 5,
        LightRef::Sun(_) => 6,
        LightRef::UniformInfinite(_) => 7,
        LightRef::ImageInfinite(_) => 8,
        _ => 9,
    };
    let lights = lights.build();
    for (kind, source) in (0..).zip(sources) {
        let id = lights.first_id(source.expect("valid")).expect("an id");
        let light = lights.get(id).expect("a light");
        assert_eq!(kinds(light), kind, "{id:?}");
    }
}
