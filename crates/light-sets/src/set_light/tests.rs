use super::*;

fn floor() -> SetPoint {
    SetPoint {
        p: Vec3::ZERO,
        n: Vec3::Z,
    }
}

#[test]
fn triangle_emits_from_its_front_only_unless_two_sided() {
    let facing_down = [Vec3::Z, Vec3::Z + Vec3::Y, Vec3::Z + Vec3::X];
    let facing_up = [Vec3::Z, Vec3::Z + Vec3::X, Vec3::Z + Vec3::Y];
    let f = |vertices, two_sided| {
        SetLight::Triangle {
            vertices,
            radiance: 2.0,
            two_sided,
        }
        .contribution(&floor())
    };
    let d2: f64 = 1.0 + 2.0 / 9.0;
    assert!(
        (f(facing_down, false) - 2.0 * 0.5 / (d2 * d2)).abs() < 1e-12,
        "L A cos cos / d^2"
    );
    assert_eq!(f(facing_up, false), 0.0, "from behind");
    assert_eq!(
        f(facing_up, true),
        f(facing_down, false),
        "both sides alike"
    );
}

#[test]
fn spot_is_one_inside_and_zero_outside() {
    let spot = |target| {
        SetLight::Spot {
            p: Vec3::new(0.0, 0.0, 2.0),
            target,
            intensity: 8.0,
            cone_deg: 30.0,
            delta_deg: 10.0,
        }
        .contribution(&floor())
    };
    assert_eq!(spot(Vec3::ZERO), 2.0, "on the axis");
    assert_eq!(spot(Vec3::new(5.0, 0.0, 2.0)), 0.0, "beside the cone");
    let half = spot(Vec3::new(2.0 * 25f32.to_radians().tan(), 0.0, 0.0));
    assert!(half > 0.0 && half < 2.0, "in the soft edge");
}

#[test]
fn bounds_tell_power_and_cone() {
    let b = SetLight::Point {
        p: Vec3::ONE,
        intensity: 1.0,
    }
    .bounds();
    assert_eq!(b.cos_theta_o, -1.0, "all directions");
    let b = SetLight::Triangle {
        vertices: [Vec3::ZERO, Vec3::X, Vec3::Y],
        radiance: 1.0,
        two_sided: true,
    }
    .bounds();
    assert_eq!(b.w, Vec3::Z, "front side");
    assert!(
        (b.phi - core::f32::consts::FRAC_PI_2).abs() < 1e-6,
        "pi A L, not doubled"
    );
}

/// Sums over directions give the same as the closed forms.
#[test]
fn powers_are_those_of_all_directions() {
    let triangle = |two_sided| SetLight::Triangle {
        vertices: [Vec3::ZERO, Vec3::X, 2.0 * Vec3::Y],
        radiance: 3.0,
        two_sided,
    };
    let spot = |cone_deg, delta_deg| SetLight::Spot {
        p: Vec3::ZERO,
        target: Vec3::Z,
        intensity: 2.0,
        cone_deg,
        delta_deg,
    };
    let point = SetLight::Point {
        p: Vec3::ZERO,
        intensity: 2.0,
    };
    let lights = [
        (triangle(false), 3.0 * PI),
        (triangle(true), 6.0 * PI),
        (point, 8.0 * PI),
        (spot(30.0, 0.0), 4.0 * PI * (1.0 - 30f64.to_radians().cos())),
        (spot(70.0, 50.0), spot(70.0, 50.0).power()),
        (spot(180.0, 180.0), 4.0 * PI),
    ];
    for (light, expected) in lights {
        assert!((light.power() / expected - 1.0).abs() < 1e-6, "{light:?}");
        let steps = 20_000;
        let sum: f64 = (0..steps)
            .map(|i| {
                let z = (f64::from(i) + 0.5) / f64::from(steps) * 2.0 - 1.0;
                let direction = DVec3::new((1.0 - z * z).sqrt(), 0.0, z);
                light.intensity_toward(direction, 0.0)
            })
            .sum();
        let sum = 4.0 * PI * sum / f64::from(steps);
        assert!(
            (sum / expected - 1.0).abs() < 1e-3,
            "{light:?}: {sum}, {expected}"
        );
    }
    let narrow = spot(1e-3, 0.0).power();
    let expected = 2.0 * PI * 1e-3f64.to_radians().powi(2);
    assert!(
        (narrow / expected - 1.0).abs() < 1e-6,
        "{narrow}: of a narrow cone"
    );
}

/// A target as near as floats can tell, or as far, still gives a unit axis.
#[test]
fn a_spot_has_a_unit_axis_wherever_it_is_aimed() {
    for reach in [1e-45, 1e-40, 1e-20, 1.0, 1e20, 3e38] {
        let spot = SetLight::Spot {
            p: Vec3::ZERO,
            target: Vec3::new(0.0, reach, -reach),
            intensity: 1.0,
            cone_deg: 30.0,
            delta_deg: 10.0,
        };
        let b = spot.bounds();
        assert_eq!(b.validate(), Ok(()), "{reach}: {b:?}");
        let half = core::f32::consts::FRAC_1_SQRT_2;
        assert!(
            b.w.distance(Vec3::new(0.0, half, -half)) < 1e-6,
            "{reach}: {b:?}"
        );
    }
    assert_eq!(spot_axis(Vec3::ONE, Vec3::ONE), DVec3::Z, "no direction");
}

#[test]
fn bounds_of_a_spot_hold_its_cone() {
    for i in 1..=1800_u16 {
        for delta_deg in [0.0, 1e-4, 0.01, 0.5, 10.0, 180.0] {
            let cone_deg = 0.1 * f32::from(i);
            let delta_deg = f32::min(delta_deg, cone_deg);
            let b = SetLight::Spot {
                p: Vec3::ZERO,
                target: Vec3::X,
                intensity: 1.0,
                cone_deg,
                delta_deg,
            }
            .bounds();
            assert_eq!(b.validate(), Ok(()), "{b:?}");
            let [o, e] = [b.cos_theta_o, b.cos_theta_e].map(|cos| f64::from(cos).acos());
            let [_, end] = cone(cone_deg, delta_deg);
            let slack = o + e - end;
            assert!(
                (-1e-15..1e-3).contains(&slack),
                "{cone_deg}, {delta_deg}: {slack}"
            );
        }
    }
}
