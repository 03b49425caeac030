use light_sources::glam::{Affine3A, Vec2, Vec3};
use light_sources::light_bounds::LightSampleContext;
use light_sources::*;
use light_testkit::laws::light::*;
use light_testkit::{Cap, Rng};

use crate::laws::scene;

/// A window of 2 by 1 in the plane x = 2 of the scene, light comes from +x.
const PORTAL: [Vec3; 4] = [
    Vec3::new(2.0, -1.0, 0.0),
    Vec3::new(2.0, -1.0, 1.0),
    Vec3::new(2.0, 1.0, 1.0),
    Vec3::new(2.0, 1.0, 0.0),
];

fn light(map: EnvironmentMap) -> PortalInfiniteLight<Rgb> {
    let desc = PortalInfiniteLightDesc {
        transform: Affine3A::from_rotation_y(0.3),
        map,
        amount: RadianceAmount::Radiometric(2.0),
        portal: PORTAL,
    };
    PortalInfiniteLight::new(desc, scene()).expect("a portal")
}

#[test]
fn portal() {
    let texels: Vec<f32> = (0..256u16).map(|i| 1.0 + f32::from(i % 7)).collect();
    let image = Image::from_f32([16, 16], Channels::Gray, texels).expect("an image");
    let light = light(EnvironmentMap::EqualArea(image));
    let mut case = LightCase::<Rgb, _>::around("portal", &light, Vec3::ZERO, 1.0, 4);
    // Points on the side to which the light goes.
    case.contexts
        .iter_mut()
        .for_each(|ctx| ctx.p.x = -ctx.p.x.abs());
    let sky = light.rectified().clone();
    let radiance = |p: Vec3, wi: Vec3| {
        let at = p + wi * ((2.0 - p.x) / wi.x);
        if !(wi.x > 0.0 && at.y.abs() < 1.0 && (0.0..1.0).contains(&at.z)) {
            return 0.0;
        }
        // Angles from the axis +x in both planes, x of the map along y and y along z.
        let uv = Vec2::new(wi.y.atan2(wi.x), wi.z.atan2(wi.x)) / core::f32::consts::PI + 0.5;
        2.0 * f64::from(sky.nearest(uv).x)
    };
    let cap = |p: Vec3| {
        let to = PORTAL.map(|corner| (corner - p).normalize());
        let axis = to.iter().sum::<Vec3>();
        let angle = to
            .map(|w| w.angle_between(axis))
            .into_iter()
            .fold(0.0, f32::max);
        Cap::new(axis, f64::from(angle) + 1e-3)
    };
    li_follows_its_density(&case, cap, radiance);
    li_adds_up(&case, cap, radiance);
    le_adds_up_to_phi(&case);
    le_directions_follow_their_density(&case, &Cap::sphere(), Vec3::ZERO);
    // Behind the window, where its light goes.
    rays_and_samples_light_alike(&case, Vec3::new(-0.5, 0.2, 0.3), 2.0);
    bounds_hold(&case);
    edges_are_survived(&case);
}

/// Through a window in front of a uniform sky comes pi L A, and every ray passes the window.
#[test]
fn power_is_that_of_the_window() {
    let sky = |n: u32| {
        let image = Image::from_f32([n, n], Channels::Gray, vec![1.0; (n * n) as usize]);
        light(EnvironmentMap::EqualArea(image.expect("an image")))
    };
    let expected = core::f32::consts::PI * 2.0 * 2.0;
    for n in [1, 2, 5, 64] {
        let phi = sky(n).phi(&()).x;
        assert!(
            (phi / expected - 1.0).abs() < 1e-5,
            "{n}: {phi}, {expected}"
        );
    }
    let light = sky(64);
    let mut rng = Rng::new(5);
    for _ in 0..1000 {
        let sample = light.sample_le(rng.vec2(), rng.vec2(), &()).expect("a ray");
        let ray = sample.ray;
        let at = ray.origin + ray.direction * ((2.0 - ray.origin.x) / ray.direction.x);
        assert!(
            at.y.abs() < 1.0001 && (at.z - 0.5).abs() < 0.5001,
            "through the window: {at}"
        );
        assert!(
            ray.direction.x < 0.0 && ray.origin.length() > 5.0,
            "from outside: {ray:?}"
        );
    }
}

/// Rays along the portal pass it nowhere, and the first and the last random number are no
/// exception.
#[test]
fn rays_along_the_portal() {
    let image = Image::from_f32([4, 4], Channels::Gray, vec![1.0; 16]).expect("an image");
    let light = light(EnvironmentMap::EqualArea(image));
    let ray = EmittedRay::from_point(Vec3::new(1.0, 3.0, 0.5), Vec3::NEG_Y);
    assert_eq!(light.pdf_le(&ray).pos, 0.0, "along the portal");
    let ends = [0.0, 0.5, light_math::float::ONE_MINUS_EPSILON];
    for u1 in ends.map(|y| ends.map(|x| Vec2::new(x, y))).concat() {
        let Some(sample) = light.sample_le(u1, Vec2::splat(0.5), &()) else {
            continue;
        };
        assert!(sample.pdf.pos.is_finite(), "{u1}: {sample:?}");
        // The light is at +x, the map's x along y and its y along z.
        let side = |u: f32| if u == 0.5 { 0.0 } else { (u - 0.5).signum() };
        let to_light = -sample.ray.direction;
        let [y, z] =
            [to_light.y, to_light.z].map(|x| if x.abs() < 1e-6 { 0.0 } else { x.signum() });
        assert!([y, z] == [side(u1.x), side(u1.y)], "{u1}: {sample:?}");
    }
}

/// Behind the portal, and beside it, there is exactly nothing.
#[test]
fn nothing_comes_from_beside() {
    let image = Image::from_f32([4, 4], Channels::Gray, vec![1.0; 16]).expect("an image");
    let light = light(EnvironmentMap::EqualArea(image));
    let behind = LightSampleContext::medium(Vec3::new(2.5, 0.0, 0.5));
    let sample = light.sample_li(&behind, Vec2::splat(0.5), &(), PdfCoverage::Complete);
    assert!(sample.is_none(), "behind");
    for p in [Vec3::ZERO, Vec3::new(1.0, 3.0, 0.0)] {
        let ctx = LightSampleContext::medium(p);
        let beside = (Vec3::new(2.0, 1.1, 0.5) - p).normalize();
        assert_eq!(
            light.pdf_li(&ctx, beside, PdfCoverage::Complete),
            0.0,
            "density beside"
        );
        assert_eq!(light.le(p, beside, &()), Vec3::ZERO, "radiance beside");
        let inside = (Vec3::new(2.0, 0.5, 0.5) - p).normalize();
        assert!(light.le(p, inside, &()).x > 0.0, "radiance inside");
    }
}

/// Samples on all edges of the square of random numbers have the density of what they chose.
#[test]
fn samples_on_the_edges_of_the_portal_pass_it() {
    let image = Image::from_f32([8, 8], Channels::Gray, vec![1.0; 64]).expect("an image");
    let light = light(EnvironmentMap::EqualArea(image));
    let mut rng = Rng::new(82);
    let (mut missed, mut rays_missed) = (0u32, 0u32);
    const COUNT: u32 = 2000;
    for _ in 0..COUNT {
        let edge = [0.0, light_math::float::ONE_MINUS_EPSILON][rng.below(2)];
        let along = rng.f32();
        let u = [Vec2::new(edge, along), Vec2::new(along, edge)][rng.below(2)];
        let p = Vec3::new(2.0 - rng.log_range(0.01, 30.0), 0.0, 0.5) + rng.direction() * 0.005;
        let ctx = LightSampleContext::medium(p);
        let sample = light.sample_li(&ctx, u, &(), PdfCoverage::Complete);
        let sample = sample.expect("in front of the window");
        missed += u32::from(light.pdf_li(&ctx, sample.wi, PdfCoverage::Complete) == 0.0);
        let ray = light.sample_le(rng.vec2(), u, &()).expect("a ray").ray;
        rays_missed += u32::from(light.pdf_le(&ray).pos == 0.0);
    }
    assert!(missed * 200 <= COUNT, "{missed} of {COUNT} directions miss");
    assert!(
        rays_missed * 200 <= COUNT,
        "{rays_missed} of {COUNT} rays miss"
    );
}
