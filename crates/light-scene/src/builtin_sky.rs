use core::f32::consts::{PI, TAU};
use core::fmt;
use core::str::FromStr;

use lights::sources::{
    IrradianceAmount, LightDesc, RadianceAmount, SunAmount, SunLightDesc, UniformInfiniteLightDesc,
};

use crate::glam::{Affine3A, Quat, Vec3};
use crate::{Image, Scene};

/// A sky that the program brings along.
///
/// # Source
/// `[CIES011]`, types 16 and 12 of the standard skies; the colours are a choice of this crate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuiltinSky {
    /// White from all directions, of radiance 1 W m^-2 sr^-1.
    Uniform,
    /// A blue sky with the sun 60 degrees high, 100 times as bright as its sky.
    ClearNoon,
    /// Grey clouds, three times as bright overhead as at the horizon.
    Overcast,
}

/// Rows of the images; they have twice as many columns.
const ROWS: u16 = 128;

/// Radiance of the overcast sky overhead, and of the blue one before its colour: a piece of white
/// paper that lies in the open is about as bright under all skies.
const ZENITH: f32 = 1.3;

/// The share of light that the ground below the horizon reflects.
const GROUND: f32 = 0.2;

/// The sun's height above the horizon.
const SUN_HEIGHT: f32 = PI / 3.0;

impl BuiltinSky {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Uniform, Self::ClearNoon, Self::Overcast];

    /// The name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::ClearNoon => "clear-noon",
            Self::Overcast => "overcast",
        }
    }

    /// Puts the sky around a scene in which `up`, of length 1, points away from the ground.
    ///
    /// # Panics
    /// Never: the images are valid.
    pub fn add_to(self, scene: &mut Scene, up: Vec3) {
        let turned = Affine3A::from_quat(Quat::from_rotation_arc(Vec3::Y, up));
        match self {
            Self::Uniform => {
                let amount = RadianceAmount::default();
                let light = UniformInfiniteLightDesc::new(Vec3::ONE, amount);
                scene.lights.push(LightDesc::UniformInfinite(light));
            }
            Self::Overcast => {
                let sky = image(|d| Vec3::splat(ZENITH * (1.0 + 2.0 * d.y) / 3.0));
                scene.add_sky(&sky, turned).expect("a valid image");
            }
            Self::ClearNoon => {
                let sun = toward_sun();
                let sky = image(|d| clear(d, sun));
                let upward = irradiance(&sky).y;
                scene.add_sky(&sky, turned).expect("a valid image");
                let irradiance = 5.0 * upward / SUN_HEIGHT.sin();
                scene.lights.push(LightDesc::Sun(SunLightDesc {
                    direction: turned.transform_vector3(sun),
                    angular_diameter: 0.0093,
                    emission: Vec3::new(1.0, 0.95, 0.85),
                    amount: SunAmount::Irradiance(IrradianceAmount::Radiometric(irradiance)),
                }));
            }
        }
    }
}

/// Toward the sun, behind the shoulder of who looks along -z.
fn toward_sun() -> Vec3 {
    let (sin, cos) = SUN_HEIGHT.sin_cos();
    Vec3::new(-0.6 * cos, sin, 0.8 * cos)
}

/// The radiance of a clear sky: type 12 of the standard, with blue overhead and white at the
/// horizon and around the sun.
fn clear(d: Vec3, sun: Vec3) -> Vec3 {
    let gradation = |cos_zenith: f32| 1.0 - (-0.32 / cos_zenith.max(1e-3)).exp();
    let indicatrix = |angle: f32| {
        let near = (-3.0 * angle).exp() - (-1.5 * PI).exp();
        1.0 + 10.0 * near + 0.45 * angle.cos() * angle.cos()
    };
    let from_sun = d.dot(sun).clamp(-1.0, 1.0).acos();
    let overhead = gradation(1.0) * indicatrix(0.5 * PI - SUN_HEIGHT);
    let luminance = 0.5 * ZENITH * gradation(d.y) * indicatrix(from_sun) / overhead;
    let blue = Vec3::new(0.55, 0.95, 2.2);
    let white = (1.0 - d.y).powi(4).max((-3.0 * from_sun).exp());
    blue.lerp(Vec3::ONE, white.clamp(0.0, 1.0)) * luminance
}

/// An image of the upper half of the sky, above a ground that it lights.
fn image(sky: impl Fn(Vec3) -> Vec3) -> Image {
    let columns = 2 * ROWS;
    let upper = (0..ROWS / 2).flat_map(|row| (0..columns).map(move |column| (row, column)));
    let mut texels: Vec<Vec3> = upper
        .map(|(row, column)| sky(direction(row, column)).max(Vec3::ZERO))
        .collect();
    let half = Image::new(u32::from(columns), u32::from(ROWS / 2), texels.clone());
    let lit = irradiance(&half.expect("half of the rows"));
    texels.resize(2 * texels.len(), lit * GROUND / PI);
    Image::new(u32::from(columns), u32::from(ROWS), texels).expect("all of the rows")
}

/// The direction of the middle of a texel, y up.
fn direction(row: u16, column: u16) -> Vec3 {
    let theta = (f32::from(row) + 0.5) / f32::from(ROWS) * PI;
    let phi = (f32::from(column) + 0.5) / f32::from(2 * ROWS) * TAU;
    let ((sin_theta, cos_theta), (sin_phi, cos_phi)) = (theta.sin_cos(), phi.sin_cos());
    Vec3::new(sin_theta * sin_phi, cos_theta, -sin_theta * cos_phi)
}

/// What level ground gets from the upper half of a sky.
fn irradiance(sky: &Image) -> Vec3 {
    let texel_of = |row: u16, column: u16| sky.texel(u32::from(column), u32::from(row));
    let step = PI / f32::from(ROWS);
    let rows = (0..ROWS / 2).map(|row| {
        let sum: Vec3 = (0..2 * ROWS).map(|column| texel_of(row, column)).sum();
        let theta = (f32::from(row) + 0.5) * step;
        sum * (theta.sin() * theta.cos() * step * step)
    });
    rows.sum()
}

impl fmt::Display for BuiltinSky {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for BuiltinSky {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = Self::ALL.into_iter().find(|sky| sky.name() == text);
        known.ok_or_else(|| {
            let names: Vec<&str> = Self::ALL.iter().map(|sky| sky.name()).collect();
            format!("expected a sky: {}", names.join(", "))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lights::sources::{EnvironmentMap, ImageInfiniteLightDesc};

    fn lights(sky: BuiltinSky, up: Vec3) -> Vec<LightDesc<lights::sources::Rgb>> {
        let mut scene = Scene::default();
        sky.add_to(&mut scene, up);
        scene.lights
    }

    #[test]
    fn names_are_read_back() {
        for sky in BuiltinSky::ALL {
            assert_eq!(sky.to_string().parse(), Ok(sky), "{sky}");
        }
        let error = "night".parse::<BuiltinSky>();
        let expected = "expected a sky: uniform, clear-noon, overcast";
        assert_eq!(error, Err(expected.to_owned()), "the names");
    }

    /// With the brightness 1 + 2 sin of the height, over 3, the ground gets 7 pi / 9 of the zenith.
    #[test]
    fn the_overcast_sky_is_three_times_as_bright_overhead() {
        let sky = image(|d| Vec3::splat(ZENITH * (1.0 + 2.0 * d.y) / 3.0));
        let [top, horizon] = [0, u32::from(ROWS) / 2 - 1].map(|row| sky.texel(7, row).y);
        assert!((top / horizon - 3.0).abs() < 0.1, "{top} and {horizon}");
        let expected = 7.0 * PI / 9.0 * ZENITH;
        assert!(
            (irradiance(&sky).y / expected - 1.0).abs() < 1e-3,
            "its light"
        );
        let ground = sky.texel(0, u32::from(ROWS) - 1).y;
        assert!(
            (ground / (expected * GROUND / PI) - 1.0).abs() < 1e-3,
            "the ground"
        );
    }

    #[test]
    fn the_sun_stands_high_above_what_is_up() {
        for up in [Vec3::Y, Vec3::Z, Vec3::NEG_Y] {
            let lights = lights(BuiltinSky::ClearNoon, up);
            let [
                LightDesc::ImageInfinite(ImageInfiniteLightDesc { transform, .. }),
                LightDesc::Sun(sun),
            ] = &lights[..]
            else {
                panic!("a sky and a sun, not {lights:?}");
            };
            assert!(
                (sun.direction.dot(up) - SUN_HEIGHT.sin()).abs() < 1e-5,
                "60 degrees"
            );
            assert!(
                transform.transform_vector3(Vec3::Y).distance(up) < 1e-5,
                "its sky"
            );
        }
        let overcast = lights(BuiltinSky::Overcast, Vec3::Y);
        let [LightDesc::ImageInfinite(desc)] = &overcast[..] else {
            panic!("clouds alone, not {overcast:?}");
        };
        let EnvironmentMap::LatLong(_) = desc.map else {
            panic!("rows of latitude");
        };
    }

    /// The brightest place of the blue sky is around the sun, and no texel is broken.
    #[test]
    fn the_clear_sky_is_brightest_around_the_sun_and_blue_away_from_it() {
        let sun = toward_sun();
        let near = clear((sun + Vec3::X * 0.02).normalize(), sun);
        let away = clear(Vec3::new(-sun.x, 0.8, -sun.z).normalize(), sun);
        assert!(near.y > 4.0 * away.y, "{near} and {away}");
        assert!(away.z > 1.5 * away.x, "blue: {away}");
        let sky = image(|d| clear(d, sun));
        let all = sky.texels().iter();
        assert!(
            all.clone().all(|t| t.is_finite() && t.min_element() >= 0.0),
            "light"
        );
    }
}
