//! Media whose coefficients are many orders of magnitude apart, and boxes too thin for floats.

use light_media::glam::{Affine3A, Quat, Vec3};
use light_media::light_math::Aabb;
use light_media::phase::{Isotropic, Phase};
use light_media::transmittance::ratio_tracking;
use light_media::{
    ColorGrid, ColorGridMedium, DensityGrid, Glow, Grid, GridMedium, GridMediumError, Homogeneous,
    Medium, Ray, Region, RegionError, Span, Substance, TemperatureGrid, delta_tracking,
};
use light_sources::Rgb;

const RAY: Ray = Ray {
    o: Vec3::ZERO,
    d: Vec3::X,
};

const SPAN: Span = Span { t0: 0.0, t1: 1.0 };

fn medium(sigma_a: Vec3, sigma_s: Vec3) -> Homogeneous<Rgb> {
    let substance = Substance::<Rgb>::new(sigma_a, sigma_s, Vec3::ONE);
    Homogeneous {
        substance: substance.expect("coefficients"),
        phase: Phase::Isotropic(Isotropic),
        region: Region::UNBOUNDED,
    }
}

/// One over the extinction is infinite.
#[test]
fn nothing_happens_in_a_medium_thinner_than_a_normal_float() {
    let medium = medium(Vec3::X * 1e-42, Vec3::Y * 1e-42);
    let flight = delta_tracking(&medium, &RAY, SPAN, Vec3::ONE, &(), &mut || 0.0);
    assert_eq!(flight.weight, Vec3::ONE, "{flight:?}");
    assert_eq!(flight.emitted, Vec3::ZERO, "{flight:?}");
    let left = ratio_tracking(&medium, &RAY, SPAN, &(), &mut || 0.0);
    assert_eq!(left, Vec3::ONE, "transmittance");
}

/// Scattering of 1e-36 beside absorption of 1000: where it would happen, its weight is more than a
/// float holds.
#[test]
fn light_that_hardly_ever_scatters_keeps_a_finite_weight() {
    let medium = medium(Vec3::new(5.0, 0.5, 1000.0), Vec3::new(0.0, 0.0, 3e-36));
    for first in [0.5, 0.9] {
        // Distances by `first`, and every decision by the smallest number.
        let mut turn = 0u32;
        let mut next_u = || {
            turn += 1;
            if turn % 2 == 1 { first } else { 0.0 }
        };
        let flight = delta_tracking(&medium, &RAY, SPAN, Vec3::ONE, &(), &mut next_u);
        assert!(flight.weight.is_finite(), "{flight:?} for {first}");
    }
}

/// The bounds along `ray` hold wherever rounding puts a point, in a box in which only the half
/// below the middle of one axis is dense. Returns the number of segments, 0 for a ray that crosses
/// the box in less time than floats tell.
fn bounds_hold(ray: &Ray, bounds: Aabb, to_scene: Affine3A, axis: usize) -> usize {
    let mut size = [1; 3];
    size[axis] = 8;
    let values = [2.0, 2.0, 2.0, 2.0, 0.0, 0.0, 0.0, 0.0];
    let medium = GridMedium::<Rgb, _>::new(
        Substance::new(Vec3::ONE, Vec3::ONE, Vec3::ZERO).expect("coefficients"),
        Phase::Isotropic(Isotropic),
        bounds,
        to_scene,
        DensityGrid::new(size, values).expect("a grid"),
        Glow::uniform(),
    );
    let medium = medium.expect("a medium");
    let far = Span { t0: 0.0, t1: 1e9 };
    let mut segments = 0;
    let Some(span) = medium.clip(ray, far) else {
        return segments;
    };
    for segment in medium.majorants(ray, span, &()) {
        segments += 1;
        for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let t = segment.span.t0 + share * segment.span.length();
            let sigma_t = medium.coefficients(ray.at(t), &()).sigma_t().x;
            let bound = segment.sigma_maj * 1.000_01;
            assert!(sigma_t <= bound, "{sigma_t} at {t} in {segment:?}");
        }
    }
    segments
}

/// A ray through it crosses more cells a unit than a float counts.
#[test]
fn a_box_just_above_the_smallest_float_is_bounded() {
    for thickness in [4e-38, 1e-37, 1e-30] {
        let bounds = Aabb::new(Vec3::ZERO, Vec3::new(thickness, 1.0, 1.0));
        let ray = Ray {
            o: Vec3::new(0.0, 0.5, 0.5),
            d: Vec3::X,
        };
        let segments = bounds_hold(&ray, bounds, Affine3A::IDENTITY, 0);
        assert!(segments > 0, "{thickness}");
    }
}

/// All cells of a thin slab are in one unit in the last place of their points.
#[test]
fn cells_below_the_rounding_of_their_points_are_bounded() {
    let turned = Quat::from_rotation_x(0.7);
    let mut crossed = 0;
    for far in [0.0, 1.0, 100.0, 1e4] {
        for thickness in [1.0, 1e-2, 1e-4, 1e-6, 1e-9] {
            for direction in [Vec3::Z, Vec3::new(1.0, 0.0, 0.1), Vec3::new(0.1, 0.3, -1.0)] {
                let ray = Ray {
                    o: Vec3::splat(far),
                    d: turned * direction.normalize(),
                };
                let middle = ray.at(0.5);
                let to_scene = Affine3A::from_rotation_translation(turned, middle);
                let half = Vec3::new(4.0, 4.0, 0.5 * thickness);
                let segments = bounds_hold(&ray, Aabb::new(-half, half), to_scene, 2);
                crossed += usize::from(segments > 0);
            }
        }
    }
    assert!(crossed > 40, "{crossed} rays");
}

/// Where floats resolve the cells, each has a bound of its own.
#[test]
fn cells_of_usual_boxes_have_bounds_of_their_own() {
    let bounds = Aabb::new(Vec3::splat(99.0), Vec3::splat(101.0));
    let ray = Ray {
        o: Vec3::new(98.0, 100.1, 100.1),
        d: Vec3::X,
    };
    assert_eq!(
        bounds_hold(&ray, bounds, Affine3A::IDENTITY, 0),
        16,
        "cells"
    );
}

/// A density that is a number times coefficients that are numbers, of which the products are none.
#[test]
fn grids_that_exceed_what_a_float_holds_are_refused() {
    let phase = Phase::Isotropic(Isotropic);
    let cube = Aabb::new(Vec3::ZERO, Vec3::ONE);
    let one = |value| Grid::new([1; 3], [value]).expect("a grid");
    let make = |[density, sigma_a, sigma_s, le]: [f32; 4], glow: Glow<Rgb, [f32; 1]>| {
        let substance =
            Substance::<Rgb>::new(Vec3::X * sigma_a, Vec3::Y * sigma_s, Vec3::splat(le));
        let density = DensityGrid::new([1; 3], [density]).expect("a grid");
        let substance = substance.expect("coefficients");
        let medium = GridMedium::new(substance, phase, cube, Affine3A::IDENTITY, density, glow);
        medium.map(|medium| medium.coefficients(Vec3::splat(0.5), &()))
    };
    let colored = |values: [f32; 3]| {
        let grid = |value| Grid::new([1; 3], [0.5 * value, value, 0.0]).expect("a grid");
        let [a, s, le] = values.map(|value| {
            ColorGrid::<Rgb, _>::new([Vec3::X, Vec3::Y, Vec3::Z], grid(value)).expect("colours")
        });
        let medium = ColorGridMedium::new(a, s, Some(le), phase, cube, Affine3A::IDENTITY);
        medium.map(|medium| medium.coefficients(Vec3::splat(0.5), &()))
    };
    let uniform = Glow::uniform;
    let glow = || Glow::scaled(one(1e20));
    let hot = || Glow {
        scale: Some(one(1e38)),
        ..Glow::of_temperature(TemperatureGrid::new(one(5000.0)))
    };
    for (found, expected) in [
        (make([1e20, 1.0, 1.0, 1.0], uniform()), None),
        (
            make([1e20, 1e20, 0.0, 0.0], uniform()),
            Some(GridMediumError::SigmaT),
        ),
        (
            make([1e20, 0.0, 1e20, 0.0], uniform()),
            Some(GridMediumError::SigmaT),
        ),
        (
            make([f32::MAX, 1.0, 0.0, 0.0], uniform()),
            Some(GridMediumError::SigmaT),
        ),
        (
            make([1e20, 1.0, 1.0, 1e20], uniform()),
            Some(GridMediumError::Emission),
        ),
        (
            make([1e10, 1.0, 1.0, 1e10], glow()),
            Some(GridMediumError::Emission),
        ),
        (make([1e10, 1.0, 1.0, 1e5], glow()), None),
        (
            make([1.0, 10.0, 0.0, 1.0], hot()),
            Some(GridMediumError::Emission),
        ),
        (colored([1e20, 1e20, 1e10]), None),
        (colored([3e38, 3e38, 0.0]), Some(GridMediumError::SigmaT)),
        (colored([1e20, 0.0, 1e20]), Some(GridMediumError::Emission)),
    ] {
        if let Ok(here) = found {
            let all = here.sigma_a + here.sigma_s + here.emission;
            assert!(all.is_finite(), "{here:?}");
        }
        assert_eq!(found.err(), expected, "{found:?}");
    }
    let empty = Aabb::EMPTY;
    let density = DensityGrid::new([1; 3], [1.0]).expect("a grid");
    let substance = Substance::<Rgb>::default();
    let refused = GridMedium::new(
        substance,
        phase,
        empty,
        Affine3A::IDENTITY,
        density,
        uniform(),
    )
    .err();
    let expected = GridMediumError::Region(RegionError::Bounds);
    assert_eq!(refused, Some(expected), "empty");
}
