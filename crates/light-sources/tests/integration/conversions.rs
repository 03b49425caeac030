//! Values that are made of others, and those that stand where nothing is said.

use alloc::sync::Arc;

use light_sources::glam::{Affine3A, Vec2, Vec3};
use light_sources::light_bounds::LightSampleContext;
use light_sources::light_math::spectrum::{Constant, SampledSpectrum};
use light_sources::shape::{BilinearPatch, Shape, ShapeDesc, Sphere};
use light_sources::*;

#[test]
fn defaults() {
    let unit = RadianceAmount::Radiometric(1.0);
    let amount = SurfaceAmount::default();
    assert_eq!(amount, SurfaceAmount::Radiance(unit), "a unit of radiance");
    let emission = SpectralEmission::default();
    assert_eq!(emission, SpectralEmission::Constant(Constant(1.0)), "white");
    let transform = Affine3A::from(RigidTransform::default());
    assert_eq!(transform, Affine3A::IDENTITY, "no transform");
}

#[test]
fn transforms_and_spheres_come_back() {
    let turn = Affine3A::from_rotation_y(0.5);
    let transform = Affine3A::from_translation(Vec3::new(1.0, 2.0, 3.0)) * turn;
    let rigid = RigidTransform::new(transform).expect("rigid");
    assert_eq!(Affine3A::from(rigid), transform, "a transform");
    let sphere = Sphere::new(rigid, 2.0).expect("a sphere");
    let ShapeDesc::Sphere { transform, radius } = sphere.into() else {
        panic!("no sphere");
    };
    let again = RigidTransform::new(transform).expect("rigid");
    assert_eq!(Sphere::new(again, radius), Ok(sphere), "a sphere");
}

#[test]
fn indices_of_meshes() {
    let list: Arc<[[u32; 3]]> = [[0, 1, 2], [2, 1, 3]].into();
    let indices = MeshIndices::from(list);
    assert_eq!((indices.len(), indices.is_empty()), (2, false), "two");
    assert_eq!(indices.get(1), Some([2, 1, 3]), "the second");
    assert!(MeshIndices::Consecutive(0).is_empty(), "none");
    let white = SurfaceColor::Uniform(Vec3::ONE);
    let mesh = MeshLight::<Rgb>::new(MeshLightDesc {
        positions: [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE].into(),
        indices,
        uvs: None,
        emission: DiffuseEmissionDesc::new(white, RadianceAmount::default()),
    });
    let mesh = mesh.expect("a mesh");
    assert_eq!((mesh.len(), mesh.is_empty()), (2, false), "two");
}

/// A reference to a shape is a shape with the same values.
#[test]
fn shapes_by_reference() {
    fn hit(shape: impl Shape) -> Option<SurfacePoint> {
        shape.hit(Vec3::new(0.1, 0.2, 5.0), Vec3::NEG_Z)
    }
    let sphere = Sphere::new(RigidTransform::IDENTITY, 2.0).expect("a sphere");
    let reference: &Sphere = &sphere;
    let found = hit(reference).expect("a hit");
    assert_eq!(Some(found), hit(sphere), "the same");
    assert!((found.p.length() - 2.0).abs() < 1e-6, "{found:?}");
}

/// A patch with a corner that is folded back has normals to both sides.
#[test]
fn normals_of_a_folded_patch_are_anywhere() {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.1, 0.1]];
    let corners = corners.map(|[x, y]| Vec3::new(x, y, 0.0));
    let patch = BilinearPatch::new(corners).expect("an area");
    assert!(patch.normal_cone().is_whole_sphere(), "{patch:?}");
}

#[test]
fn spectra_are_radiances() {
    fn twice<R: Radiance>(value: f32) -> R {
        R::splat(value).map(|x| 2.0 * x)
    }
    let found: SampledSpectrum<3> = twice(0.75);
    assert_eq!(found, SampledSpectrum::new([1.5; 3]), "of three");
    assert_eq!(twice::<Vec3>(0.75), Vec3::splat(1.5), "a colour");
}

#[test]
fn a_sun_ends_at_its_edge() {
    let scene = SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere");
    let sun = SunLight::<Rgb>::new(
        SunLightDesc {
            direction: Vec3::Z,
            angular_diameter: 0.02,
            emission: Vec3::ONE,
            amount: SunAmount::Radiance(RadianceAmount::Radiometric(3.0)),
        },
        scene,
    );
    let sun = sun.expect("a sun");
    let le = |angle: f32| sun.le(Vec3::ZERO, Vec3::new(angle.sin(), 0.0, angle.cos()), &());
    assert_eq!(le(0.0099), Vec3::splat(3.0), "inside");
    assert_eq!(le(0.0101), Vec3::ZERO, "outside");
}

/// Units are where descriptions are, and a sun is made like other lights.
#[test]
fn a_sun_of_so_many_lux_is_that_of_the_earth() {
    let scene = SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere");
    let white = Vec3::ONE;
    let amount = IrradianceAmount::Illuminance(Lux(100_000.0));
    let desc = SunLightDesc::<Rgb>::new(Vec3::Z, white, amount);
    assert_eq!(desc.amount, SunAmount::Irradiance(amount));
    let sun = SunLight::new(desc, scene).expect("a sun");
    let le = |angle: f32| sun.le(Vec3::ZERO, Vec3::new(angle.sin(), 0.0, angle.cos()), &());
    assert!(le(0.0046).y > 0.0, "inside");
    assert_eq!(le(0.0047), Vec3::ZERO, "outside");
    let by_radiance = RadianceAmount::Luminance(Nit(1.6e9));
    let desc = SunLightDesc::<Rgb>::new(Vec3::Z, white, by_radiance);
    assert_eq!(desc.amount, SunAmount::Radiance(by_radiance));
}

/// A point light so near that the inverse square is no float is not sampled.
#[test]
fn a_point_within_reach_of_nothing() {
    let light = PointLight::<Rgb>::new(PointLightDesc {
        position: Vec3::X * 1e-20,
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(1e-30),
        media: MediumInterface::default(),
    });
    let light = light.expect("a light");
    for p in [Vec3::ZERO, Vec3::X * 1e-20] {
        let ctx = LightSampleContext::medium(p);
        let sample = light.sample_li(&ctx, Vec2::ZERO, &(), PdfCoverage::Complete);
        assert_eq!(sample, None, "{p}");
    }
}

/// A portal that shows a map by latitude and longitude, of one colour, shows that colour.
#[test]
fn a_portal_to_a_map_by_latitude_and_longitude() {
    let map = Image::from_f32([8, 4], Channels::Gray, vec![0.5; 32]).expect("an image");
    let scene = SceneSphere::new(Vec3::ZERO, 4.0).expect("a sphere");
    let desc = PortalInfiniteLightDesc {
        transform: Affine3A::IDENTITY,
        map: EnvironmentMap::LatLong(map),
        amount: RadianceAmount::Radiometric(2.0),
        portal: [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y],
    };
    let portal = PortalInfiniteLight::<Rgb>::new(desc, scene).expect("a portal");
    let le = portal.le(Vec3::new(0.5, 0.5, 1.0), Vec3::NEG_Z, &());
    assert!((le - 1.0).abs().max_element() < 1e-5, "{le}");
}
