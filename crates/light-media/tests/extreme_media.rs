//! Media whose coefficients are many orders of magnitude apart.

use light_media::glam::Vec3;
use light_media::phase::{Isotropic, Phase};
use light_media::transmittance::ratio_tracking;
use light_media::{Homogeneous, Ray, Region, Span, Substance, delta_tracking};
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
