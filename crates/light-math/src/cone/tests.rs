use super::*;
use crate::float::safe_sqrt;
use proptest::prelude::*;

fn direction() -> impl Strategy<Value = Vec3> {
    (-1.0f32..1.0, -PI..PI).prop_map(|(z, phi)| {
        let r = safe_sqrt(1.0 - z * z);
        Vec3::new(r * phi.cos(), r * phi.sin(), z).normalize()
    })
}

/// Half angles from nothing to the whole sphere, with many small ones.
fn cone() -> impl Strategy<Value = DirectionCone> {
    let theta = prop_oneof![0.0f32..PI, 0.0f32..1e-3, Just(0.0), Just(PI)];
    (direction(), theta).prop_map(|(w, theta)| DirectionCone::new(w, theta.cos()))
}

#[test]
fn extremes() {
    let single = DirectionCone::from_direction(Vec3::X);
    assert!(DirectionCone::EMPTY.is_empty(), "empty");
    assert_eq!(
        DirectionCone::default(),
        DirectionCone::EMPTY,
        "the default"
    );
    assert!(!DirectionCone::EMPTY.contains(Vec3::Z), "holds nothing");
    assert!(
        DirectionCone::WHOLE_SPHERE.contains(-Vec3::Z),
        "the pole opposite to the axis"
    );
    assert!(
        single.contains(Vec3::X) && !single.contains(Vec3::Y),
        "a single direction"
    );
    assert_eq!(single.union(DirectionCone::EMPTY), single, "neutral");
    assert_eq!(DirectionCone::EMPTY.union(single), single, "neutral");
    let opposite = DirectionCone::from_direction(-Vec3::X);
    assert!(
        single.union(opposite).is_whole_sphere(),
        "opposite axes have no middle"
    );
}

#[test]
fn union_of_two_directions_is_centred() {
    let u = DirectionCone::from_direction(Vec3::X).union(DirectionCone::from_direction(Vec3::Y));
    assert!(
        u.w.distance(Vec3::new(0.5, 0.5, 0.0).normalize()) < 1e-6,
        "halfway: {u:?}"
    );
    assert!((u.theta() - PI / 4.0).abs() < 1e-6, "half of a right angle");
}

#[test]
fn subtended_directions_at_every_scale() {
    for scale in [1e-30, 1e-20, 1.0, 1e18, 1e30] {
        let b = Aabb::new(Vec3::splat(-scale), Vec3::splat(scale));
        let c = DirectionCone::bound_subtended_directions(&b, Vec3::X * (4.0 * scale));
        assert!(c.w.distance(-Vec3::X) < 1e-6, "toward the box: {c:?}");
        let expected = (1.0 - 3.0 / 16.0f32).sqrt();
        assert!((c.cos_theta - expected).abs() < 1e-6, "sin^2 = 3/16: {c:?}");
    }
}

/// Boxes a few units in the last place wide, whose centres are rounded by as much as their widths,
/// and points just outside of the sphere of a box, in double precision: all corners are in the
/// cone.
#[test]
fn subtended_directions_hold_the_corners_to_the_last_digit() {
    let mut rng = light_testkit::Rng::new(7);
    let (mut narrow, mut wide) = (0, 0);
    for round in 0..200_000 {
        let (bounds, p) = if round % 2 == 0 {
            let mut near_one = |n| {
                Vec3::from_array([0; 3].map(|_| f32::from_bits(1.0f32.to_bits() + rng.u32() % n)))
            };
            (Aabb::new(near_one(8), near_one(8)), near_one(32))
        } else {
            let half = Vec3::from_array([0; 3].map(|_| rng.range(0.1, 1.0)));
            let center = rng.direction();
            let aside = half.cross(rng.direction()) * rng.log_range(1e-6, 1e-2);
            let p = center + half + aside + half * rng.log_range(1e-8, 1e-5);
            (Aabb::new(center - half, center + half), p)
        };
        let cone = DirectionCone::bound_subtended_directions(&bounds, p);
        if cone.is_whole_sphere() {
            continue;
        }
        *(if cone.cos_theta > 0.1 {
            &mut narrow
        } else {
            &mut wide
        }) += 1;
        for i in 0..8 {
            let corner = [0, 1, 2].map(|k| {
                if i >> k & 1 == 0 {
                    bounds.min[k]
                } else {
                    bounds.max[k]
                }
            });
            let to: [f64; 3] = core::array::from_fn(|k| f64::from(corner[k]) - f64::from(p[k]));
            let length = to.iter().map(|x| x * x).sum::<f64>().sqrt();
            let along: f64 = (0..3).map(|k| f64::from(cone.w[k]) * to[k]).sum();
            assert!(
                along >= (f64::from(cone.cos_theta) - f64::from(DOT_ERROR)) * length,
                "{corner:?} of {bounds:?} from {p}: {} in {cone:?}",
                along / length
            );
        }
    }
    assert!(
        narrow > 10_000 && wide > 10_000,
        "{narrow} narrow, {wide} wide"
    );
}

#[test]
fn subtended_directions_inside_and_empty() {
    let b = Aabb::new(Vec3::ZERO, Vec3::ONE);
    let near_face = Vec3::new(0.5, 0.5, 1.1);
    for p in [Vec3::splat(0.01), Vec3::splat(0.5), near_face] {
        assert!(
            DirectionCone::bound_subtended_directions(&b, p).is_whole_sphere(),
            "inside the sphere: {p}"
        );
    }
    let at_corner = DirectionCone::bound_subtended_directions(&b, Vec3::ZERO);
    assert!(at_corner.is_whole_sphere(), "on the sphere");
    let far = DirectionCone::bound_subtended_directions(&b, Vec3::X * f32::INFINITY);
    assert!(far.is_whole_sphere(), "no direction: {far:?}");
    let point = Aabb::from_point(Vec3::Z);
    let c = DirectionCone::bound_subtended_directions(&point, Vec3::ZERO);
    assert_eq!(c, DirectionCone::from_direction(Vec3::Z), "a point");
    assert!(
        DirectionCone::bound_subtended_directions(&point, Vec3::Z).is_whole_sphere(),
        "at the point itself"
    );
    assert!(
        DirectionCone::bound_subtended_directions(&Aabb::EMPTY, Vec3::ZERO).is_empty(),
        "nothing to see"
    );
}

proptest! {
    /// Directions of both cones lie in the union, with no more slack than a dot product needs.
    #[test]
    fn union_holds_both(a in cone(), b in cone(), t in 0.0f32..1.0, phi in -PI..PI) {
        let u = a.union(b);
        for c in [a, b] {
            let (sin_t, cos_t) = (t * c.theta()).sin_cos();
            let f = crate::Frame::from_z(c.w);
            let w = f.from_local(Vec3::new(sin_t * phi.cos(), sin_t * phi.sin(), cos_t));
            prop_assert!(u.contains(w.normalize()), "{:?} of {:?} not in {:?}", w, c, u);
        }
    }

    /// Directions to points of the box lie in its cone.
    #[test]
    fn subtended_directions_hold_the_box(
        a in prop::array::uniform3(-1.0f32..1.0), b in prop::array::uniform3(-1.0f32..1.0),
        p in prop::array::uniform3(-4.0f32..4.0), t in prop::array::uniform3(0.0f32..=1.0),
    ) {
        let bounds = Aabb::new(a.into(), b.into());
        let p = Vec3::from(p);
        let q = bounds.min + bounds.diagonal() * Vec3::from(t);
        let c = DirectionCone::bound_subtended_directions(&bounds, p);
        prop_assert!(q == p || c.contains((q - p).normalize()), "{:?}", c);
    }
}
