//! What media of every kind have in common: they end where their region ends, they scatter by the
//! phase function that they were given, and the enum of all kinds gives the same values.

use light_math::Aabb;
use light_math::glam::{Affine3A, Vec3};
use light_media::phase::HenyeyGreenstein;
use light_media::{
    AnyMedium, Coefficients, CoefficientsError, ColorGrid, ColorGridMedium, DensityGrid,
    ExponentialHeight, Glow, Grid, GridMedium, Homogeneous, Incandescence, Medium, Phase, Ray,
    Region, Span, Substance, TemperatureGrid,
};
use light_sources::Rgb;

const SPAN: Span = Span { t0: 0.0, t1: 9.0 };
const IDENTITY: Affine3A = Affine3A::IDENTITY;

fn cube() -> Aabb {
    Aabb::new(Vec3::ZERO, Vec3::ONE)
}

fn region() -> Region {
    Region::new(cube(), IDENTITY).expect("a box")
}

fn substance() -> Substance<Rgb> {
    let le = Vec3::new(2.0, 0.5, 1.0);
    Substance::new(Vec3::new(0.3, 0.9, 0.1), Vec3::splat(0.5), le).expect("valid")
}

fn phase() -> Phase {
    Phase::HenyeyGreenstein(HenyeyGreenstein::new(0.25).expect("in range"))
}

/// In the box, nothing outside, and the same as one of any kind.
fn assert_kind<M: Medium<Rgb> + Clone + Into<AnyMedium<Rgb>>>(medium: &M, what: &str) {
    let any: AnyMedium<Rgb> = medium.clone().into();
    assert_eq!(medium.phase(), &phase(), "{what}: the phase function");
    assert_eq!(any.phase(), &phase(), "{what}: the phase function of any");
    for outside in [Vec3::splat(1.5), Vec3::new(0.5, -0.5, 0.5), Vec3::NAN] {
        let found = medium.coefficients(outside, &());
        assert_eq!(found, Coefficients::VACUUM, "{what} at {outside}");
    }
    let middle = Vec3::new(0.5, 0.4, 0.6);
    let here = medium.coefficients(middle, &());
    assert!(here.sigma_s.min_element() > 0.0, "{what}: {here:?}");
    assert_eq!(any.coefficients(middle, &()), here, "{what} and any");
    let ray = Ray {
        o: Vec3::new(-1.0, 0.4, 0.6),
        d: Vec3::X,
    };
    let inside = medium.clip(&ray, SPAN);
    assert_eq!(any.clip(&ray, SPAN), inside, "{what}: clipped");
    let inside = inside.unwrap_or_else(|| panic!("{what} is on the ray"));
    let [found, expected] = [
        any.optical_thickness(&ray, inside, &()),
        medium.optical_thickness(&ray, inside, &()),
    ];
    assert_eq!(found, expected, "{what}: optical thickness");
}

#[test]
fn every_kind_ends_with_its_region_and_is_itself_in_the_enum() {
    let homogeneous = Homogeneous {
        substance: substance(),
        phase: phase(),
        region: region(),
    };
    assert_kind(&homogeneous, "homogeneous");
    let fog = ExponentialHeight::new(substance(), phase(), region(), Vec3::ZERO, Vec3::Y, 1.5);
    assert_kind(&fog.expect("valid"), "exponential");
    let density = DensityGrid::new([2, 1, 1], vec![1.0, 2.0]).expect("valid");
    let glow = Glow::uniform();
    let grid = GridMedium::new(substance(), phase(), cube(), IDENTITY, density, glow);
    assert_kind(&grid.expect("valid"), "a grid");
    let channels = |x: f32| {
        let grid = Grid::new([1, 1, 1], vec![x, 2.0 * x, x]).expect("valid");
        ColorGrid::new([Vec3::X, Vec3::Y, Vec3::Z], grid).expect("a basis")
    };
    let (absorbs, scatters) = (channels(0.1), channels(0.5));
    let coloured = ColorGridMedium::new(absorbs, scatters, None, phase(), cube(), IDENTITY);
    assert_kind(&coloured.expect("valid"), "a coloured grid");
}

/// A grid of temperatures emits the colours of black bodies, times the factor without colour.
#[test]
fn a_hot_grid_emits_what_black_bodies_emit() {
    let black_body = Rgb::blackbody(3000.0).expect("a temperature");
    let kelvin = Grid::new([1, 1, 1], vec![3000.0]).expect("valid");
    let hot = Glow::of_temperature(TemperatureGrid::<Rgb, _>::new(kelvin));
    let half = Glow {
        scale: Some(Grid::new([1, 1, 1], vec![0.5]).expect("valid")),
        ..hot.clone()
    };
    for (glow, factor) in [(hot, 1.0), (half, 0.5)] {
        let density = DensityGrid::new([1, 1, 1], vec![1.0]).expect("valid");
        let medium = GridMedium::new(substance(), phase(), cube(), IDENTITY, density, glow);
        let medium = medium.expect("valid");
        let found = medium.coefficients(Vec3::splat(0.5), &()).emission;
        let plain = Homogeneous {
            substance: substance(),
            phase: phase(),
            region: region(),
        };
        let plain = plain.coefficients(Vec3::splat(0.5), &()).emission;
        let expected = plain * black_body * factor;
        let error = ((found - expected) / expected).abs().max_element();
        assert!(error < 1e-3, "{factor}: {found}, {expected}");
    }
}

#[test]
fn each_coefficient_has_its_error() {
    let new = |a, s, le| Substance::<Rgb>::new(a, s, le).err();
    for wrong in [Vec3::NEG_X, Vec3::NAN, Vec3::splat(f32::INFINITY)] {
        let found = [
            new(wrong, Vec3::ONE, Vec3::ONE),
            new(Vec3::ONE, wrong, Vec3::ONE),
            new(Vec3::ONE, Vec3::ONE, wrong),
        ];
        let expected = [
            CoefficientsError::SigmaA,
            CoefficientsError::SigmaS,
            CoefficientsError::Le,
        ];
        assert_eq!(found, expected.map(Some), "{wrong}");
    }
    let [huge, large] = [3e38, 1e20].map(Vec3::splat);
    for (found, expected) in [
        (new(huge, huge, Vec3::ZERO), CoefficientsError::SigmaT),
        (new(large, Vec3::ZERO, large), CoefficientsError::Emission),
        (new(huge, huge, huge), CoefficientsError::SigmaT),
    ] {
        assert_eq!(found, Some(expected), "overflow");
    }
    assert_eq!(new(huge, Vec3::ZERO, Vec3::ONE), None, "large");
}
