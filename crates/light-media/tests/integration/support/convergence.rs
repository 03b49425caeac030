//! How a marched transmittance converges to the truth, and to what trackers say, as its step
//! shrinks.

use light_math::Aabb;
use light_math::glam::{Affine3A, Vec3};
use light_media::phase::Isotropic;
use light_media::{
    AnyMedium, DensityGrid, ExponentialHeight, Glow, GridMedium, Medium, Phase, Ray, Region, Span,
    StepSize, Substance, transmittance,
};
use light_sources::Rgb;
use light_testkit::{Estimate, Rng};

/// The errors of marches with one step size, over all jitters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MarchError {
    /// The length of the steps.
    pub(crate) step: f64,
    /// Root of the mean squared error.
    pub(crate) rms: f64,
    /// Distance of the mean from the truth.
    pub(crate) bias: f64,
}

/// The media in which marches are measured.
#[must_use]
pub(crate) fn media() -> [(&'static str, AnyMedium<Rgb>); 2] {
    let substance =
        || Substance::new(Vec3::splat(0.3), Vec3::splat(0.7), Vec3::ZERO).expect("valid");
    let phase = Phase::Isotropic(Isotropic);
    let fog = ExponentialHeight::new(
        substance(),
        phase,
        Region::UNBOUNDED,
        Vec3::ZERO,
        Vec3::X,
        1.5,
    );
    let values = (0..6 * 5 * 4).map(|i: u16| f32::from(i * 37 % 11) * 0.15);
    let density = DensityGrid::new([6, 5, 4], values.collect()).expect("valid");
    let bounds = Aabb::new(Vec3::ZERO, Vec3::new(2.0, 1.0, 1.0));
    let cloud = GridMedium::new(
        substance(),
        phase,
        bounds,
        Affine3A::IDENTITY,
        density,
        Glow::uniform(),
    );
    [
        ("fog", fog.expect("valid").into()),
        ("cloud", cloud.expect("valid").into()),
    ]
}

/// The ray along which they are measured.
const RAY: Ray = Ray {
    o: Vec3::new(0.0, 0.3, 0.4),
    d: Vec3::X,
};

/// The part of it.
const SPAN: Span = Span { t0: 0.0, t1: 2.0 };

/// The optical thickness by the midpoint rule, far finer than any march.
#[must_use]
pub(crate) fn truth(medium: &AnyMedium<Rgb>) -> f64 {
    let n = 1 << 18;
    let h = f64::from(SPAN.length()) / f64::from(n);
    #[expect(clippy::cast_possible_truncation, reason = "a distance")]
    let sigma_t = |i: i32| {
        medium
            .coefficients(RAY.at(((f64::from(i) + 0.5) * h) as f32), &())
            .sigma_t()
    };
    let thickness = (0..n).map(|i| f64::from(sigma_t(i).x) * h).sum::<f64>();
    (-thickness).exp()
}

/// The errors of steps that halve from half of the span on.
#[must_use]
pub(crate) fn march_errors(medium: &AnyMedium<Rgb>) -> Vec<MarchError> {
    const JITTERS: u16 = 2048;
    let truth = truth(medium);
    let of = |halvings: i32| {
        let length = SPAN.length() * 0.5f32.powi(halvings);
        let step = StepSize::new(length).expect("positive");
        let (mut sum, mut squares) = (0.0, 0.0);
        for i in 0..JITTERS {
            let jitter = (f32::from(i) + 0.5) / f32::from(JITTERS);
            let left = transmittance::march::<Rgb, _>(medium, &RAY, SPAN, step, jitter, &());
            let error = f64::from(left.x) - truth;
            sum += error;
            squares += error * error;
        }
        MarchError {
            step: length.into(),
            rms: (squares / f64::from(JITTERS)).sqrt(),
            bias: (sum / f64::from(JITTERS)).abs(),
        }
    };
    (1..=6).map(of).collect()
}

/// The mean of ratio tracking.
#[must_use]
pub(crate) fn tracked(medium: &AnyMedium<Rgb>) -> Estimate {
    let mut rng = Rng::new(11);
    Estimate::of(1 << 17, || {
        let left =
            transmittance::ratio_tracking::<Rgb, _>(medium, &RAY, SPAN, &(), &mut || rng.f32());
        left.x.into()
    })
}

/// The slope of the straight line through the logarithms of steps and errors, by least squares.
#[must_use]
pub(crate) fn slope(points: impl Iterator<Item = (f64, f64)> + Clone) -> f64 {
    let logs = points.map(|(x, y)| (x.ln(), y.ln()));
    let n = logs.clone().count() as f64;
    let (sx, sy) = logs
        .clone()
        .fold((0.0, 0.0), |(a, b), (x, y)| (a + x, b + y));
    let (mx, my) = (sx / n, sy / n);
    let products = logs.clone().map(|(x, y)| (x - mx) * (y - my)).sum::<f64>();
    products / logs.map(|(x, _)| (x - mx) * (x - mx)).sum::<f64>()
}
