use super::*;
use crate::amount::{IrradianceAmount, RadianceAmount};
use crate::rgb::Rgb;
use light_math::float::cos;

fn sun(
    direction: Vec3,
    angular_diameter: f32,
    amount: SunAmount,
) -> Result<SunLight<Rgb>, SunLightError> {
    let scene = SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere");
    let desc = SunLightDesc {
        direction,
        angular_diameter,
        emission: Vec3::ONE,
        amount,
    };
    SunLight::new(desc, scene)
}

/// Of radiance 1.
fn disk(direction: Vec3, angular_diameter: f32) -> SunLight<Rgb> {
    let amount = SunAmount::Radiance(RadianceAmount::default());
    sun(direction, angular_diameter, amount).expect("a sun")
}

#[test]
fn irradiance_fixes_the_radiance() {
    let amount = SunAmount::Irradiance(IrradianceAmount::Radiometric(1.0));
    // Half of the sky of radiance 1 / pi.
    let radiance = sun(Vec3::Y, PI, amount).expect("a sun").radiance.maximum();
    assert!((radiance * PI - 1.0).abs() < 1e-6, "{radiance}");
    // A disk of 0.0093 covers 6.793e-5 sr, all of which face the plane.
    let radiance = sun(Vec3::Y, 0.0093, amount)
        .expect("a sun")
        .radiance
        .maximum();
    assert!((radiance * 6.7929e-5 - 1.0).abs() < 1e-4, "{radiance}");
}

/// Directions to the very rim are directions to the sun, however small it is.
#[test]
fn the_rim_is_met() {
    for diameter in [1e-10, 1e-7, 2e-6, 1e-5, 1e-4, 0.0093, 0.5, PI] {
        for x in [Vec3::new(0.3, 0.8, -0.2), Vec3::new(1.0, 2.0, 3.0), Vec3::Y] {
            let sun = disk(x, diameter);
            for i in 0..64u8 {
                let u = Vec2::new(light_math::float::ONE_MINUS_EPSILON, f32::from(i) / 64.0);
                let wi = sun.sample(u);
                assert!(sun.contains(wi), "{diameter}, {x}, {u}");
                assert!((wi.length() - 1.0).abs() < 1e-6, "{diameter}, {x}, {u}");
            }
            let beside = Vec3::new(sin(0.55 * diameter).max(2e-7), 0.0, cos(0.55 * diameter));
            let beside = sun.frame.from_local(beside).normalize();
            assert!(!sun.contains(beside), "{diameter}: beside");
            assert!(!sun.contains(-sun.frame.z), "{diameter}: opposite");
        }
    }
}

/// Directions of a square around the sun, rounded to single precision.
#[test]
fn densities_of_small_suns_have_the_integral_1() {
    let mut rng = light_testkit::Rng::new(5);
    for (diameter, margin) in [(2e-6, 0.03), (1e-5, 0.01), (1e-4, 0.01), (0.0093, 0.01)] {
        let sun = disk(Vec3::new(1.0, 2.0, 3.0), diameter);
        let [x, y, z] = [sun.frame.x, sun.frame.y, sun.frame.z].map(|axis| axis.as_dvec3());
        let half = 0.75 * f64::from(diameter);
        let n = 1 << 17;
        let mut sum = 0.0;
        for _ in 0..n {
            let [a, b] = [rng.f32(), rng.f32()].map(|u| half * (2.0 * f64::from(u) - 1.0));
            let wi = (x * a + y * b + z).normalize().as_vec3();
            sum += f64::from(sun.pdf(wi));
        }
        let integral = sum * 4.0 * half * half / f64::from(n);
        assert!((integral - 1.0).abs() < margin, "{diameter}: {integral}");
    }
}

/// However small it is: a sampler asks the cone whether the sun is above a horizon.
#[test]
fn the_cone_holds_all_of_the_disk() {
    for diameter in [1e-10, 1e-5, 4.8e-4, 1e-3, 2e-3, 0.0093, 0.5, PI] {
        let LightExtent::Infinite(bounds) = disk(Vec3::Y, diameter).extent() else {
            unreachable!("a sun is infinite");
        };
        let cos = f64::from(bounds.cone.cos_theta);
        let one_minus_cos = 2.0 * (0.25 * f64::from(diameter)).sin().powi(2);
        // Sines of half angles are rounded to a few parts in 10^7.
        assert!(
            1.0 - cos >= one_minus_cos * (1.0 - 1e-6),
            "{diameter}: {cos}"
        );
    }
}

#[test]
fn refuses_nonsense_by_field() {
    let amount = SunAmount::Radiance(RadianceAmount::Radiometric(1.0));
    let error = |direction, diameter| sun(direction, diameter, amount).err();
    assert_eq!(
        error(Vec3::ZERO, 0.1),
        Some(SunLightError::Direction),
        "zero"
    );
    assert_eq!(error(Vec3::NAN, 0.1), Some(SunLightError::Direction), "NaN");
    for diameter in [0.0, -0.1, 3.2, 1e-30, f32::NAN] {
        let expected = Some(SunLightError::AngularDiameter);
        assert_eq!(error(Vec3::X, diameter), expected, "{diameter}");
    }
    let dark = SunAmount::Radiance(RadianceAmount::Radiometric(-1.0));
    let expected = Some(SunLightError::Emission(EmissionError::Amount));
    assert_eq!(sun(Vec3::X, 0.1, dark).err(), expected, "negative");
}
