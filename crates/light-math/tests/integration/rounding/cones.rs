//! Cones of directions.

use light_math::DirectionCone;
use light_math::glam::Vec3;
use light_testkit::Rng;

#[test]
fn a_cone_holds_its_axis_although_its_square_is_below_one() {
    let mut rng = Rng::new(52);
    let mut short = 0;
    for _ in 0..10_000 {
        let w = rng.direction();
        short += u32::from(w.dot(w) < 1.0);
        assert!(DirectionCone::from_direction(w).contains(w), "{w}");
    }
    assert!(short > 1000, "{short} axes need the slack");
}

/// The axis of a whole sphere has no meaning; float functions decide which one comes back.
#[test]
fn a_whole_sphere_holds_any_other_cone() {
    let whole = DirectionCone::new(Vec3::X, -1.0);
    for other in [
        DirectionCone::from_direction(-Vec3::X),
        DirectionCone::new(Vec3::Y, -0.5),
    ] {
        assert!(whole.union(other).is_whole_sphere(), "the first");
        assert!(other.union(whole).is_whole_sphere(), "the second");
    }
}

/// Past pi the cosine of the half angle would come back up.
#[test]
fn wide_cones_of_opposite_axes_fill_the_sphere() {
    let wide = |w: Vec3| DirectionCone::new(w, -0.9);
    for b in [-Vec3::X, Vec3::new(-1.0, 0.3, 0.0).normalize()] {
        assert!(wide(Vec3::X).union(wide(b)).is_whole_sphere(), "{b}");
    }
}

/// Axes that are opposite but for a few roundings: the union holds both cones, to the last digits.
#[test]
fn unions_of_almost_opposite_axes_hold_both() {
    let mut rng = Rng::new(53);
    for _ in 0..20_000 {
        let a = rng.direction();
        let off = rng.direction() * rng.log_range(1e-8, 1e-2);
        let b = (off - a).normalize();
        let [theta_a, theta_b] = [(); 2].map(|()| rng.range(0.0, 0.5));
        let (one, other) = (
            DirectionCone::new(a, theta_a.cos()),
            DirectionCone::new(b, theta_b.cos()),
        );
        let union = one.union(other);
        assert!(union.w.is_normalized(), "{union:?}");
        for cone in [one, other] {
            // In double precision: the farthest direction of a cone from the union's axis.
            let doubles = |v: Vec3| v.to_array().map(f64::from);
            let (u, w) = (doubles(union.w), doubles(cone.w));
            let dot: f64 = (0..3).map(|i| u[i] * w[i]).sum();
            let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
            let between = (dot / (length(u) * length(w))).clamp(-1.0, 1.0).acos();
            let reach = between + f64::from(cone.cos_theta).acos();
            let half = f64::from(union.cos_theta).clamp(-1.0, 1.0).acos();
            assert!(
                union.is_whole_sphere() || reach < half + 2e-6,
                "{one:?} and {other:?}: {reach} of {half}"
            );
        }
    }
}

/// Without their normalisation the axes of ten thousand unions would drift off the unit length.
#[test]
fn axes_of_many_unions_keep_their_length() {
    let mut rng = Rng::new(54);
    let mut cone = DirectionCone::from_direction(rng.direction());
    for _ in 0..10_000 {
        let near = (cone.w + rng.direction() * 1e-4).normalize();
        cone = cone.union(DirectionCone::from_direction(near));
        cone.cos_theta = 1.0;
        assert!((cone.w.length() - 1.0).abs() < 5e-7, "{cone:?}");
    }
}
