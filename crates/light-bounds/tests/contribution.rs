//! A light that contributes by its bounds matters, by the exact importance and by that of the
//! compact form.

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

/// Whether a light at the point `from` of the box may emit toward `p`: in double precision, without
/// a margin.
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
    // Some boxes are flat.
    let flat = Vec3::from_array([0; 3].map(|_| [0.0, 1.0, 1.0][rng.below(3)]));
    // A vector as far from unit length as bounds may hold.
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

/// `SIN_GROWTH`: just outside of its sphere, a box subtends almost a right angle, and how much less
/// depends on the last digits of the sine.
#[test]
fn a_light_in_the_corner_of_its_box_matters_just_beside_the_corner() {
    let mut rng = Rng::new(11);
    let mut emitted = 0;
    for _ in 0..ROUNDS {
        let half = Vec3::from_array([0; 3].map(|_| rng.range(0.1, 1.0)));
        let center = rng.direction();
        let corner = center + half;
        let aside = half.cross(rng.direction()).normalize_or(Vec3::X);
        let p = corner + aside * rng.log_range(1e-5, 1e-2) + half * rng.log_range(1e-8, 1e-5);
        let box_of_light = Aabb::new(center - half, corner);
        let way = (p - box_of_light.max).normalize_or(Vec3::X);
        // Turned away, from beyond the box, by almost all of the angle up to which it emits.
        let theta_e = rng.range(0.1, 1.5);
        let away = (way - half.normalize() * way.dot(half.normalize())).normalize_or(Vec3::X);
        let from_light = (p - box_of_light.center()).normalize();
        let turned = (away - from_light * away.dot(from_light)).normalize_or(Vec3::X);
        let w = (way * theta_e.cos() + (turned * from_light.dot(way) - from_light) * theta_e.sin())
            .normalize_or(Vec3::X);
        let bounds = LightBounds {
            bounds: box_of_light,
            w,
            phi: 1.0,
            cos_theta_o: 1.0,
            #[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
            cos_theta_e: angle(
                double(w),
                core::array::from_fn(|i| double(p)[i] - double(box_of_light.max)[i]),
            )
            .cos() as f32,
            two_sided: false,
        };
        if bounds.validate().is_ok() && emits(&bounds, double(box_of_light.max), p) {
            emitted += 1;
            let importance = bounds.importance(&LightSampleContext::medium(p));
            assert!(importance > 0.0, "{bounds:?} at {p}");
        }
    }
    assert!(emitted > ROUNDS / 10, "{emitted}");
}

/// The floor of the cosines: near the horizon, and near the edge of an emission of a right angle,
/// rounding may leave nothing of a cosine. Without it the least importance would be left, however
/// much arrives.
#[test]
fn importance_is_no_less_than_what_a_point_sends() {
    let mut rng = Rng::new(12);
    let (mut grazing, mut worst) = (0, 0.0f64);
    for _ in 0..ROUNDS {
        let (n, p) = (rng.direction(), rng.direction());
        let across = |n: Vec3, rng: &mut Rng| {
            n.cross(rng.direction())
                .normalize_or(n.any_orthonormal_vector())
        };
        let at = p + across(n, &mut rng) * rng.log_range(1e-2, 1e2);
        let way: [f64; 3] = core::array::from_fn(|i| double(at)[i] - double(p)[i]);
        // Half of the lights emit light past the point.
        let w = if rng.below(2) == 0 {
            across((at - p).normalize(), &mut rng)
        } else {
            (p - at).normalize()
        };
        let light = LightBounds {
            bounds: Aabb::from_point(at),
            w,
            phi: 1.0,
            cos_theta_o: 1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        };
        let dist_sq = dot(way, way);
        let cos = |v: Vec3| dot(double(v), way) / dist_sq.sqrt();
        let (received, emitted) = (cos(n).abs(), -cos(w));
        if emitted > 0.0 && received < 1e-6 {
            grazing += 1;
            let sent = received * emitted / dist_sq;
            let importance = light.importance(&LightSampleContext::surface(p, n, n));
            worst = worst.max(sent / f64::from(importance));
        }
    }
    assert!(grazing > ROUNDS / 100, "{grazing}");
    assert!(worst <= 1.0 + 1e-5, "{worst} times the importance");
}
