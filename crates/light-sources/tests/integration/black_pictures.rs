//! Black pictures make lights without power.

use light_sources::glam::{Affine3A, Vec2, Vec3};
use light_sources::*;

#[test]
fn are_accepted_and_never_sampled() {
    let scene = SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere");
    let black = || Image::from_f32([4, 4], Channels::Gray, [0.0; 16]).expect("an image");
    let (transform, amount) = (Affine3A::IDENTITY, RadianceAmount::default());
    let descs = [
        LightDesc::<Rgb>::ImageInfinite(ImageInfiniteLightDesc {
            transform,
            map: EnvironmentMap::EqualArea(black()),
            amount,
        }),
        LightDesc::PortalInfinite(PortalInfiniteLightDesc {
            transform,
            map: EnvironmentMap::EqualArea(black()),
            amount,
            portal: [Vec3::ZERO, Vec3::Y, Vec3::X + Vec3::Y, Vec3::X],
        }),
        LightDesc::Projection(ProjectionLightDesc {
            transform,
            image: black(),
            fov: 1.0,
            amount: IntensityAmount::default(),
            media: MediumInterface::default(),
        }),
    ];
    let mut builder = LightSetBuilder::new(scene);
    for desc in descs {
        builder.add(desc).expect("a dark light");
    }
    let u = Vec2::splat(0.5);
    let ctx = light_bounds::LightSampleContext::medium(Vec3::Z * 0.5);
    let set = builder.build();
    assert!(set.powers().iter().all(|&power| power == 0.0), "no power");
    for (id, light) in set.iter() {
        for coverage in [PdfCoverage::Complete, PdfCoverage::Incomplete] {
            assert!(light.sample_li(&ctx, u, &(), coverage).is_none(), "{id:?}");
        }
        assert!(light.sample_le(u, u, &()).is_none(), "{id:?}");
    }
}
