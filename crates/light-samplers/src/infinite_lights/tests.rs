use super::*;
use alloc::vec::Vec;
use light_math::fraction;

/// The irradiance of a light in all groups.
fn irradiance(bounds: &InfiniteBounds, ctx: &LightSampleContext) -> f32 {
    let light = StoredInfiniteLight {
        light: LightId(0),
        bounds: *bounds,
        groups: LightGroups::ALL,
    };
    super::irradiance(&light, ctx)
}

fn floor() -> LightSampleContext {
    LightSampleContext::surface(Vec3::ZERO, Vec3::Z, Vec3::Z)
}

#[test]
fn a_uniform_sky_gives_pi_times_its_radiance() {
    let e = irradiance(&InfiniteBounds::uniform(2.0), &floor());
    assert!((e - core::f32::consts::TAU).abs() < 1e-5, "{e}");
}

#[test]
fn a_sun_gives_its_irradiance_times_the_cosine() {
    let up = Vec3::new(0.6, 0.0, 0.8);
    let e = irradiance(&InfiniteBounds::distant(10.0, up), &floor());
    assert!((e - 8.0).abs() < 1e-5, "{e}");
    let e = irradiance(&InfiniteBounds::distant(10.0, -up), &floor());
    assert_eq!(e, 0.0, "set");
    let grazing = InfiniteBounds::distant(10.0, Vec3::X);
    assert!(irradiance(&grazing, &floor()) > 0.0, "rising");
}

#[test]
fn a_medium_takes_all_of_it() {
    let e = irradiance(
        &InfiniteBounds::distant(10.0, Vec3::NEG_Z),
        &LightSampleContext::medium(Vec3::ZERO),
    );
    assert_eq!(e, 10.0, "from below as well");
}

/// A cone of 30 degrees: its upper edge counts, whatever its axis does.
#[test]
fn a_part_of_the_sky_counts_until_all_of_it_has_set() {
    let sky = |below: f32| {
        let w = Vec3::new(float::cos(below), 0.0, -float::sin(below));
        let bounds = InfiniteBounds {
            fluence: 10.0,
            mean: w * 0.95,
            cone: light_math::DirectionCone::new(w, float::cos(30f32.to_radians())),
        };
        irradiance(&bounds, &floor())
    };
    for degrees in [-90.0, 0.0, 20.0, 29.9] {
        assert!(
            sky(f32::to_radians(degrees)) > 0.0,
            "{degrees} degrees below"
        );
    }
    for degrees in [30.1, 45.0, 90.0] {
        assert_eq!(
            sky(f32::to_radians(degrees)),
            0.0,
            "{degrees} degrees below"
        );
    }
}

/// The sine of a narrow cone is known to its last digits.
#[test]
fn narrow_cones_count_to_their_edge() {
    for cos_theta in [1.0 - 1e-6, 1.0 - 1e-5, 1.0 - 1e-4, 1.0 - 1e-3] {
        let theta = f64::from(cos_theta).acos();
        #[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
        let w = Vec3::new(theta.cos() as f32, 0.0, -theta.sin() as f32);
        let bounds = InfiniteBounds {
            fluence: 10.0,
            mean: w,
            cone: light_math::DirectionCone::new(w, cos_theta),
        };
        assert!(irradiance(&bounds, &floor()) > 0.0, "{cos_theta}");
    }
}

/// Lights of fluence 1, 2 and 5, and one that is dark.
fn sky() -> [LightExtent; 4] {
    [1.0, 0.0, 2.0, 5.0].map(|fluence| {
        LightExtent::Infinite(InfiniteBounds {
            fluence,
            ..InfiniteBounds::uniform(1.0)
        })
    })
}

/// Beside a tree of weight 2.
#[test]
fn each_choice_has_its_share_of_u() {
    let lights: Vec<StoredInfiniteLight> = emitting(&sky(), &[]).collect();
    let sky = InfiniteLights::new(&lights).expect("in order");
    let fluence = |light: &StoredInfiniteLight| light.bounds.fluence;
    // Of four weights at most five parts of 2^16 go elsewhere.
    const PARTS: f32 = 5.0 / 65536.0;
    for (u, light, pmf, rest) in [
        (0.1, None, 0.2, 0.5),
        (0.25, Some(0), 0.1, 0.5),
        (0.35, Some(2), 0.2, 0.25),
        (0.75, Some(3), 0.5, 0.5),
        (0.999, Some(3), 0.5, 0.998),
    ] {
        let first = sky.first(fraction::from_f64(u), 2.0, fluence);
        let (chosen, chosen_pmf, chosen_u) = match first.expect("a light") {
            FirstChoice::Others { pmf, u } => (None, pmf, u),
            FirstChoice::Infinite(light) => (Some(light.light.0), light.pmf, light.u),
        };
        assert_eq!(chosen, light, "{u}");
        assert!((chosen_pmf - pmf).abs() <= PARTS, "{u}: {chosen_pmf}");
        let chosen_u = fraction::to_f32(chosen_u);
        assert!(
            (chosen_u - rest).abs() < 20.0 * PARTS,
            "{u}: {chosen_u} is left"
        );
    }
    let pmf = |light| match sky.first_pmf(LightId(light), 2.0, fluence) {
        FirstPmf::Others(pmf) => -pmf,
        FirstPmf::Infinite(pmf) => pmf,
    };
    // A light without fluence is none of these.
    for (light, expected) in [(0, 0.1), (1, -0.2), (2, 0.2), (3, 0.5)] {
        let found = pmf(light);
        assert!((found - expected).abs() <= PARTS, "{light}: {found}");
    }
}

#[test]
fn lights_out_of_order_or_without_valid_bounds_are_refused() {
    let lights: Vec<StoredInfiniteLight> = emitting(&sky(), &[]).collect();
    let swapped = [lights[1], lights[0]];
    let error = InfiniteLights::new(&swapped).map(|_| ());
    assert_eq!(error, Err(InfiniteLightsError::Order), "swapped");
    let twice = [lights[0], lights[0]];
    let error = InfiniteLights::new(&twice).map(|_| ());
    assert_eq!(error, Err(InfiniteLightsError::Order), "twice");
    let mut bad = lights[0];
    bad.bounds.fluence = f32::NAN;
    let error = InfiniteLights::new(core::slice::from_ref(&bad)).expect_err("no fluence");
    let is_named = matches!(
        error,
        InfiniteLightsError::Bounds {
            light: LightId(0),
            ..
        }
    );
    assert!(is_named, "{error}");
}

/// On a two-sided surface a light counts by its distance from the horizon, or by its spread.
#[test]
fn a_surface_that_transmits_has_light_from_both_sides() {
    let ctx = LightSampleContext::two_sided(Vec3::ZERO, Vec3::Z, Vec3::Z);
    let sky = |mean| InfiniteBounds {
        fluence: 10.0,
        mean,
        ..InfiniteBounds::uniform(1.0)
    };
    for (mean, expected) in [
        (Vec3::ZERO, 5.0),
        (Vec3::X * 0.8, 3.0),
        (Vec3::Z * 0.8, 8.0),
        (Vec3::NEG_Z * 0.8, 8.0),
        (Vec3::X, 1e-4),
    ] {
        let e = irradiance(&sky(mean), &ctx);
        assert!((e - expected).abs() < 1e-5, "{mean}: {e}");
    }
}

/// A sun above the horizon by less than the rounding of its height.
#[test]
fn a_sun_that_just_rises_counts() {
    let mut rng = light_testkit::Rng::new(1);
    let mut rising = 0;
    for _ in 0..100_000 {
        let n = rng.direction();
        let sun = n
            .cross(rng.direction())
            .normalize_or(n.any_orthonormal_vector());
        let height: f64 = (0..3).map(|i| f64::from(n[i]) * f64::from(sun[i])).sum();
        if height > 0.0 {
            rising += 1;
            let ctx = LightSampleContext::surface(Vec3::ZERO, n, n);
            let e = irradiance(&InfiniteBounds::distant(1.0, sun), &ctx);
            assert!(e > 0.0, "{sun} over {n}: {height}");
        }
    }
    assert!(rising > 10_000, "{rising}");
}

/// The mean of a sky that is almost all in one direction says nothing of the rest of its cone.
#[test]
fn a_mean_below_the_horizon_or_on_it_gives_nothing_up() {
    let one_sided = floor();
    let both = LightSampleContext::two_sided(Vec3::ZERO, Vec3::Z, Vec3::Z);
    for mean in [Vec3::NEG_Z, Vec3::X] {
        let sky = InfiniteBounds {
            mean,
            ..InfiniteBounds::uniform(1.0)
        };
        for ctx in [one_sided, both] {
            assert!(irradiance(&sky, &ctx) > 0.0, "{mean} at {ctx:?}");
        }
    }
}

/// As far below the horizon as round-off may have put it, a light still counts.
#[test]
fn a_light_at_the_edge_of_the_slack_counts() {
    let at = |height: f32| {
        let up = Vec3::new(1.0, 0.0, height);
        let mut bounds = InfiniteBounds::distant(10.0, Vec3::X);
        (bounds.mean, bounds.cone.w) = (up, up);
        mean_cosine(&bounds, &floor())
    };
    assert!(at(-HORIZON_SLACK) > 0.0, "at the edge");
    assert_eq!(at(-1.001 * HORIZON_SLACK), 0.0, "beyond it");
}
