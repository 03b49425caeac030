//! What media are where nothing is said of them.

use light_media::glam::Vec3;
use light_media::light_sources::{ColorModel, Radiance, Rgb, Spectral};
use light_media::{
    AnyMedium, Coefficients, Homogeneous, Medium, Phase, PhaseFunction, Ray, Region, Span,
    Substance, transmittance,
};

/// Whether all light passes the default medium, and none is added.
fn is_vacuum<C: ColorModel>() -> bool
where
    Homogeneous<C>: Default,
{
    let wavelengths = C::reference_wavelengths();
    let ray = Ray {
        o: Vec3::ZERO,
        d: Vec3::X,
    };
    let span = Span { t0: 0.0, t1: 1e6 };
    let medium = AnyMedium::<C>::default();
    transmittance::closed_form::<C, _>(&medium, &ray, span, &wavelengths)
        .is_some_and(|left| left == C::Radiance::splat(1.0))
        && medium.coefficients(Vec3::ONE, &wavelengths) == Coefficients::default()
        && medium.clip(&ray, span) == Some(span)
}

#[test]
fn media_are_vacuum_by_default() {
    assert!(is_vacuum::<Rgb>(), "RGB");
    assert!(is_vacuum::<Spectral<4>>(), "spectral");
}

#[test]
fn what_is_not_said_is_the_default() {
    let fog = Homogeneous::<Rgb> {
        substance: Substance::new(Vec3::splat(0.1), Vec3::ONE, Vec3::ZERO).expect("valid"),
        ..Homogeneous::default()
    };
    assert_eq!(fog.region, Region::UNBOUNDED, "everywhere");
    assert_eq!(fog.phase, Phase::default(), "isotropic");
    let sphere = 4.0 * core::f32::consts::PI;
    for cos_theta in [-1.0, 0.3, 1.0] {
        let value = Phase::default().value(cos_theta) * sphere;
        assert!((value - 1.0).abs() < 1e-6, "{cos_theta}: {value}");
    }
}
