//! Placed lights far from the origin of their prototype, of which none that contributes is lost to
//! the rounding of the transform, and far from the receiver, where they count by their powers.

use light_bvh::light_bounds::light_math::Aabb;
use light_bvh::light_bounds::light_math::glam::{Quat, Vec3};
use light_bvh::light_bounds::{LightBounds, LightExtent, LightId, LightSampleContext};
use light_bvh::{InstancedLightBvh, LightPrototype, PlacedLight, Placement};
use light_testkit::Rng;

fn double(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

/// A lamp that shines into a half space, and a receiver just before its plane or just below its
/// horizon, as double precision says.
#[test]
fn lights_at_a_horizon_are_found() {
    let mut rng = Rng::new(5);
    let (mut lit, mut lost) = (0, 0);
    for _ in 0..4000 {
        let (p, w) = (rng.direction() * rng.log_range(1.0, 1e5), rng.direction());
        let lamp = LightBounds {
            bounds: Aabb::from_point(p),
            w,
            phi: 1.0,
            cos_theta_o: 1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        };
        let (axis, turn) = (rng.direction(), rng.f32() * 6.0);
        let (turn, by) = (Quat::from_axis_angle(axis, turn), rng.direction() * 3.0);
        let prototype = LightPrototype::new(&[LightExtent::Bounded(lamp)]).expect("a lamp");
        let placed = Placement::new(0, turn, 1.0, by).expect("a rigid transform");
        let tree = InstancedLightBvh::build(vec![prototype], &[placed]).expect("a tree");
        let turned = |v: Vec3| rotated(turn, double(v));
        let (at, axis) = (plus(turned(p), double(by)), turned(w));
        // Within the rounding of the plane of the lamp, which is the receiver's horizon, too.
        let near = dot(at, at).sqrt() * 1e-7 * f64::from(rng.f32() - 0.5);
        let aside = cross(axis, double(rng.direction()));
        let place = plus(plus(at, aside), axis.map(|x| near * x));
        let place = single(place);
        let n = -single(axis);
        let ctx = LightSampleContext::surface(place, n, n);
        let to_lamp = plus(at, double(-place));
        if dot(to_lamp, double(n)) > 0.0 && dot(to_lamp, axis) < 0.0 {
            lit += 1;
            let light = PlacedLight {
                placement: 0,
                light: LightId(0),
            };
            lost += u32::from(tree.pmf(&ctx, light) <= 0.0);
        }
    }
    assert!(lit > 1000, "{lit} receivers are lit");
    assert_eq!(lost, 0, "of {lit} lit receivers");
}

/// A wall of windows as a street lies before it: of lights that are far away and all in front the
/// powers tell all, of others the places do.
#[test]
fn lights_of_a_far_wall_count_by_their_powers() {
    let mut rng = Rng::new(6);
    let windows: Vec<_> = (0..100)
        .map(|_| {
            LightExtent::Bounded(LightBounds {
                bounds: Aabb::from_point(Vec3::new(0.0, rng.f32(), rng.f32())),
                w: Vec3::X,
                phi: rng.log_range(0.1, 10.0),
                cos_theta_o: 1.0,
                cos_theta_e: 0.0,
                two_sided: false,
            })
        })
        .collect();
    let prototype = LightPrototype::new(&windows).expect("valid lights");
    let placed = [Vec3::ZERO, 1e3 * Vec3::NEG_X].map(|at| Placement::at(0, at));
    let tree = InstancedLightBvh::build(vec![prototype], &placed).expect("a tree");
    let share = |placement, light, pmf: &dyn Fn(PlacedLight) -> f32| {
        let all = (0..100).map(|light| PlacedLight {
            placement,
            light: LightId(light),
        });
        let sum: f32 = all.clone().map(pmf).sum();
        let light = all.clone().nth(light).expect("a window");
        (pmf(light), pmf(light) / sum)
    };
    let is_by_power = |ctx: &LightSampleContext, placement| {
        let here = tree.at(ctx);
        (0..100).all(|light| {
            let (pmf, of_wall) = share(placement, light, &|light| tree.pmf(ctx, light));
            let (_, by_power) = share(placement, light, &|light| tree.pmf_emitter(light));
            let (at, _) = share(placement, light, &|light| here.pmf(light));
            assert_eq!(at, pmf, "light {light} of wall {placement}, {ctx:?}");
            assert!(pmf > 0.0, "light {light} of wall {placement}, {ctx:?}");
            (of_wall - by_power).abs() <= 1e-5 * by_power
        })
    };
    let surface = |p, n| LightSampleContext::surface(p, n, n);
    let near = Vec3::new(2.0, 0.5, 0.5);
    let away = Vec3::new(200.0, 0.5, 0.5);
    for ctx in [surface(near, Vec3::NEG_X), LightSampleContext::medium(near)] {
        assert!(!is_by_power(&ctx, 0), "the near one, {ctx:?}");
        assert!(is_by_power(&ctx, 1), "the other, {ctx:?}");
    }
    for ctx in [surface(away, Vec3::NEG_X), LightSampleContext::medium(away)] {
        assert!(is_by_power(&ctx, 0), "{ctx:?}");
    }
    assert!(
        !is_by_power(&surface(away, Vec3::Z), 0),
        "half below the horizon"
    );
    assert!(
        !is_by_power(&surface(Vec3::new(0.5, 200.0, 0.5), Vec3::NEG_Y), 0),
        "aside"
    );
    let both = LightSampleContext::two_sided(away, Vec3::NEG_X, Vec3::NEG_X);
    assert!(!is_by_power(&both, 0), "other receivers look at each light");
}

#[expect(clippy::cast_possible_truncation, reason = "the nearest float")]
fn single(v: [f64; 3]) -> Vec3 {
    Vec3::from_array(v.map(|x| x as f32))
}

fn plus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|i| a[i] + b[i])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    let part = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [part(1, 2), part(2, 0), part(0, 1)]
}

/// `v` turned by `q`, whose length is taken for 1.
fn rotated(q: Quat, v: [f64; 3]) -> [f64; 3] {
    let q = q.to_array().map(f64::from);
    let length_sq: f64 = q.iter().map(|x| x * x).sum();
    let axis = [q[0], q[1], q[2]];
    let once = cross(axis, v).map(|x| 2.0 * x / length_sq);
    plus(plus(v, once.map(|x| q[3] * x)), cross(axis, once))
}
