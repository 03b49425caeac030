//! The inputs that the guards against rounding are there for: each test fails without its guard.

use core::f32::consts::{FRAC_1_PI, PI, TAU};

use light_math::distribution::{AliasTable, PiecewiseConstant1D, WeightedReservoir};
use light_math::float::{ONE_MINUS_EPSILON, next_down, next_up};
use light_math::glam::{Vec2, Vec3};
use light_math::quantize::{MAX_COS, QuantizedBox, encode_cos};
use light_math::warp::{
    Equiangular, SphericalRectangle, SphericalTriangle, concentric_disk, cosine_hemisphere,
    polar_disk, uniform_cone, uniform_hemisphere, uniform_sphere,
};
use light_math::{Aabb, DirectionCone, discrete, equal_area, lat_long, mis, solid_angle};
use light_testkit::Rng;

/// Unit vectors whose squared length in floats is above one.
fn long_directions() -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(51);
    (0..10_000)
        .map(move |_| rng.direction())
        .filter(|w| w.length_squared() > 1.0)
}

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

#[test]
fn the_largest_u_below_one_is_used_up_but_never_exceeded() {
    let below_one = f64::from_bits(1.0f64.to_bits() - 1);
    let weights = [0.1, 0.7, 0.3, 1e-3];
    let table = AliasTable::new(&weights).expect("weights");
    for u in [below_one, 1.0, 1.5, f64::INFINITY] {
        let chosen = discrete::sample(&weights, u).expect("weights");
        assert_eq!(chosen.index, 3, "the last one for {u}");
        assert!(chosen.u < 1.0 && chosen.u > 0.999, "{chosen:?} for {u}");
        let chosen = table.sample(u);
        assert!(chosen.u < 1.0 && chosen.u > 0.999, "{chosen:?} for {u}");
        let mut reservoir = WeightedReservoir::new(u);
        weights.iter().for_each(|&w| reservoir.add(w, w));
        let chosen = reservoir.sample().expect("weights");
        assert!(chosen.value == 0.1 && chosen.u < 1.0, "{chosen:?} for {u}");
    }
    for u in [-1.0, -0.0, f64::NAN] {
        let chosen = discrete::sample(&weights, u).expect("weights");
        assert_eq!((chosen.index, chosen.u), (0, 0.0), "the first one for {u}");
    }
    let line = PiecewiseConstant1D::new(&weights).expect("weights");
    for u in [ONE_MINUS_EPSILON, 1.0, 7.0] {
        let s = line.sample(u);
        assert!(s.index == 3 && s.x <= 1.0 && s.x > 0.999, "{s:?} for {u}");
    }
}

#[test]
fn long_vectors_have_places_in_the_square() {
    let mut outside = 0;
    for w in long_directions() {
        // On the equator and below it, where roundings add up to more than the diamond's radius.
        for d in [w, w.with_z(0.0).normalize(), w.with_z(-1e-8).normalize()] {
            outside += u32::from(d.truncate().length_squared() > 1.0);
            let p = equal_area::sphere_to_square(d);
            assert!(
                p.cmpge(Vec2::ZERO).all() && p.cmple(Vec2::ONE).all(),
                "{d}: {p}"
            );
        }
        assert!(
            uniform_sphere::invert(w).cmple(Vec2::ONE).all(),
            "sphere {w}"
        );
    }
    assert!(outside > 100, "{outside} vectors need the guard");
    for z in [1.0, -1.0] {
        let pole = Vec3::new(0.0, 0.0, next_up(1.0) * z);
        let [sphere, hemisphere] = [
            uniform_sphere::invert(pole),
            uniform_hemisphere::invert(pole),
        ];
        assert_eq!(sphere.x, 0.5 - 0.5 * z, "sphere");
        assert_eq!(hemisphere.x, 0.5 + 0.5 * z, "hemisphere");
    }
}

#[test]
fn rims_lie_in_their_disks_and_cones() {
    let mut rng = Rng::new(55);
    let (mut outside, mut beyond) = ([0u32; 2], 0u32);
    for _ in 0..20_000 {
        let t = rng.f32();
        for u in [
            Vec2::new(0.0, t),
            Vec2::new(1.0, t),
            Vec2::new(t, 0.0),
            Vec2::new(t, 1.0),
        ] {
            let p = concentric_disk::sample(u);
            outside[0] += u32::from(p.length_squared() > 1.0);
            assert!(concentric_disk::pdf(p) > 0.0, "rim {u}");
            let back = concentric_disk::invert(p);
            assert!(
                back.cmpge(Vec2::ZERO).all() && back.cmple(Vec2::ONE).all(),
                "{u}: {back}"
            );
            let w = cosine_hemisphere::sample(u);
            assert!(
                w.z > 0.0 && cosine_hemisphere::pdf(w.z) > 0.0,
                "horizon {u}"
            );
        }
        let p = polar_disk::sample(Vec2::new(1.0, t));
        outside[1] += u32::from(p.length_squared() > 1.0);
        assert!(
            polar_disk::pdf(p) > 0.0 && polar_disk::invert(p).x <= 1.0,
            "rim {t}"
        );

        let height = rng.log_range(1e-6, 2.0);
        let w = uniform_cone::sample(Vec2::new(ONE_MINUS_EPSILON, t), height);
        beyond += u32::from(w.truncate().length_squared() / (1.0 + w.z) > height);
        assert!(
            uniform_cone::invert(w, height).x <= 1.0,
            "cone {height} {t}"
        );
    }
    assert!(
        outside.iter().all(|&n| n > 100),
        "{outside:?} points need the slack"
    );
    assert!(beyond > 100, "{beyond} directions need the guard");
}

/// A tiny negative azimuth is one turn, which is no `u`.
#[test]
fn the_seam_of_a_map_is_below_one() {
    for x in [-1e-10, -1e-30, -f32::MIN_POSITIVE] {
        let uv = lat_long::uv(Vec3::new(x, 0.3, -1.0));
        assert_eq!(uv.x, ONE_MINUS_EPSILON, "{x}");
    }
    for v in [0.0, 1.0, next_down(1.0)] {
        let density = lat_long::solid_angle_per_area(v);
        assert!((0.0..1e-5).contains(&density), "{v}: {density}");
    }
}

#[test]
fn other_densities_below_zero_count_as_none() {
    assert_eq!(
        (mis::power(1.0, -1.0), mis::balance(1.0, -0.5)),
        (1.0, 1.0),
        "weights"
    );
}

#[test]
fn cosines_and_boxes_out_of_range_are_cut_off() {
    assert_eq!((encode_cos(1.5), encode_cos(-7.0)), (MAX_COS, 0), "cosines");
    let outer = Aabb::new(Vec3::ZERO, Vec3::ONE);
    let inner = Aabb::new(Vec3::splat(-3.0), Vec3::splat(4.0));
    let code = QuantizedBox::encode(&inner, &outer);
    assert_eq!((code.min, code.max), ([0; 3], [65535; 3]), "boxes");
}

/// From a point in its plane there is nothing to see of a triangle, inside of it or not.
#[test]
fn a_plane_that_holds_the_point_shows_nothing() {
    let mut rng = Rng::new(56);
    for _ in 0..2000 {
        // Coordinates of few digits, so that the plane is exact.
        let mut grid = || (rng.range(-64.0, 64.0)).round() / 16.0;
        let v = [(); 3].map(|()| Vec3::new(grid(), grid(), 0.5));
        let p = v[0] * 0.25 + v[1] * 0.5 + v[2] * 0.25;
        assert_eq!(solid_angle::triangle(v, p), 0.0, "{v:?} from {p}");
        assert_eq!(SphericalTriangle::new(v, p), None, "{v:?} from {p}");
        let corner = v[0];
        assert_eq!(solid_angle::triangle(v, corner), 0.0, "{v:?} from {corner}");
    }
    let rectangle = SphericalRectangle::new(Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(0.5, 0.5, 0.0));
    assert_eq!(rectangle, None, "a rectangle");
}

/// Almost in the plane of a triangle, above its inside and beside it: all of half a sphere, or next to nothing.
#[test]
fn a_plane_that_almost_holds_the_point_shows_half_a_sphere_or_nothing() {
    let v = [
        Vec3::new(-1.0, -0.8, 0.0),
        Vec3::new(0.9, -1.0, 0.0),
        Vec3::new(0.1, 1.2, 0.0),
    ];
    for height in [1e-5, 1e-10, 1e-20, 1e-30] {
        let inside = solid_angle::triangle(v, Vec3::Z * height);
        assert!((inside - TAU).abs() < 1e-4, "inside at {height}: {inside}");
        let beside = solid_angle::triangle(v, Vec3::new(3.0, 0.0, height));
        assert!(
            (0.0..1e-4).contains(&beside),
            "beside at {height}: {beside}"
        );
        let triangle = SphericalTriangle::new(v, Vec3::Z * height);
        let mut rng = Rng::new(57);
        for _ in 0..if triangle.is_some() { 200 } else { 0 } {
            let b = triangle.map_or(Vec3::NAN, |t| t.sample(rng.vec2()));
            let valid = b.min_element() >= 0.0 && (b.element_sum() - 1.0).abs() < 1e-6;
            assert!(valid, "{b} at {height}");
        }
    }
}

/// Rectangles of any size seen from any height, down to where squares of lengths vanish: places are places.
#[test]
fn rectangles_at_the_ends_of_the_range_are_sampled_within() {
    let us = [0.0, 1e-7, 0.3, 0.5, ONE_MINUS_EPSILON];
    let mut seen = 0;
    for size in [1e-15, 1e-6, 1.0, 1e6, 1e12] {
        for aspect in [1.0, 1e-4, 1e4] {
            for height in [1e-25, 1e-18, 1e-12, 1e-6, 1.0, 1e6] {
                for offset in [-2.0, -1.0, -0.5, 0.0, 3.0] {
                    let corner = Vec3::new(offset * size, offset * size * aspect, height);
                    let edges = [Vec3::X * size, Vec3::Y * (size * aspect)];
                    let [x, y] = edges;
                    let Some(rectangle) = SphericalRectangle::new(corner, x, y, Vec3::ZERO) else {
                        continue;
                    };
                    seen += 1;
                    assert!(rectangle.pdf() > 0.0, "{corner} {edges:?}");
                    for u in us.iter().flat_map(|&x| us.map(|y| Vec2::new(x, y))) {
                        let at = rectangle.sample(u);
                        let back = rectangle.invert(at);
                        let unit = |p: Vec2| p.cmpge(Vec2::ZERO).all() && p.cmple(Vec2::ONE).all();
                        assert!(
                            unit(at) && unit(back),
                            "{corner} {edges:?} {u}: {at} {back}"
                        );
                    }
                }
            }
        }
    }
    assert!(seen > 200, "{seen} rectangles");
}

/// A point at the start of a ray without end, where all squares of distances would vanish.
#[test]
fn a_point_on_a_ray_has_a_finite_density_along_it() {
    for t_max in [f32::INFINITY, 1.0, 1e-12] {
        let part = Equiangular::new(Vec3::ZERO, Vec3::Z, 0.0, t_max).expect("a part");
        for u in [0.0, 0.25, 0.5, ONE_MINUS_EPSILON] {
            let t = part.sample(u);
            let density = part.pdf(t);
            assert!(
                t == f32::INFINITY || (density > 0.0 && density.is_finite()),
                "{density} at {t} of {t_max}"
            );
        }
    }
}

/// Samples of the equal-area map and of the octahedron stay unit vectors all over the square.
#[test]
fn maps_of_the_whole_square_are_unit_vectors() {
    for i in 0..=64u8 {
        for j in 0..=64u8 {
            let p = Vec2::new(f32::from(i), f32::from(j)) / 64.0;
            let d = equal_area::square_to_sphere(p);
            assert!((d.length() - 1.0).abs() < 5e-7, "{p}: {d}");
            for w in [uniform_sphere::sample(p), uniform_hemisphere::sample(p)] {
                assert!((w.length() - 1.0).abs() < 5e-7, "{p}: {w}");
            }
        }
    }
    assert!(
        (uniform_sphere::pdf() - 0.25 * FRAC_1_PI).abs() < 1e-9,
        "density"
    );
    assert!(
        (DirectionCone::WHOLE_SPHERE.theta() - PI).abs() < 1e-6,
        "half angle"
    );
}
