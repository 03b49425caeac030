//! Where trackers and marches stop, what they carry, and that roulette keeps their means.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "quadrature in f64, places in a table"
)]

use light_math::Aabb;
use light_math::glam::{Affine3A, Vec3};
use light_media::phase::Isotropic;
use light_media::{
    DensityGrid, ExponentialHeight, Flight, Glow, Grid, GridMedium, Homogeneous, Medium, Phase,
    Ray, Region, Span, StepSize, Substance, delta_tracking, emission, transmittance,
};
use light_sources::Rgb;
use light_testkit::{DensityTest, Estimate, Rng};

const RAY: Ray = Ray {
    o: Vec3::new(-0.2, 0.3, 0.4),
    d: Vec3::X,
};
const SPAN: Span = Span { t0: 0.0, t1: 2.5 };
const PHASE: Phase = Phase::Isotropic(Isotropic);

/// Absorption and scattering that differ from channel to channel.
fn coloured() -> Substance<Rgb> {
    let (sigma_a, sigma_s) = (Vec3::new(0.3, 0.9, 0.1), Vec3::new(1.2, 0.4, 0.2));
    Substance::new(sigma_a, sigma_s, Vec3::new(2.0, 0.5, 1.0)).expect("valid")
}

/// One that only scatters, alike in all channels.
fn gray() -> Substance<Rgb> {
    Substance::new(Vec3::ZERO, Vec3::splat(1.1), Vec3::ZERO).expect("valid")
}

fn cloud(substance: Substance<Rgb>) -> GridMedium<Rgb, Vec<f32>> {
    let values = (0..6 * 5 * 4).map(|i: u16| f32::from(i * 37 % 11) * 0.3);
    let density = DensityGrid::new([6, 5, 4], values.collect()).expect("valid");
    let cube = Aabb::new(Vec3::ZERO, Vec3::new(2.0, 1.0, 1.0));
    let (identity, glow) = (Affine3A::IDENTITY, Glow::uniform());
    GridMedium::new(substance, PHASE, cube, identity, density, glow).expect("valid")
}

fn fog(substance: Substance<Rgb>) -> ExponentialHeight<Rgb> {
    let up = Vec3::new(1.0, 0.2, 0.0);
    ExponentialHeight::new(substance, PHASE, Region::UNBOUNDED, Vec3::ZERO, up, 1.5).expect("valid")
}

/// The transmittance up to each of many equally spaced distances, by the midpoint rule in `f64`.
struct Table {
    left: Vec<[f64; 3]>,
}

impl Table {
    const STEPS: usize = 1 << 15;

    fn new(medium: &impl Medium<Rgb>) -> Self {
        let step = f64::from(SPAN.length()) / Self::STEPS as f64;
        let mut thickness = [0.0; 3];
        let mut left = vec![[1.0; 3]];
        for i in 0..Self::STEPS {
            let t = f64::from(SPAN.t0) + (i as f64 + 0.5) * step;
            let sigma_t = medium.coefficients(RAY.at(t as f32), &()).sigma_t();
            for (sum, sigma) in thickness.iter_mut().zip(sigma_t.to_array()) {
                *sum += f64::from(sigma) * step;
            }
            left.push(thickness.map(|x| (-x).exp()));
        }
        Self { left }
    }

    fn at(&self, t: f64) -> [f64; 3] {
        let place = (t - f64::from(SPAN.t0)) / f64::from(SPAN.length()) * Self::STEPS as f64;
        let i = (place.max(0.0) as usize).min(Self::STEPS - 1);
        let f = place - i as f64;
        [0, 1, 2].map(|c| self.left[i][c] + f * (self.left[i + 1][c] - self.left[i][c]))
    }

    /// The integral of a coefficient times the transmittance, over a part of the span.
    fn integral(&self, [a, b]: [f64; 2], at: impl Fn(f64) -> Vec3) -> [f64; 3] {
        const N: u16 = 2000;
        let step = (b - a) / f64::from(N);
        let mut sum = [0.0; 3];
        for i in 0..N {
            let t = a + (f64::from(i) + 0.5) * step;
            let (left, sigma) = (self.at(t), at(t).to_array());
            (0..3).for_each(|c| sum[c] += left[c] * f64::from(sigma[c]) * step);
        }
        sum
    }
}

/// In a medium that only scatters, alike in all channels, every flight keeps its weight, and
/// distances have the density of scattering.
#[test]
fn scattering_distances_follow_their_density() {
    fn check(what: &str, medium: &impl Medium<Rgb>) {
        let table = Table::new(medium);
        let sample = |rng: &mut Rng| {
            let mut next_u = || rng.f32();
            let flight = delta_tracking(medium, &RAY, SPAN, Vec3::ONE, &(), &mut next_u);
            assert!(
                (flight.weight - 1.0).abs().max_element() < 1e-4,
                "{flight:?}"
            );
            flight.scattered_at
        };
        let pdf = |t: f32| {
            let sigma_s = medium.coefficients(RAY.at(t), &()).sigma_s.x;
            sigma_s * table.at(t.into())[0] as f32
        };
        let outcome = DensityTest::default().interval([SPAN.t0, SPAN.t1], sample, pdf);
        outcome.assert(what);
    }
    check("cloud", &cloud(gray()));
    check("fog", &fog(gray()));
}

/// With absorption, and with channels that differ, the weights of the flights that end in a part of
/// the ray add up to the scattering there; those that pass to the transmittance, and the emission
/// to what is emitted: for any throughput of the path.
#[test]
fn weights_of_flights_add_up_in_every_channel() {
    fn check(what: &str, medium: &impl Medium<Rgb>, beta: Vec3) {
        const FLIGHTS: u32 = 1 << 17;
        const PARTS: u8 = 5;
        let table = Table::new(medium);
        let mut rng = Rng::new(21);
        let flights: Vec<Flight<Vec3>> = (0..FLIGHTS)
            .map(|_| delta_tracking(medium, &RAY, SPAN, beta, &(), &mut || rng.f32()))
            .collect();
        let agree = |part: &str, value: &dyn Fn(&Flight<Vec3>) -> Vec3, truth: [f64; 3]| {
            for (c, truth) in truth.into_iter().enumerate() {
                let mut flights = flights.iter();
                let mean = Estimate::of(FLIGHTS, || {
                    flights.next().map_or(f64::NAN, |f| f64::from(value(f)[c]))
                });
                assert!(
                    mean.agrees_with(truth),
                    "{what}, {part}, channel {c}: {mean:?}, {truth}"
                );
            }
        };
        let weight_if =
            |is: bool, flight: &Flight<Vec3>| if is { flight.weight } else { Vec3::ZERO };
        let end = f64::from(SPAN.t1);
        agree(
            "passing",
            &|f| weight_if(f.scattered_at.is_none(), f),
            table.at(end),
        );
        agree(
            "emission",
            &|f| f.emitted,
            table.integral([0.0, end], |t| {
                medium.coefficients(RAY.at(t as f32), &()).emission
            }),
        );
        for i in 0..PARTS {
            let [a, b] = [i, i + 1].map(|i| end * f64::from(i) / f64::from(PARTS));
            let is_here =
                |f: &Flight<Vec3>| f.scattered_at.is_some_and(|t| (a..b).contains(&t.into()));
            agree(
                "scattering",
                &|f| weight_if(is_here(f), f),
                table.integral([a, b], |t| {
                    medium.coefficients(RAY.at(t as f32), &()).sigma_s
                }),
            );
        }
    }
    check("cloud", &cloud(coloured()), Vec3::ONE);
    check(
        "fog, coloured path",
        &fog(coloured()),
        Vec3::new(0.2, 3.0, 1.0),
    );
}

/// Light that is nearly all gone is dropped half of the time, so what is left counts twice.
#[test]
fn roulette_keeps_the_mean_of_ratio_tracking() {
    let medium = Homogeneous {
        substance: Substance::new(Vec3::new(10.0, 4.0, 2.5), Vec3::ZERO, Vec3::ZERO)
            .expect("valid"),
        phase: PHASE,
        region: Region::UNBOUNDED,
    };
    let span = Span { t0: 0.0, t1: 4.0 };
    let mut rng = Rng::new(22);
    let mut survivors = 0;
    let mean = Estimate::of(1 << 17, || {
        let mut next_u = || rng.f32();
        let left = transmittance::ratio_tracking::<Rgb, _>(&medium, &RAY, span, &(), &mut next_u);
        survivors += u32::from(left.z > 0.0);
        left.z.into()
    });
    let truth = (-10.0f64).exp();
    assert!(mean.agrees_with(truth), "{mean:?}, {truth}");
    // With channel z alone no weight ever vanishes: all that is missing was dropped.
    assert!(survivors < 1 << 13, "{survivors} survivors");
}

/// A thick dark wall in front of a bright glow: nearly all marches end in the wall, the others
/// count for them.
#[test]
fn roulette_keeps_the_mean_of_marches() {
    let substance = Substance::<Rgb>::new(Vec3::splat(4.0), Vec3::ZERO, Vec3::splat(1e5));
    let density = DensityGrid::new([2, 1, 1], vec![2.5, 0.1]).expect("valid");
    let glow = Glow::scaled(Grid::new([2, 1, 1], vec![0.0, 1.0]).expect("valid"));
    let cube = Aabb::new(Vec3::ZERO, Vec3::new(2.0, 2.0, 2.0));
    let identity = Affine3A::IDENTITY;
    let medium = GridMedium::new(
        substance.expect("valid"),
        PHASE,
        cube,
        identity,
        density,
        glow,
    );
    let medium = medium.expect("valid");
    let ray = Ray {
        o: Vec3::new(-0.5, 1.0, 1.0),
        d: Vec3::X,
    };
    let span = Span { t0: 0.0, t1: 9.0 };

    // The same in many small steps, without roulette.
    let (mut thickness, mut truth) = (0.0, 0.0);
    let n = 100_000;
    let step = 2.0 / f64::from(n);
    for i in 0..n {
        let t = 0.5 + (f64::from(i) + 0.5) * step;
        let here = medium.coefficients(ray.at(t as f32), &());
        let sigma_t = f64::from(here.sigma_t().x) * step;
        truth += (-thickness - 0.5 * sigma_t).exp() * f64::from(here.emission.x) * step;
        thickness += sigma_t;
    }
    let through = (-thickness).exp();
    assert!(through < 3e-4, "a thick wall: {through}");

    let mut rng = Rng::new(23);
    let step = StepSize::new(0.01).expect("positive");
    let mut dropped = 0;
    let marches: Vec<_> = (0..1 << 14)
        .map(|_| emission::<Rgb, _>(&medium, &ray, span, step, &(), &mut || rng.f32()))
        .inspect(|march| dropped += u32::from(march.transmittance == Vec3::ZERO))
        .collect();
    assert!(dropped > 1 << 12, "{dropped} marches end early");
    let mut each = marches.iter();
    let mut next = || each.next().expect("as many");
    let light = Estimate::of(1 << 14, || next().l.x.into());
    let mut each = marches.iter();
    let mut next = || each.next().expect("as many");
    let left = Estimate::of(1 << 14, || next().transmittance.x.into());
    // The error of steps, which falls with their square, is far below that of chance.
    assert!(light.agrees_with(truth), "emission {light:?}, {truth}");
    assert!(
        left.agrees_with(through),
        "transmittance {left:?}, {through}"
    );
}
