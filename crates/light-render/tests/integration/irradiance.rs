//! What each kind of light gives to a plane, against the irradiance that a formula gives.

use core::f32::consts::PI;
use core::f64::consts::FRAC_1_PI;

use light_render::integrator::Estimator;
use light_scene::glam::{Affine3A, DVec3, Quat, Vec2, Vec3};
use light_scene::{Camera, Emission, Material, Mesh, Scene};
use lights::math::SphereMap;
use lights::math::equal_area::square_to_sphere;
use lights::sources::{
    Channels, EnvironmentMap, GoniometricLightDesc, Image, ImageInfiniteLightDesc, IntensityAmount,
    LightDesc, MediumInterface, PortalInfiniteLightDesc, ProjectionLightDesc, RadianceAmount, Rgb,
    SpotLightDesc, SunAmount, SunLightDesc,
};

use crate::support::{ALL, Shot, plane};

const ALBEDO: f32 = 0.6;
const LIGHT_AND_BOTH: &[Estimator] = &[Estimator::Light, Estimator::Mis];

/// A plane of which the camera sees so little that the irradiance is the same all over the picture.
fn ground() -> Scene {
    let mut scene = plane(ALBEDO, 1.0);
    scene.camera = Camera::look_at(Vec3::Y * 0.3, Vec3::ZERO, Vec3::Z, 1e-3).ok();
    scene
}

/// The picture of a plane under this irradiance has one radiance.
fn assert_irradiance(scene: &Scene, irradiance: DVec3, estimators: &[Estimator]) {
    for &estimator in estimators {
        let shot = Shot::of_direct_light(estimator);
        let radiance = irradiance * f64::from(ALBEDO) * FRAC_1_PI;
        shot.assert_mean(scene, radiance, &format!("{estimator:?}"));
    }
}

/// Under a single light that no ray meets by chance.
fn assert_point(light: LightDesc<Rgb>, irradiance: DVec3) {
    let mut scene = ground();
    scene.lights.push(light);
    assert_irradiance(&scene, irradiance, LIGHT_AND_BOTH);
}

/// From light space to the scene, for a light that looks along z and stands at no special place.
const POSITION: Vec3 = Vec3::new(30.0, 40.0, 0.0);

/// The light at [`POSITION`] turned so that the origin lies in the direction `toward` of light
/// space.
fn aimed(toward: Vec3) -> Affine3A {
    let turn = Quat::from_rotation_arc(toward.normalize(), -POSITION.normalize());
    Affine3A::from_rotation_translation(turn, POSITION)
}

/// The irradiance at the origin from a light at [`POSITION`] of this intensity: cosine over squared
/// distance.
fn from_position(intensity: Vec3) -> DVec3 {
    intensity.as_dvec3() * 0.8 / 2500.0
}

#[test]
fn a_spot_light_fades_by_a_smooth_step_of_the_cosine() {
    let (angle, falloff_start) = (0.5f32, 0.3f32);
    for off_axis in [0.0f32, 0.29, 0.35, 0.4, 0.49, 0.51, 2.0] {
        let light = LightDesc::Spot(SpotLightDesc {
            transform: aimed(Vec3::new(off_axis.sin(), 0.0, off_axis.cos())),
            angle,
            falloff_start,
            emission: Vec3::new(5e3, 2e3, 1e3),
            amount: IntensityAmount::default(),
            media: MediumInterface::default(),
        });
        let [x, start, end] = [off_axis, falloff_start, angle].map(|a| f64::from(a).cos());
        let t = ((x - end) / (start - end)).clamp(0.0, 1.0);
        let falloff = t * t * (3.0 - 2.0 * t);
        assert_point(light, from_position(Vec3::new(5e3, 2e3, 1e3)) * falloff);
    }
}

#[test]
fn a_projected_picture_throws_each_texel_where_it_belongs() {
    // Three texels across, two down; the shorter side spans the angle, each texel of the plane z =
    // 1 is 1 wide.
    let texels: Vec<f32> = (0..18u8).map(|i| f32::from(i) * 100.0).collect();
    let image = Image::from_f32([3, 2], Channels::Rgb, texels).expect("3 x 2");
    for (x, y) in [(0u32, 0u32), (1, 0), (2, 1), (0, 1)] {
        let on_plane = Vec2::new(x as f32 - 1.0, y as f32 - 0.5) + Vec2::new(0.3, -0.2);
        let light = LightDesc::Projection(ProjectionLightDesc {
            transform: aimed(on_plane.extend(1.0)),
            image: image.clone(),
            fov: 0.5 * PI,
            amount: IntensityAmount::Radiometric(2.0),
            media: MediumInterface::default(),
        });
        let first = (y * 3 + x) as f32 * 3.0;
        let intensity = Vec3::new(first, first + 1.0, first + 2.0) * 200.0;
        assert_point(light, from_position(intensity));
    }
    let beside = LightDesc::Projection(ProjectionLightDesc {
        transform: aimed(Vec3::new(0.0, 1.01, 1.0)),
        image,
        fov: 0.5 * PI,
        amount: IntensityAmount::default(),
        media: MediumInterface::default(),
    });
    assert_point(beside, DVec3::ZERO);
}

#[test]
fn a_goniometric_light_has_the_intensity_that_was_measured() {
    let texels: Vec<f32> = (0..16u8).map(f32::from).collect();
    let distribution = Image::from_f32([4, 4], Channels::Gray, texels).expect("4 x 4");
    for (x, y) in [(0u32, 0u32), (1, 2), (3, 1), (2, 2)] {
        let uv = (Vec2::new(x as f32, y as f32) + Vec2::new(0.3, 0.6)) / 4.0;
        let light = LightDesc::Goniometric(GoniometricLightDesc {
            transform: aimed(square_to_sphere(uv)),
            distribution: distribution.clone(),
            emission: Vec3::new(3.0, 2.0, 1.0),
            amount: IntensityAmount::Radiometric(50.0),
            media: MediumInterface::default(),
        });
        let intensity = Vec3::new(3.0, 2.0, 1.0) * 50.0 * (y * 4 + x) as f32;
        assert_point(light, from_position(intensity));
    }
}

#[test]
fn a_sun_gives_the_irradiance_of_its_disk() {
    for radius in [0.01f32, 0.3] {
        let mut scene = ground();
        scene.lights.push(LightDesc::Sun(SunLightDesc {
            direction: Vec3::new(0.6, 0.8, 0.0),
            angular_diameter: 2.0 * radius,
            emission: Vec3::new(3.0, 2.0, 1.0),
            amount: SunAmount::Radiance(RadianceAmount::default()),
        }));
        let solid = f64::from(radius).sin().powi(2) / FRAC_1_PI;
        let irradiance = DVec3::new(3.0, 2.0, 1.0) * solid * 0.8;
        // Rays meet a small sun too rarely for their noise to be known.
        let estimators = if radius > 0.1 { &ALL } else { LIGHT_AND_BOTH };
        assert_irradiance(&scene, irradiance, estimators);
    }
}

/// The irradiance at the origin, whose normal is +y, from a polygon of radiance 1 above it, its
/// corners counter-clockwise seen from there: half the sum over its edges of the angle they span
/// times the cosine between the normal and that of the plane through the edge and the origin
/// (Lambert's formula).
fn from_polygon(corners: &[Vec3]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let edge = |(a, b): (&Vec3, &Vec3)| {
        let [a, b] = [a, b].map(|p| p.as_dvec3().normalize());
        a.angle_between(b) * a.cross(b).normalize().y
    };
    -0.5 * corners.iter().zip(next).map(edge).sum::<f64>()
}

/// A plane under a lamp with these corners, which emits light to where they run counter-clockwise,
/// or to both sides.
fn under_lamp(corners: [Vec3; 4], emission: Emission) -> Scene {
    let mut scene = ground();
    let lamp = scene.add_material(Material {
        emission: Some(emission),
        ..Material::diffuse("lamp", Vec3::ZERO)
    });
    scene.meshes.push(Mesh::quad("lamp", lamp, corners));
    scene
}

/// Tilted, off to a side, and near: seen from the origin its corners run counter-clockwise.
const LAMP: [Vec3; 4] = [
    Vec3::new(-0.5, 0.6, -0.4),
    Vec3::new(1.0, 0.9, -0.4),
    Vec3::new(1.0, 1.3, 1.0),
    Vec3::new(-0.5, 1.0, 1.0),
];

#[test]
fn a_lamp_gives_its_form_factor() {
    let color = Vec3::new(3.0, 2.0, 1.0);
    let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let square = square.map(|(x, z)| Vec3::new(x, 1.0, z));
    // Of a square of side 2 at height 1: 4 / pi * atan(1 / sqrt(2)) / sqrt(2).
    let known = 4.0 * 0.5f64.sqrt() * 0.5f64.sqrt().atan();
    assert!((from_polygon(&square) - known).abs() < 1e-9, "Lambert");
    for corners in [square, LAMP] {
        let scene = under_lamp(corners, Emission::one_sided(color));
        let irradiance = color.as_dvec3() * from_polygon(&corners);
        assert_irradiance(&scene, irradiance, &ALL);
    }
}

#[test]
fn a_lamp_emits_to_its_front_or_to_both_sides() {
    let color = Vec3::new(3.0, 2.0, 1.0);
    let [a, b, c, d] = LAMP;
    let turned = [d, c, b, a];
    let scene = under_lamp(turned, Emission::one_sided(color));
    assert_irradiance(&scene, DVec3::ZERO, &ALL);
    let irradiance = color.as_dvec3() * from_polygon(&LAMP);
    for corners in [LAMP, turned] {
        let scene = under_lamp(corners, Emission::two_sided(color));
        assert_irradiance(&scene, irradiance, &ALL);
    }
}

/// An image of the sky with one texel that is not black.
fn one_texel(map: SphereMap, size: [u32; 2], [x, y]: [u32; 2], color: Vec3) -> EnvironmentMap {
    let mut texels = vec![0.0; (size[0] * size[1] * 3) as usize];
    let first = ((y * size[0] + x) * 3) as usize;
    texels[first..first + 3].copy_from_slice(&color.to_array());
    let image = Image::from_f32(size, Channels::Rgb, texels).expect("an image");
    match map {
        SphereMap::EqualArea => EnvironmentMap::EqualArea(image),
        SphereMap::LatLong => EnvironmentMap::LatLong(image),
    }
}

#[test]
fn a_sky_of_one_texel_gives_its_part_of_the_sphere() {
    use SphereMap::{EqualArea, LatLong};
    /// Points a side at which the cosine is taken.
    const POINTS: u32 = 64;
    let color = Vec3::new(3.0, 2.0, 1.0);
    for (map, size, [x, y]) in [
        (EqualArea, [4, 4], [1, 2]),
        (EqualArea, [8, 8], [6, 1]),
        (EqualArea, [2, 2], [0, 1]),
        (LatLong, [8, 4], [7, 2]),
        (LatLong, [6, 9], [1, 0]),
    ] {
        let extent = Vec2::new(size[0] as f32, size[1] as f32);
        let corner = Vec2::new(x as f32, y as f32);
        // The texel stands high, and does not lie as the image does.
        let middle = map.direction((corner + 0.5) / extent);
        let high = Vec3::new(0.5, 0.8, 0.3).normalize();
        let transform = Affine3A::from_quat(Quat::from_rotation_arc(middle, high));
        let mut scene = ground();
        let sky = ImageInfiniteLightDesc {
            transform,
            map: one_texel(map, size, [x, y], color),
            amount: RadianceAmount::default(),
        };
        scene.lights.push(LightDesc::ImageInfinite(sky));
        let cosines = (0..POINTS * POINTS).map(|i| {
            let within = Vec2::new((i % POINTS) as f32, (i / POINTS) as f32) + 0.5;
            let uv = (corner + within / POINTS as f32) / extent;
            let cosine = transform.transform_vector3(map.direction(uv)).y.max(0.0);
            f64::from(cosine * map.solid_angle_per_area(uv))
        });
        let parts = POINTS * POINTS * size[0] * size[1];
        let integral = cosines.sum::<f64>() / f64::from(parts);
        assert_irradiance(&scene, color.as_dvec3() * integral, &ALL);
    }
}

#[test]
fn a_portal_lets_in_the_sky_that_it_shows() {
    // Upright, as portals are rectangles: the lamp's shadow on a level.
    let window = [(-0.5, -0.4), (1.0, -0.4), (1.0, 1.0), (-0.5, 1.0)];
    let window = window.map(|(x, z)| Vec3::new(x, 0.7, z));
    let color = Vec3::new(3.0, 2.0, 1.0);
    let texels = core::iter::repeat_n(color.to_array(), 64).flatten();
    let image = Image::from_f32([8, 8], Channels::Rgb, texels.collect::<Vec<f32>>());
    let mut scene = ground();
    scene
        .lights
        .push(LightDesc::PortalInfinite(PortalInfiniteLightDesc {
            transform: Affine3A::IDENTITY,
            map: EnvironmentMap::EqualArea(image.expect("8 x 8")),
            amount: RadianceAmount::default(),
            portal: window,
        }));
    let irradiance = color.as_dvec3() * from_polygon(&window);
    assert_irradiance(&scene, irradiance, &ALL);
}
