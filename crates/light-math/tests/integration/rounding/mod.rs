//! The inputs that the guards against rounding are there for: each test fails without its guard.

mod cones;
mod solid_angles;

use core::f32::consts::{FRAC_1_PI, PI};

use light_math::distribution::{AliasTable, PiecewiseConstant1D};
use light_math::float::{ONE_MINUS_EPSILON, next_down, next_up};
use light_math::glam::{Vec2, Vec3};
use light_math::quantize::{MAX_COS, QuantizedBox, encode_cos};
use light_math::warp::{
    Equiangular, concentric_disk, cosine_hemisphere, polar_disk, uniform_cone, uniform_hemisphere,
    uniform_sphere,
};
use light_math::{Aabb, DirectionCone, discrete, equal_area, fraction, lat_long, mis};
use light_testkit::Rng;

/// Unit vectors whose squared length in floats is above one.
fn long_directions() -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(51);
    (0..10_000)
        .map(move |_| rng.direction())
        .filter(|w| w.length_squared() > 1.0)
}

#[test]
fn the_largest_u_below_one_is_used_up_but_never_exceeded() {
    let weights = [0.1, 0.7, 0.3, 1e-3];
    let table = AliasTable::new(&weights).expect("weights");
    let chosen = discrete::sample(&weights, u64::MAX).expect("weights");
    assert_eq!(chosen.index, 3, "the last one");
    for u in [chosen.u, table.sample(u64::MAX).u] {
        assert!(fraction::to_f64(u) > 0.999, "{u}");
    }
    let chosen = discrete::sample(&weights, 0).expect("weights");
    assert_eq!((chosen.index, chosen.u), (0, 0), "the first one");
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

/// A point at the start of a ray without end, where all squares of distances would vanish.
#[test]
fn a_point_on_a_ray_has_a_finite_density_along_it() {
    for t_max in [f32::INFINITY, 1.0, 1e-12] {
        let part = Equiangular::new(Vec3::ZERO, Vec3::Z, 0.0, t_max).expect("a part");
        for u in [0.0, 0.25, 0.5, ONE_MINUS_EPSILON] {
            let t = part.sample(u);
            let density = part.pdf(t);
            assert!(
                density > 0.0 && density.is_finite(),
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
