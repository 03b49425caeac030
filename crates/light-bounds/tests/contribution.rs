//! A light that contributes by its bounds matters, by the exact importance and by that of the compact form.

use light_bounds::glam::Vec3;
use light_bounds::light_math::Aabb;
use light_bounds::{CompactLightBounds, LightBounds, LightSampleContext};
use light_testkit::Rng;

/// Random sets of bounds that are tried.
const ROUNDS: u32 = 200_000;

fn double(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// The angle between two vectors, precise at both ends.
fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let (la, lb) = (dot(a, a).sqrt(), dot(b, b).sqrt());
    let part = |sign: f64| {
        let v: [f64; 3] = core::array::from_fn(|i| a[i] / la + sign * b[i] / lb);
        dot(v, v).sqrt()
    };
    2.0 * part(-1.0).atan2(part(1.0))
}

/// Whether a light at the point `from` of the box may emit toward `p`: in double precision, without a margin.
fn emits(bounds: &LightBounds, from: [f64; 3], p: Vec3) -> bool {
    let p = double(p);
    let way = core::array::from_fn(|i| p[i] - from[i]);
    let away = angle(double(bounds.w), way);
    let nearest = if bounds.two_sided {
        away.min(core::f64::consts::PI - away)
    } else {
        away
    };
    let [o, e] = [bounds.cos_theta_o, bounds.cos_theta_e].map(|c| f64::from(c).acos());
    nearest - o <= e
}

fn cosine(rng: &mut Rng) -> f32 {
    let ulps = |x: f32, n: u32| f32::from_bits(x.to_bits() - n);
    match rng.below(8) {
        0 => 1.0,
        1 => -1.0,
        2 => 0.0,
        3 => ulps(1.0, rng.u32() % 1000),
        4 => -ulps(1.0, rng.u32() % 1000),
        5 => 1.0 - rng.log_range(1e-7, 0.1),
        _ => rng.range(-1.0, 1.0),
    }
}

fn bounds(rng: &mut Rng) -> LightBounds {
    let origin = rng.direction() * [0.0, 1.0, 1e5][rng.below(3)];
    let size = [0.0, 1e-4, 0.1, 1.0, 100.0][rng.below(5)];
    // Flat now and then.
    let flat = Vec3::from_array([0; 3].map(|_| [0.0, 1.0, 1.0][rng.below(3)]));
    // As far from a unit vector as bounds may have it.
    let stretch = 1.0 + 4.5e-6 * [0.0, -1.0, 1.0][rng.below(3)];
    LightBounds {
        bounds: Aabb::new(origin, origin + rng.vec3() * flat * size),
        w: rng.direction() * stretch,
        phi: rng.log_range(1e-3, 1e3),
        cos_theta_o: cosine(rng),
        cos_theta_e: cosine(rng),
        two_sided: rng.below(4) == 0,
    }
}

/// A point in the direction in which the light just ends to emit from `from`, or anywhere.
fn receiver(rng: &mut Rng, bounds: &LightBounds, from: [f64; 3]) -> Vec3 {
    let [o, e] = [bounds.cos_theta_o, bounds.cos_theta_e].map(|c| f64::from(c).acos());
    let inside = [0.0, 1e-8, 1e-6, 1e-4, 3.0 * rng.f64()][rng.below(5)];
    let theta = (o + e).min(core::f64::consts::PI) - inside;
    let (x, y) = bounds.w.any_orthonormal_pair();
    let turn = core::f64::consts::TAU * rng.f64();
    let parts = [
        turn.cos() * theta.sin(),
        turn.sin() * theta.sin(),
        theta.cos(),
    ];
    let [x, y, w] = [x, y, bounds.w].map(double);
    let dist = f64::from(rng.log_range(1e-3, 1e3));
    let at = |i: usize| from[i] + dist * (x[i] * parts[0] + y[i] * parts[1] + w[i] * parts[2]);
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
    Vec3::from_array([0, 1, 2].map(|i| at(i) as f32))
}

#[test]
fn what_contributes_matters() {
    let mut rng = Rng::new(91);
    let (mut lit, mut dark) = (0, 0);
    for _ in 0..ROUNDS {
        let bounds = bounds(&mut rng);
        assert_eq!(bounds.validate(), Ok(()), "{bounds:?}");
        let shares = [0; 3].map(|_| [0.0, 1.0, rng.f64()][rng.below(3)]);
        let [low, high] = [bounds.bounds.min, bounds.bounds.max].map(double);
        let from = core::array::from_fn(|i| low[i] + (high[i] - low[i]) * shares[i]);
        let p = receiver(&mut rng, &bounds, from);
        let all = bounds.bounds.extend(rng.vec3());
        let compact = CompactLightBounds::encode(&bounds, &all);
        let n = rng.direction();
        for ctx in [
            LightSampleContext::medium(p),
            LightSampleContext::surface(p, n, n),
        ] {
            let (exact, coarse) = (bounds.importance(&ctx), compact.importance(&all, &ctx));
            if emits(&bounds, from, p) {
                lit += 1;
                assert!(exact > 0.0, "{bounds:?} from {from:?} to {ctx:?}");
                assert!(
                    coarse > 0.0,
                    "compact {bounds:?} from {from:?} to {ctx:?} in {all:?}"
                );
            } else {
                dark += u32::from(exact == 0.0 && coarse == 0.0);
            }
        }
    }
    assert!(
        lit > ROUNDS / 2 && dark > ROUNDS / 50,
        "{lit} lit, {dark} dark"
    );
}
