//! The edges of pictures: what is sampled there is found again by its direction, however wide the
//! picture.

use light_math::float::ONE_MINUS_EPSILON;
use light_sources::glam::{Affine3A, Quat, Vec2, Vec3};
use light_sources::light_bounds::LightSampleContext;
use light_sources::shape::{BilinearPatch, BilinearPatchError};
use light_sources::*;

fn white() -> Image {
    Image::from_f32([1, 1], Channels::Gray, [1.0]).expect("an image")
}

fn turn(i: u8) -> Affine3A {
    let axis = Vec3::new(1.0, 0.3 * f32::from(i), -0.5).normalize();
    Affine3A::from_quat(Quat::from_axis_angle(axis, 0.7 * f32::from(i)))
}

fn corners() -> impl Iterator<Item = Vec2> {
    let ends = [0.0, 0.3, ONE_MINUS_EPSILON];
    ends.into_iter()
        .flat_map(move |x| ends.map(|y| Vec2::new(x, y)))
}

fn projection(fov: f32, transform: Affine3A) -> Result<ProjectionLight<Rgb>, ProjectionLightError> {
    ProjectionLight::new(ProjectionLightDesc {
        transform,
        image: white(),
        fov,
        amount: IntensityAmount::Radiometric(1.0),
        media: MediumInterface::default(),
    })
}

#[test]
fn rays_at_the_edge_of_a_projection_are_found_again() {
    for fov in [1e-4, 0.01, 1.0, 2.0, 2.8, 3.1] {
        for i in 0..16 {
            let light = projection(fov, turn(i)).expect("a projection");
            for u in corners() {
                let sample = light.sample_le(u, Vec2::ZERO, &()).expect("a ray");
                let asked = light.pdf_le(&sample.ray).dir;
                // What a direction rounds off, beside the size of the picture, and beside the angle
                // to a half space.
                let rounding = 1e-6 / (0.5 * fov).tan() + 1e-5 * (0.5 * fov).tan();
                let difference = (asked - sample.pdf.dir).abs();
                assert!(
                    difference <= (1e-4 + rounding) * sample.pdf.dir,
                    "{asked}, not {}, for {u} at {fov}, turn {i}",
                    sample.pdf.dir
                );
            }
        }
    }
}

#[test]
fn a_picture_that_directions_cannot_resolve_is_refused() {
    for fov in [1e-7, 1e-6, core::f32::consts::PI * (1.0 - 1e-6)] {
        let error = projection(fov, Affine3A::IDENTITY).map(|_| ()).err();
        assert_eq!(error, Some(ProjectionLightError::Fov), "{fov}");
    }
}

#[test]
fn light_through_the_corner_of_a_portal_arrives() {
    let portal = [Vec3::ZERO, Vec3::Y, Vec3::Y + Vec3::X, Vec3::X];
    for i in 0..16 {
        let transform = turn(i);
        let desc = PortalInfiniteLightDesc {
            transform: Affine3A::IDENTITY,
            map: EnvironmentMap::EqualArea(white()),
            amount: RadianceAmount::Radiometric(1.0),
            portal: portal.map(|p| transform.transform_point3(p)),
        };
        let scene = SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere");
        let light = PortalInfiniteLight::<Rgb>::new(desc, scene).expect("a portal");
        for p in [Vec3::new(0.3, 0.6, 1.0), Vec3::new(-2.0, 3.0, 0.2)] {
            // From both sides, as light passes one way only.
            for p in [p, p * Vec3::new(1.0, 1.0, -1.0)] {
                let p = transform.transform_point3(p);
                let ctx = LightSampleContext::medium(p);
                for u in corners() {
                    let sample = light.sample_li(&ctx, u, &(), PdfCoverage::Complete);
                    let Some(sample) = sample else { continue };
                    let l = light.le(p, sample.wi, &());
                    assert_eq!(l, sample.l, "{u}, from {p}, turn {i}");
                }
            }
        }
    }
}

#[test]
fn a_patch_whose_area_is_rounding_is_refused() {
    // All corners on a line, but for the least number.
    let p = Vec3::new(-1.945_312_5, 0.0, -2.0);
    let corners = [Vec3::ZERO, p, Vec3::NEG_Y * f32::MIN_POSITIVE, Vec3::ZERO];
    let error = BilinearPatch::new(corners).err();
    assert_eq!(error, Some(BilinearPatchError::Area), "no area");
}
