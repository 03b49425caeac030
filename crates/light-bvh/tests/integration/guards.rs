//! The inputs that need the guards of the default tree: each test fails without the one that it
//! names.

use light_bvh::light_bounds::light_math::{Aabb, glam::Vec3};
use light_bvh::light_bounds::{Gloss, LightBounds, LightExtent, LightId, LightSampleContext};
use light_bvh::{CutDetail, LightBvh};
use light_testkit::Rng;

/// A light in one point that shines alike to all sides.
fn point(at: Vec3, phi: f32) -> LightExtent {
    LightExtent::Bounded(LightBounds {
        bounds: Aabb::from_point(at),
        w: Vec3::Z,
        phi,
        cos_theta_o: -1.0,
        cos_theta_e: 0.0,
        two_sided: false,
    })
}

/// The probability of a light that is alone.
fn alone(light: LightExtent, ctx: &LightSampleContext) -> f32 {
    let tree = LightBvh::build(&[light]).expect("a valid light");
    let pmf = tree.pmf(ctx, LightId(0));
    let sampled = tree.sample(ctx, 1 << 63).map(|chosen| chosen.pmf);
    assert_eq!(sampled, (pmf > 0.0).then_some(pmf), "{light:?} at {ctx:?}");
    pmf
}

fn double(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

fn between(from: Vec3, to: Vec3) -> [f64; 3] {
    let (from, to) = (double(from), double(to));
    core::array::from_fn(|i| to[i] - from[i])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// `BOX_EMISSION`: a spot anywhere in a cube, whose nearest corner is just behind the receiver.
#[test]
fn a_spot_in_the_corner_of_its_box_emits_at_a_receiver_in_front_of_the_corner() {
    for signs in 0..8u8 {
        let w = Vec3::from_array([0, 1, 2].map(|i| 1.0 - f32::from(signs >> i & 1) * 2.0));
        let axis = w.normalize();
        let spot = LightExtent::Bounded(LightBounds {
            bounds: Aabb::new(Vec3::splat(-1.0), Vec3::ONE),
            w: axis,
            phi: 1.0,
            cos_theta_o: 1.0,
            cos_theta_e: 0.577,
            two_sided: false,
        });
        let ctx = LightSampleContext::surface(w * -0.99, -axis, -axis);
        assert_eq!(alone(spot, &ctx), 1.0, "from {} along {w}", -w);
    }
}

/// `ROUND_OFF`: a light above the horizon by less than the rounding of its height.
#[test]
fn a_light_just_above_the_horizon_counts() {
    let mut rng = Rng::new(1);
    let mut grazing = 0;
    for _ in 0..100_000 {
        let (n, p) = (rng.direction(), rng.vec3());
        let away = n
            .cross(rng.direction())
            .normalize_or(n.any_orthonormal_vector());
        let light = p + away * rng.log_range(1e-2, 1e3);
        let way = between(p, light);
        let cos = dot(double(n), way) / dot(way, way).sqrt();
        if cos > 0.0 && cos < 1e-6 {
            grazing += 1;
            let pmf = alone(point(light, 1.0), &LightSampleContext::surface(p, n, n));
            assert_eq!(pmf, 1.0, "{light} at {p}, {n}: {cos}");
        }
    }
    assert!(grazing > 1000, "{grazing}");
}

/// `LEAST_TOTAL`: in codes the weight of the fainter light vanishes where that of the other is
/// still a number.
#[test]
fn a_faint_light_beside_a_strong_one_counts_at_any_distance() {
    for exponent in 0..120 {
        let lights = [point(Vec3::ZERO, 1.0), point(Vec3::X, 1e-8)];
        let tree = LightBvh::build(&lights).expect("valid lights");
        let ctx = LightSampleContext::medium(Vec3::Y * 2f32.powi(exponent));
        for id in [0, 1].map(LightId) {
            assert!(tree.pmf(&ctx, id) > 0.0, "{id:?} at 2^{exponent}");
        }
    }
}

/// `MAX_ZOOM`: lengths of nodes in one cut that differ by more than the square root of what a float
/// holds.
#[test]
fn a_cut_joins_nodes_of_any_sizes() {
    for size in [1e-3, 1e-9, 1e-15, 1e-20] {
        let place = |i: u16| match i {
            0..40 => Vec3::new(f32::from(i % 7), f32::from(i % 5), f32::from(i % 3)) * size,
            _ => Vec3::new(f32::from(i % 7), f32::from(i % 5), 10.0) / size,
        };
        let lights: Vec<LightExtent> = (0..80).map(|i| point(place(i), 1.0)).collect();
        let tree = LightBvh::build(&lights).expect("valid lights");
        let ctx = LightSampleContext::medium(Vec3::splat(-size));
        let all = CutDetail::new(0.0).expect("a threshold");
        let cut = tree.view().cut(&ctx, all);
        let pmfs = (0..80).map(|id| cut.pmf(LightId(id)));
        let sum: f64 = pmfs.map(f64::from).sum();
        assert!((sum - 1.0).abs() < 1e-5, "size {size}: {sum}");
    }
}

/// A polished floor and a light at `to_light`, a unit vector, far away.
fn on_a_polished_floor(wo: Vec3, alpha: f32, to_light: Vec3) -> f32 {
    let gloss = Gloss {
        wo,
        alpha,
        diffuse: 0.0,
    };
    let ctx = LightSampleContext::surface(Vec3::ZERO, Vec3::Z, Vec3::Z).with_gloss(gloss);
    alone(point(to_light * 1e4, 1.0), &ctx)
}

/// `MIN_ALPHA`: without a width of its own, the mirror image of a point has no width at all.
#[test]
fn a_perfect_mirror_finds_the_light_that_it_shows() {
    let mut rng = Rng::new(2);
    for _ in 0..1000 {
        let wo = rng.direction();
        let wo = Vec3::new(wo.x, wo.y, wo.z.abs());
        let mirrored = Vec3::new(-wo.x, -wo.y, wo.z);
        assert_eq!(on_a_polished_floor(wo, 0.0, mirrored), 1.0, "{wo}");
    }
}

/// `MIN_HALF_SQ`: the light is straight behind the floor's farthest point, and no direction is
/// between it and the viewer.
#[test]
fn a_light_opposite_to_a_grazing_viewer_counts() {
    for to_light in [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y] {
        for alpha in [0.0, 0.5] {
            let pmf = on_a_polished_floor(-to_light, alpha, to_light);
            assert_eq!(pmf, 1.0, "{to_light}, {alpha}");
        }
    }
}

/// `MIN_COS`: shading normals may turn away from the viewer.
#[test]
fn a_viewer_below_the_horizon_changes_no_sign() {
    let mut rng = Rng::new(3);
    for _ in 0..1000 {
        let (wo, wi) = (rng.direction(), rng.direction());
        let (wo, wi) = (
            Vec3::new(wo.x, wo.y, -wo.z.abs()),
            wi.with_z(wi.z.abs().max(1e-3)),
        );
        let pmf = on_a_polished_floor(wo, rng.f32(), wi);
        assert_eq!(pmf, 1.0, "{wo}, {wi}");
    }
}
