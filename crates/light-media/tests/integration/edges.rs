//! Points outside of a medium, ends of a span, zero emission: cases that tests of means do not
//! cover.

use light_math::Aabb;
use light_math::glam::{Affine3A, Quat, Vec3};
use light_media::phase::Isotropic;
use light_media::{
    Homogeneous, March, Phase, Ray, Region, RegionError, Span, StepSize, Substance, VolumeLight,
    delta_tracking, emission, transmittance,
};
use light_sources::Rgb;
use light_testkit::{Estimate, Rng};

const PHASE: Phase = Phase::Isotropic(Isotropic);
const RAY: Ray = Ray {
    o: Vec3::ZERO,
    d: Vec3::X,
};

fn medium(sigma_a: Vec3, sigma_s: Vec3, region: Region) -> Homogeneous<Rgb> {
    Homogeneous {
        substance: Substance::new(sigma_a, sigma_s, Vec3::ONE).expect("valid"),
        phase: PHASE,
        region,
    }
}

fn span(t0: f32, t1: f32) -> Span {
    Span { t0, t1 }
}

#[test]
fn nothing_is_lost_outside_of_a_medium() {
    let far = Aabb::new(Vec3::splat(10.0), Vec3::splat(11.0));
    let region = Region::new(far, Affine3A::IDENTITY).expect("a box");
    crosses_nothing(&medium(Vec3::ONE, Vec3::ONE, region), span(0.0, 20.0));
}

#[test]
fn a_span_without_order_is_empty() {
    let cube = Aabb::new(Vec3::splat(-9.0), Vec3::splat(9.0));
    let region = Region::new(cube, Affine3A::IDENTITY).expect("a box");
    let (nan, endless) = (f32::NAN, f32::INFINITY);
    for region in [Region::UNBOUNDED, region] {
        let medium = medium(Vec3::ONE, Vec3::ONE, region);
        for (t0, t1) in [
            (2.0, 1.0),
            (nan, 1.0),
            (0.0, nan),
            (nan, nan),
            (-5.0, 1.0),
            (1.0, 1.0),
            (endless, endless),
        ] {
            crosses_nothing(&medium, span(t0, t1));
        }
    }
}

/// Checks that a span takes nothing from a path and adds nothing to it.
fn crosses_nothing(medium: &Homogeneous<Rgb>, part: Span) {
    let step = StepSize::new(0.5).expect("positive");
    let mut none = || -> f32 { panic!("no random number is needed") };
    let all = [
        transmittance::closed_form::<Rgb, _>(medium, &RAY, part, &()).expect("a closed form"),
        transmittance::march::<Rgb, _>(medium, &RAY, part, step, 0.5, &()),
        transmittance::ratio_tracking::<Rgb, _>(medium, &RAY, part, &(), &mut none),
        transmittance::unbiased::<Rgb, _>(medium, &RAY, part, &(), &mut none),
        transmittance::best::<Rgb, _>(medium, &RAY, part, step, &(), &mut none),
    ];
    assert_eq!(
        all,
        [Vec3::ONE; 5],
        "{part:?}: closed, marched, tracked, best"
    );
    let flight = delta_tracking::<Rgb, _>(medium, &RAY, part, Vec3::ONE, &(), &mut none);
    assert_eq!(flight.scattered_at, None, "{part:?}");
    assert_eq!(
        (flight.weight, flight.emitted),
        (Vec3::ONE, Vec3::ZERO),
        "{part:?}"
    );
    let seen = emission::<Rgb, _>(medium, &RAY, part, step, &(), &mut none);
    assert_eq!(seen, VolumeLight::vacuum(), "{part:?}: no emission");
}

/// In a purely absorbing medium, a collision has weight 0.
#[test]
fn an_absorber_leaves_all_or_nothing() {
    let medium = medium(Vec3::splat(0.8), Vec3::ZERO, Region::UNBOUNDED);
    let mut rng = Rng::new(41);
    let part = span(0.0, 1.5);
    let mean = Estimate::of(1 << 14, || {
        let mut next_u = || rng.f32();
        let flight = delta_tracking::<Rgb, _>(&medium, &RAY, part, Vec3::ONE, &(), &mut next_u);
        assert_eq!(flight.scattered_at, None, "nothing scatters");
        assert!(
            flight.weight == Vec3::ZERO || flight.weight == Vec3::ONE,
            "{flight:?}"
        );
        flight.weight.x.into()
    });
    assert!(mean.agrees_with((-1.2f64).exp()), "{mean:?}");
}

/// A path that carries one channel alone keeps its weight there, where nothing is absorbed.
#[test]
fn collisions_are_chosen_by_what_the_path_carries() {
    let medium = medium(Vec3::ZERO, Vec3::new(2.0, 1.0, 0.5), Region::UNBOUNDED);
    let mut rng = Rng::new(42);
    for channel in [Vec3::Y, Vec3::Z] {
        for _ in 0..2000 {
            let mut next_u = || rng.f32();
            let part = span(0.0, 3.0);
            let flight =
                delta_tracking::<Rgb, _>(&medium, &RAY, part, channel * 3.0, &(), &mut next_u);
            assert!(
                (flight.weight.dot(channel) - 1.0).abs() < 1e-4,
                "{channel}: {flight:?}"
            );
        }
    }
}

/// However long the steps, the transmittance of a march reaches to the very end of its span.
#[test]
fn a_march_ends_where_its_span_ends() {
    let medium = medium(Vec3::splat(0.4), Vec3::ZERO, Region::UNBOUNDED);
    for (length, offset) in [(5.0, 0.1), (0.7, 0.9), (0.3, 0.0)] {
        let step = StepSize::new(length).expect("positive");
        let part = span(1.0, 3.0);
        let seen = emission::<Rgb, _>(&medium, &RAY, part, step, &(), &mut || offset);
        let expected = (-0.8f32).exp();
        assert!((seen.transmittance.x - expected).abs() < 1e-6, "{seen:?}");
        // The sum of what each point sends, at the same place in every step.
        let March { step, n, .. } = step.march(part);
        let sum: f32 = (0..n)
            .map(|i| (-0.4 * (i as f32 + offset) * step).exp() * 0.4 * step)
            .sum();
        assert!((seen.l.x - sum).abs() < 1e-6, "{seen:?}, {sum}");
    }
}

#[test]
fn spans_are_not_empty_and_not_endless() {
    assert_eq!(Span::new(1.0, 1.0), None, "no length");
    assert_eq!(Span::new(f32::NAN, 1.0), None, "NaN");
    assert_eq!(span(0.0, f32::INFINITY).length(), f32::MAX, "without end");
    let both = span(1.0, 3.0).intersection(&span(2.0, 5.0));
    assert_eq!(both, Some(span(2.0, 3.0)), "in common");
    assert_eq!(span(1.0, 2.0).intersection(&span(3.0, 5.0)), None, "apart");
    let whole = StepSize::new(4.0).expect("positive").march(span(1.0, 3.0));
    assert_eq!((whole.n, whole.step), (1, 2.0), "one step at least");
    let tiny = StepSize::new(1e30)
        .expect("positive")
        .march(span(0.0, 1e-20));
    assert_eq!((tiny.n, tiny.step), (1, 1e-20), "a share that vanishes");
    let most = StepSize::new(1.0)
        .expect("positive")
        .march(span(0.0, 65536.0));
    assert_eq!(
        (most.n, most.step),
        (StepSize::MAX_STEPS, 1.0),
        "just so many"
    );
}

/// Random rays through random boxes: a point of the ray lies in the box exactly where the clipped
/// span says.
#[test]
fn clipped_spans_hold_the_points_of_a_box() {
    let mut rng = Rng::new(43);
    let mut hits = 0;
    for i in 0..4000u32 {
        let corner = |rng: &mut Rng| {
            Vec3::new(
                rng.range(-1.0, 1.0),
                rng.range(-1.0, 1.0),
                rng.range(-1.0, 1.0),
            )
        };
        let bounds = Aabb::new(corner(&mut rng), corner(&mut rng));
        let to_scene = Affine3A::from_scale_rotation_translation(
            Vec3::new(
                rng.range(0.5, 2.0),
                rng.range(-2.0, -0.5),
                rng.range(0.5, 2.0),
            ),
            Quat::from_axis_angle(rng.direction(), rng.range(0.0, 6.0)),
            corner(&mut rng),
        );
        // Rays along axes of the box's own space are parallel to four of its faces.
        let aligned = i % 2 == 0;
        let to_scene = if aligned {
            Affine3A::IDENTITY
        } else {
            to_scene
        };
        let axes = [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z];
        let d = if aligned {
            axes[rng.below(6)]
        } else {
            rng.direction()
        };
        // Half of the rays meet a point of the box.
        let within = bounds.min + bounds.diagonal() * corner(&mut rng).abs();
        let o = if i % 4 < 2 {
            to_scene.transform_point3(within) - d * rng.range(0.0, 2.0)
        } else {
            corner(&mut rng) * 1.2
        };
        let ray = Ray { o, d };
        let region = Region::new(bounds, to_scene).expect("a box");
        let asked = span(rng.range(0.0, 0.5), rng.range(0.6, 4.0));
        let clipped = region.clip(&ray, asked);
        hits += u32::from(clipped.is_some());
        if let Some(part) = clipped {
            assert!(
                asked.t0 <= part.t0 && part.t1 <= asked.t1,
                "{part:?} of {asked:?}"
            );
        }
        for _ in 0..16 {
            let t = rng.range(asked.t0, asked.t1);
            let near = |end: f32| (t - end).abs() < 1e-4;
            if clipped.is_some_and(|part| near(part.t0) || near(part.t1)) {
                continue;
            }
            let inside = region.contains(ray.at(t));
            let says = clipped.is_some_and(|part| part.t0 < t && t < part.t1);
            let grazes = clipped.is_none() && !aligned;
            assert!(
                inside == says || grazes,
                "{ray:?} at {t}: {inside}, {clipped:?} of {bounds:?}"
            );
            assert_eq!(
                region.locate(ray.at(t)).is_some(),
                inside,
                "located {ray:?} at {t}"
            );
        }
    }
    assert!(hits > 1500, "{hits} rays hit");
}

/// A ray parallel to faces is inside while its origin lies between them, on either side of either
/// face of every axis.
#[test]
fn rays_along_faces_are_in_or_out() {
    let cube = Aabb::new(Vec3::ZERO, Vec3::ONE);
    let region = Region::new(cube, Affine3A::IDENTITY).expect("a box");
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    for (i, d) in axes.into_iter().enumerate() {
        for (j, across) in axes.into_iter().enumerate().filter(|(j, _)| *j != i) {
            for (offset, inside) in [
                (-0.1, false),
                (0.0, true),
                (0.4, true),
                (1.0, true),
                (1.1, false),
            ] {
                let mut o = Vec3::splat(0.5) - d * 1.5;
                o[j] = offset;
                let clipped = region.clip(&Ray { o, d }, span(0.0, 9.0));
                let expected = inside.then_some(span(1.0, 2.0));
                assert_eq!(clipped, expected, "{d} at {offset} along {across}");
                let back = region.clip(
                    &Ray {
                        o: o + d * 3.0,
                        d: -d,
                    },
                    span(0.0, 9.0),
                );
                assert_eq!(back, expected, "back along {d} at {offset} along {across}");
            }
        }
        let beside = Vec3::splat(0.5) - d * 0.51;
        assert!(
            !region.contains(beside) && region.locate(beside).is_none(),
            "{beside}"
        );
        assert!(!region.contains(beside + d * 1.02), "beyond {d}");
    }
    let p = Vec3::new(7.0, -3.0, 2.0);
    assert_eq!(Region::UNBOUNDED.locate(p), Some(p), "everywhere");
    assert!(Region::UNBOUNDED.contains(p), "everywhere");
}

#[test]
fn regions_of_nonsense_are_refused() {
    let cube = Aabb::new(Vec3::ZERO, Vec3::ONE);
    let huge = Aabb::new(Vec3::ZERO, Vec3::splat(f32::INFINITY));
    let flat = Aabb::new(Vec3::ZERO, Vec3::new(1.0, 0.0, 1.0));
    let infinite = Affine3A::from_translation(Vec3::splat(f32::INFINITY));
    let identity = Affine3A::IDENTITY;
    for make in [Region::new, Region::unit_cube] {
        assert_eq!(
            make(huge, identity),
            Err(RegionError::Bounds),
            "infinite box"
        );
        assert_eq!(
            make(Aabb::EMPTY, identity),
            Err(RegionError::Bounds),
            "empty box"
        );
        assert_eq!(
            make(cube, infinite),
            Err(RegionError::Transform),
            "infinite transform"
        );
    }
    assert!(Region::unit_cube(flat, identity).is_err(), "flat");
    let unit = Region::unit_cube(Aabb::new(Vec3::ONE, Vec3::splat(3.0)), identity).expect("a cube");
    assert_eq!(
        unit.locate(Vec3::splat(2.0)),
        Some(Vec3::splat(0.5)),
        "middle"
    );
}
