use super::*;
use crate::phase::Isotropic;
use light_sources::Rgb;

fn fog() -> ExponentialHeight<Rgb> {
    let substance = Substance::new(Vec3::ZERO, Vec3::splat(0.5), Vec3::ZERO).expect("valid");
    let phase = Phase::Isotropic(Isotropic);
    ExponentialHeight::new(
        substance,
        phase,
        Region::UNBOUNDED,
        Vec3::Y,
        Vec3::Y * 3.0,
        0.7,
    )
    .expect("valid")
}

fn rays() -> [Ray; 6] {
    [
        (Vec3::ZERO, Vec3::Y),
        (Vec3::Y * 9.0, Vec3::NEG_Y),
        (Vec3::ZERO, Vec3::X),
        (Vec3::Y * 3.0, Vec3::Z),
        (Vec3::Y * 1.5, Vec3::new(1.0, 1e-5, 0.0)),
        (Vec3::Y * -2.0, Vec3::new(0.6, 0.8, 0.0)),
    ]
    .map(|(o, d)| Ray { o, d })
}

#[test]
fn optical_thickness_agrees_with_quadrature() {
    let fog = fog();
    for ray in rays() {
        let span = Span { t0: 0.25, t1: 7.0 };
        let n = 4000u16;
        let h = span.length() / f32::from(n);
        let sum: f64 = (0..n)
            .map(|i| {
                f64::from(
                    fog.coefficients(ray.at(span.t0 + (f32::from(i) + 0.5) * h), &())
                        .sigma_t()
                        .x,
                )
            })
            .sum();
        let expected = sum * f64::from(h);
        let closed = f64::from(
            fog.optical_thickness(&ray, span, &())
                .expect("closed form")
                .x,
        );
        assert!(
            (closed - expected).abs() < 1e-4 * expected,
            "{ray:?}: {closed} against {expected}"
        );
    }
}

#[test]
fn majorants_bound_the_extinction_and_fill_the_span() {
    let fog = fog();
    for ray in rays() {
        let span = Span { t0: 0.0, t1: 60.0 };
        let mut t = span.t0;
        for segment in fog.majorants(&ray, span, &()) {
            assert_eq!(segment.span.t0, t, "no gap");
            t = segment.span.t1;
            for i in 0..=8u8 {
                let p = ray.at(segment.span.t0 + segment.span.length() * f32::from(i) / 8.0);
                let sigma_t = fog.coefficients(p, &()).sigma_t().x;
                assert!(
                    sigma_t <= segment.sigma_maj,
                    "{ray:?}: {sigma_t} above {}",
                    segment.sigma_maj
                );
            }
        }
        assert_eq!(t, span.t1, "filled");
    }
}

#[test]
fn a_ray_without_end_keeps_what_the_fog_leaves() {
    let up = Ray {
        o: Vec3::Y,
        d: Vec3::Y,
    };
    let tau = fog()
        .optical_thickness(
            &up,
            Span {
                t0: 0.0,
                t1: f32::INFINITY,
            },
            &(),
        )
        .expect("closed form");
    assert!(
        (tau.x - 0.5 / 0.7).abs() < 1e-6,
        "the whole atmosphere: {tau}"
    );
}

#[test]
fn nonsense_is_refused() {
    let make = |base, up, falloff| {
        let substance = Substance::<Rgb>::new(Vec3::ONE, Vec3::ONE, Vec3::ZERO).expect("valid");
        let phase = Phase::Isotropic(Isotropic);
        ExponentialHeight::new(substance, phase, Region::UNBOUNDED, base, up, falloff).err()
    };
    assert_eq!(
        make(Vec3::NAN, Vec3::Y, 1.0),
        Some(ExponentialHeightError::Base),
        "base"
    );
    assert_eq!(
        make(Vec3::ZERO, Vec3::ZERO, 1.0),
        Some(ExponentialHeightError::Up),
        "up"
    );
    assert_eq!(
        make(Vec3::ZERO, Vec3::Y, -1.0),
        Some(ExponentialHeightError::Falloff),
        "falloff"
    );
}
