use core::f32::consts::PI;

use crate::photometric::model::*;
use light_sources::glam::{Affine3A, Quat, Vec2, Vec3};
use light_sources::light_math::SphereMap;
use light_sources::light_math::spectrum::photometric::Lux;
use light_sources::*;

/// A picture of radiance `value`, by the direction of each texel's middle.
fn picture(map: SphereMap, [w, h]: [u32; 2], value: impl Fn(Vec3) -> Vec3) -> EnvironmentMap {
    let places = (0..h).flat_map(|y| (0..w).map(move |x| Vec2::new(x as f32, y as f32) + 0.5));
    let texels = places.flat_map(|p| {
        let p = p / Vec2::new(w as f32, h as f32);
        value(map.direction(p)).to_array()
    });
    let image = Image::from_f32([w, h], Channels::Rgb, texels.collect::<Vec<_>>());
    let image = image.expect("an image");
    match map {
        SphereMap::EqualArea => EnvironmentMap::EqualArea(image),
        SphereMap::LatLong => EnvironmentMap::LatLong(image),
    }
}

/// Half of the sky, above a plane that leans by an angle, gives `pi (1 + cos) / 2`.
#[test]
fn the_irradiance_of_half_a_sky_is_that_of_its_closed_form() {
    let colour = Vec3::new(2.0, 1.0, 0.5);
    for (map, size, pole) in [
        (SphereMap::LatLong, [64, 32], Vec3::Y),
        (SphereMap::LatLong, [2, 6], Vec3::Y),
        (SphereMap::LatLong, [1500, 1100], Vec3::Y),
    ] {
        let sky = picture(map, size, |w| {
            colour * f32::from(u8::from(w.dot(pole) > 0.0))
        });
        for angle in [0.0, 0.3, 1.2, PI / 2.0, 2.5] {
            let (sin, cos) = f32::sin_cos(angle);
            let normal = cos * pole + sin * Vec3::new(0.6, 0.0, 0.8);
            let exact = PI * (1.0 + cos) / 2.0;
            let off = (sky.irradiance(normal) / colour - exact) / exact;
            assert!(
                off.abs().max_element() < 2e-5,
                "{map:?} {size:?} {angle}: {off}"
            );
        }
    }
    for n in [1, 2, 7, 32, 1025] {
        let sky = picture(SphereMap::EqualArea, [n, n], |_| colour);
        for normal in [Vec3::Z, Vec3::X, Vec3::new(-0.6, 0.48, -0.64)] {
            let off = sky.irradiance(normal) / (PI * colour) - 1.0;
            assert!(off.abs().max_element() < 2e-5, "{n} {normal}: {off}");
        }
    }
}

#[test]
fn a_sky_has_its_illuminance_on_open_ground() {
    skies::<Rgb>("rgb");
    skies::<Spectral<4>>("spectral");
}

fn skies<M: Model>(name: &str) {
    let lux = Lux(20_000.0);
    let up = Vec3::new(0.1, 0.2, 0.9).normalize();
    let turn = Affine3A::from_quat(Quat::from_rotation_x(0.7));
    let uniform = UniformInfiniteLightDesc::new(M::lamp(), RadianceAmount::of_sky(lux));
    near(
        illuminance::<M>(LightDesc::UniformInfinite(uniform), up),
        lux.0,
        name,
    );
    for (map, size) in [
        (SphereMap::LatLong, [12, 9]),
        (SphereMap::EqualArea, [8, 8]),
    ] {
        let sky = picture(map, size, |w| {
            Vec3::ONE * (1.2 + w.y) * f32::from(u8::from(w.x < 0.8))
        });
        let desc = ImageInfiniteLightDesc {
            transform: turn,
            ..ImageInfiniteLightDesc::new(sky)
        };
        let desc = desc.with_illuminance::<M>(lux, 3.0 * up).expect("a sky");
        near(
            illuminance::<M>(LightDesc::ImageInfinite(desc), up),
            lux.0,
            name,
        );
    }
}

/// The illuminance of a plane with the normal `up`, by the midpoint rule over latitudes about it.
fn illuminance<M: Model>(desc: LightDesc<M>, up: Vec3) -> f32 {
    const ROWS: u32 = 300;
    let set = light_set(desc);
    let (_, light) = set.iter().next().expect("a light");
    let (x, y) = up.any_orthonormal_pair();
    M::luminous(|wavelengths| {
        let mut sum = M::Radiance::BLACK;
        for row in 0..ROWS {
            // Even steps of the sine squared are even in cosine times solid angle.
            let sin = ((row as f32 + 0.5) / ROWS as f32).sqrt();
            let mut ring = M::Radiance::BLACK;
            for column in 0..ROWS {
                let (b, a) = f32::sin_cos(2.0 * PI * (column as f32 + 0.5) / ROWS as f32);
                let w = sin * (a * x + b * y) + (1.0 - sin * sin).sqrt() * up;
                ring = ring + light.le(Vec3::ZERO, w, wavelengths);
            }
            sum = sum + ring * (PI / (ROWS * ROWS) as f32);
        }
        sum
    })
}

#[test]
fn a_dark_sky_has_no_illuminance() {
    let below = picture(SphereMap::LatLong, [4, 2], |w| Vec3::splat((-w.y).max(0.0)));
    let desc = ImageInfiniteLightDesc::new(below);
    let amount = Err(ImageInfiniteLightError::Amount);
    let asked = |up| {
        desc.clone()
            .with_illuminance::<Rgb>(Lux(1.0), up)
            .map(|_| ())
    };
    assert_eq!(asked(Vec3::Y), amount, "nothing above");
    assert_eq!(asked(Vec3::ZERO), amount, "no direction");
    assert_eq!(asked(Vec3::NEG_Y), Ok(()), "from below");
}
