//! Lights of other types in a set: they answer for themselves, and a set takes none that
//! contradicts itself.

mod sayer;

use light_sources::glam::{Affine3A, Quat, Vec3};
use light_sources::light_bounds::{LightId, LightSampleContext};
use light_sources::shape::ShapeDesc;
use light_sources::*;
use light_testkit::{Rng, own_twin};

fn scene() -> SceneSphere {
    SceneSphere::new(Vec3::ZERO, 5.0).expect("a sphere")
}

fn lamp(intensity: f32) -> PointLightDesc<Rgb> {
    let amount = IntensityAmount::Radiometric(intensity);
    PointLightDesc::new(Vec3::new(0.5, 1.0, -0.5), Vec3::ONE, amount)
}

fn sun(irradiance: f32) -> DistantLightDesc<Rgb> {
    let amount = IrradianceAmount::Radiometric(irradiance);
    DistantLightDesc::new(Vec3::new(0.6, 0.0, 0.8), Vec3::ONE, amount)
}

fn emission() -> DiffuseEmissionDesc<Rgb> {
    let color = SurfaceColor::Uniform(Vec3::new(1.0, 0.5, 0.25));
    DiffuseEmissionDesc::new(color, RadianceAmount::Radiometric(2.0))
}

/// Lights of each way to be found by rays.
fn described() -> Vec<LightDesc<Rgb>> {
    let turn = Quat::from_rotation_arc(Vec3::Z, Vec3::new(0.6, 0.48, -0.64));
    let transform = Affine3A::from_rotation_translation(turn, Vec3::new(1.0, -1.0, 0.5));
    let mut spot = SpotLightDesc::new(transform, 0.8, Vec3::ONE, IntensityAmount::Radiometric(3.0));
    spot.media.outside = MediumId::new(4);
    let ball = ShapeDesc::Sphere {
        transform,
        radius: 0.5,
    };
    let triangle = ShapeDesc::Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
    let invisible = DiffuseEmissionDesc {
        mask: EmissionMask::Invisible,
        ..emission()
    };
    let texels: Vec<f32> = (0..64u8).map(|i| f32::from(i % 7)).collect();
    let map = Image::from_f32([8, 8], Channels::Gray, texels).expect("an image");
    let sky = UniformInfiniteLightDesc::new(Vec3::Z, RadianceAmount::Radiometric(0.1));
    vec![
        lamp(2.0).into(),
        spot.into(),
        AreaLightDesc::new(ball, emission()).into(),
        AreaLightDesc::new(triangle, invisible).into(),
        sun(3.0).into(),
        sky.into(),
        ImageInfiniteLightDesc::new(EnvironmentMap::EqualArea(map)).into(),
    ]
}

fn set(descs: impl IntoIterator<Item = LightDesc<Rgb>>) -> LightSet<Rgb> {
    let mut builder = LightSetBuilder::new(scene());
    for desc in descs {
        builder.add(desc).expect("a light");
        // Ids do not count sources.
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE];
        let mesh = MeshLightDesc::new(corners, vec![[0, 1, 2], [1, 3, 2]], emission());
        builder.add(mesh).expect("a mesh");
    }
    builder.build()
}

/// As descriptions, and as own lights.
fn pair() -> [LightSet<Rgb>; 2] {
    let twin = |desc| own_twin(desc, scene()).expect("a light").into();
    [set(described()), set(described().into_iter().map(twin))]
}

#[test]
fn own_lights_are_in_the_tables_of_their_set() {
    let [plain, own] = pair();
    assert_eq!(own.len(), 21, "three lights for each description");
    assert_eq!(own.extents(), plain.extents(), "extents");
    assert_eq!(own.powers(), plain.powers(), "powers");
    assert!(own.infinite_ids().eq(plain.infinite_ids()), "at infinity");
    assert_eq!(own.infinite_ids().len(), 3, "a sun and two skies");
    let owns = own.iter().filter(|(_, l)| matches!(l, LightRef::Own(_)));
    assert_eq!(owns.count(), 7, "the others are triangles");
    let copy = own.clone();
    assert_eq!(copy.extents(), own.extents(), "a copy shares its lights");
}

#[test]
fn own_lights_answer_bit_for_bit_what_they_say() {
    let [plain, own] = pair();
    let mut rng = Rng::new(61);
    let mut found = [0; 5];
    for ((id, a), (_, b)) in plain.iter().zip(own.iter()) {
        assert_eq!(a.light_type(), b.light_type(), "{id:?}");
        assert_eq!(a.media(), b.media(), "{id:?}");
        for i in 0..200 {
            let ctx = LightSampleContext::medium(3.0 * (rng.vec3() - 0.5));
            let (u, v, coverage) = (rng.vec2(), rng.vec2(), PdfCoverage::Complete);
            let li = a.sample_li(&ctx, u, &(), coverage);
            assert_eq!(li, b.sample_li(&ctx, u, &(), coverage), "{id:?}: {i}");
            let to = li.map_or_else(|| rng.direction(), |li| li.wi);
            let pdf = a.pdf_li(&ctx, to, coverage);
            assert_eq!(pdf, b.pdf_li(&ctx, to, coverage), "{id:?}: {i}");
            let le = a.sample_le(u, v, &());
            assert_eq!(le, b.sample_le(u, v, &()), "{id:?}: {i}");
            let ray = le.map_or(EmittedRay::from_point(ctx.p, to), |le| le.ray);
            assert_eq!(a.pdf_le(&ray), b.pdf_le(&ray), "{id:?}: {i}");
            let sky = a.le(ctx.p, to, &());
            assert_eq!(sky, b.le(ctx.p, to, &()), "{id:?}: {i}");
            let hit = a.hit(ctx.p, to);
            assert_eq!(hit, b.hit(ctx.p, to), "{id:?}: {i}");
            let l = |light: &LightRef<'_, Rgb>| hit.map(|at| light.l(&at, -to, &()));
            assert_eq!(l(&a), l(&b), "{id:?}: {i}");
            let lit = l(&a).is_some_and(|l| l != Vec3::ZERO);
            let is_own = matches!(b, LightRef::Own(_));
            let happened = [
                li.is_some(),
                pdf > 0.0,
                le.is_some(),
                sky != Vec3::ZERO,
                lit,
            ];
            for (count, happened) in found.iter_mut().zip(happened) {
                *count += u32::from(happened && is_own);
            }
        }
    }
    assert!(found.iter().all(|&n| n > 50), "found {found:?}");
}

#[test]
fn an_own_light_changes_into_one_of_its_type() {
    let own = |desc: LightDesc<Rgb>| own_twin(desc, scene()).expect("a light");
    let mut builder = LightSetBuilder::<Rgb>::new(scene());
    let lantern = builder.add(own(lamp(1.0).into())).expect("a light");
    let plain = builder.add(lamp(1.0)).expect("a light");
    let mut set = builder.build();
    let phi = |set: &LightSet<Rgb>| set.get(LightId(0)).map(|light| light.phi(&()));

    set.update(lantern, own(lamp(2.0).into())).expect("another");
    assert_eq!(
        phi(&set),
        Some(Vec3::splat(8.0 * core::f32::consts::PI)),
        "2 W/sr"
    );
    let other = Err(LightUpdateError::OtherKind);
    assert_eq!(set.update(lantern, own(sun(1.0).into())), other, "a sun");
    assert_eq!(set.update(lantern, lamp(3.0)), other, "not an own light");
    assert_eq!(
        set.update(plain, own(lamp(3.0).into())),
        other,
        "an own light"
    );
    assert_eq!(
        phi(&set),
        Some(Vec3::splat(8.0 * core::f32::consts::PI)),
        "as before"
    );
}
