//! A light that may contribute by its bounds can be chosen, whatever its angles of emission are.

use core::f64::consts::{FRAC_PI_2, PI};

use light_bvh::LightBvh;
use light_bvh::light_bounds::light_math::{Aabb, glam::Vec3};
use light_bvh::light_bounds::{
    EmissionLobe, LightBounds, LightExtent, LightId, LightSampleContext,
};
use light_testkit::Rng;

use crate::support::double::{angle, between, double, tilted};
use crate::support::lamp;

/// Cosines of every kind: both ends and the middle, a few units in the last place away from them,
/// and what lies between.
fn cosines() -> Vec<f32> {
    let ulps = |x: f32, n: u32| f32::from_bits(x.to_bits() - n);
    let magnitudes = [
        1.0,
        ulps(1.0, 1),
        ulps(1.0, 3),
        ulps(1.0, 100),
        0.999,
        0.9,
        0.5,
        ulps(0.5, 1),
        0.25,
        2e-3,
        1e-3,
        9e-4,
        1e-4,
        4.371_139e-8,
        f32::from_bits(1),
    ];
    let both = magnitudes.iter().flat_map(|&c| [c, -c]);
    both.chain([0.0, -0.0]).collect()
}

/// A light at `at` of every pair of angles, one-sided or two-sided.
fn lights_of_every_pair(rng: &mut Rng, at: Vec3, size: f32) -> Vec<LightBounds> {
    let mut lights = Vec::new();
    for cos_theta_o in cosines() {
        for cos_theta_e in cosines() {
            let light = LightBounds {
                bounds: Aabb::new(at, at + rng.vec3() * size),
                w: rng.direction(),
                phi: 1.0,
                cos_theta_o,
                cos_theta_e,
                two_sided: false,
            };
            let two_sided = LightBounds {
                two_sided: true,
                ..light
            };
            lights.extend([light, two_sided]);
        }
    }
    lights
}

/// Whether the light may emit from the point `from` of its box toward `p`, by its bounds: in double
/// precision, without a margin.
fn may_emit(light: &LightBounds, from: Vec3, p: Vec3) -> bool {
    let [o, e] = [light.cos_theta_o, light.cos_theta_e].map(|cos| f64::from(cos).acos());
    // Beyond half a turn there is nothing.
    let reach = (o + e).min(PI);
    let away = angle(double(light.w), between(from, p));
    away <= reach || (light.two_sided && PI - away <= reach)
}

/// Points around `from`: all over, on the axis, and at the edge of the emission and a hair within
/// it.
fn receivers(rng: &mut Rng, light: &LightBounds, from: Vec3) -> Vec<Vec3> {
    let [o, e] = [light.cos_theta_o, light.cos_theta_e].map(|cos| f64::from(cos).acos());
    let reach = (o + e).min(PI);
    let mut directions = vec![light.w, -light.w, rng.direction(), rng.direction()];
    for within in [0.0, 1e-6, 1e-5, 1e-3, 0.1] {
        let w = tilted(light.w, (reach - within).max(0.0), 2.0 * PI * rng.f64());
        directions.extend([w, -w]);
    }
    let distances = [0.01, 1.0, 100.0];
    let far = |(i, w): (usize, &Vec3)| from + *w * distances[i % 3];
    directions.iter().enumerate().map(far).collect()
}

#[test]
fn a_light_alone_is_found_wherever_it_may_emit() {
    let mut rng = Rng::new(71);
    let mut found = 0;
    for size in [0.0, 1e-3] {
        for light in lights_of_every_pair(&mut rng, Vec3::ZERO, size) {
            assert_eq!(light.validate(), Ok(()), "{light:?}");
            let tree = LightBvh::build(&[LightExtent::Bounded(light)]).expect("a valid light");
            let from = light.bounds.max;
            for p in receivers(&mut rng, &light, from) {
                if may_emit(&light, from, p) {
                    let n = rng.direction();
                    let ctx = LightSampleContext::two_sided(p, n, n);
                    assert_eq!(tree.pmf(&ctx, LightId(0)), 1.0, "{light:?} at {p}");
                    assert!(tree.sample(&ctx, 1 << 63).is_some(), "{light:?} at {p}");
                    found += 1;
                }
            }
        }
    }
    assert!(found > 20_000, "{found} pairs");
}

#[test]
fn a_light_among_others_is_found_wherever_it_may_emit() {
    let mut rng = Rng::new(72);
    let lights = lights_of_every_pair(&mut rng, Vec3::ZERO, 1e-3);
    for (i, &light) in lights.iter().enumerate() {
        // A lamp, the next pairs of angles, and two lights that are alike, all around the light.
        let others = (1..8).map(|k| lights[(i + 5 * k) % lights.len()]);
        let mut set = vec![LightExtent::Bounded(light), lamp(Vec3::splat(0.5), 3.0)];
        set.extend(others.map(|other| {
            let bounds = Aabb::from_point(rng.vec3() - 0.5);
            LightExtent::Bounded(LightBounds { bounds, ..other })
        }));
        set.extend([LightExtent::Bounded(light); 2]);
        if i % 16 == 0 {
            set.extend((0..100).map(|_| lamp(rng.vec3() - 0.5, 0.1)));
        }
        let tree = LightBvh::build(&set).expect("valid lights");
        let from = light.bounds.max;
        for p in receivers(&mut rng, &light, from) {
            if may_emit(&light, from, p) {
                let n = rng.direction();
                let pmf = tree.pmf(&LightSampleContext::two_sided(p, n, n), LightId(0));
                assert!(pmf > 0.0, "{light:?} at {p} among {}", set.len());
            }
        }
    }
}

/// Lights whose angles add up to half a turn emit everywhere; 1e-4 less, and they do not emit
/// backward.
#[test]
fn what_emits_everywhere_is_no_needle() {
    #[expect(clippy::cast_possible_truncation, reason = "bounds are rounded")]
    let light = |theta_o: f64, theta_e: f64| LightBounds {
        bounds: Aabb::from_point(Vec3::ZERO),
        w: Vec3::Z,
        phi: 1.0,
        cos_theta_o: theta_o.cos() as f32,
        cos_theta_e: theta_e.cos() as f32,
        two_sided: false,
    };
    let pmf = |light: LightBounds, p: Vec3| {
        let tree = LightBvh::build(&[LightExtent::Bounded(light)]).expect("a valid light");
        tree.pmf(&LightSampleContext::two_sided(p, p, p), LightId(0))
    };
    for (o, e) in [(PI, PI), (PI, 0.0), (0.0, PI), (2.0, 2.0), (PI, 3.0)] {
        for p in [Vec3::Z, Vec3::NEG_Z, Vec3::X, Vec3::new(1e-3, 0.0, -1.0)] {
            assert_eq!(pmf(light(o, e), p), 1.0, "{o} and {e} at {p}");
        }
    }
    assert_eq!(pmf(light(0.2, 0.3), Vec3::NEG_Z), 0.0, "a beam");
    assert_eq!(pmf(light(0.0, FRAC_PI_2), Vec3::NEG_Z), 0.0, "a flat lamp");
}

/// The line of a measured lobe is a mean: what it emits beyond its edge is not known.
#[test]
fn narrow_lobes_may_emit_anywhere() {
    for length in [0.4, 0.7, 0.9, 0.99, 0.9999] {
        let bounds = LightBounds {
            bounds: Aabb::from_point(Vec3::ZERO),
            w: Vec3::NEG_Z,
            phi: 1.0,
            cos_theta_o: -1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        };
        let lobe = EmissionLobe {
            power: 1.0,
            mean: Vec3::NEG_Z * length,
            spread: 0.0,
        };
        let one = LightExtent::Lobe(bounds, lobe);
        for count in [1, 2, 40] {
            let tree = LightBvh::build(&vec![one; count]).expect("valid lights");
            for p in [Vec3::NEG_Z, Vec3::X, Vec3::Z, Vec3::new(0.6, 0.0, -0.8)] {
                let ctx = LightSampleContext::surface(p, -p, -p);
                let pmf = tree.pmf(&ctx, LightId(0));
                assert!(pmf > 0.0, "{count} lobes of {length} at {p}");
            }
        }
    }
}
