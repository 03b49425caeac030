//! The laws of tables: samples follow the density, what is left of `u` is uniform again, weights
//! that are invalid are refused, and nothing is ever returned that has no weight.

#![expect(
    clippy::cast_possible_truncation,
    reason = "probabilities are rounded to floats"
)]

use light_math::discrete::{self, SampledIndex};
use light_math::distribution::{
    AliasTable, PiecewiseConstant1D, PiecewiseConstant2D, SummedAreaTable, TableError, Window,
    WindowedPiecewiseConstant2D,
};
use light_math::fraction;
use light_math::glam::Vec2;
use light_math::spectrum::SampledWavelengths;
use light_math::spectrum::cie::{LAMBDA_MAX, LAMBDA_MIN};
use light_testkit::{DensityTest, Rng, chi_squared, edge_cases, kolmogorov_smirnov_uniform};
use proptest::prelude::*;

/// Twelve columns and rows, so that the cells of the tests are texels.
const TEXELS: usize = 12;

/// Weights over several orders of magnitude, some of them zero.
fn weights(count: usize) -> Vec<f32> {
    let mut rng = Rng::new(3);
    (0..count)
        .map(|i| {
            if i % 5 == 2 {
                0.0
            } else {
                rng.log_range(1e-2, 10.0)
            }
        })
        .collect()
}

#[test]
fn tables_follow_their_densities() {
    let test = DensityTest::default();
    let line = PiecewiseConstant1D::new(&weights(TEXELS * TEXELS)).expect("weights");
    test.interval(
        [0.0, 1.0],
        |rng| Some(line.sample(rng.f32()).x),
        |x| line.pdf(x),
    )
    .assert("1d");

    let weights = weights(TEXELS * TEXELS);
    let plane = PiecewiseConstant2D::new(&weights, TEXELS, TEXELS).expect("weights");
    test.square(|rng| Some(plane.sample(rng.vec2()).p), |p| plane.pdf(p))
        .assert("2d");

    let sums = SummedAreaTable::new(&weights, TEXELS, TEXELS).expect("weights");
    let windowed = WindowedPiecewiseConstant2D::new(sums);
    for [x0, y0, x1, y1] in [
        [0.0, 0.0, 1.0, 1.0],
        [0.1, 0.3, 0.77, 0.9],
        [0.51, 0.2, 0.57, 0.24],
    ] {
        let window = Window::new(Vec2::new(x0, y0), Vec2::new(x1, y1));
        test.rectangle(
            [window.min, window.max],
            |rng| windowed.sample(rng.vec2(), &window).map(|s| s.p),
            |p| windowed.pdf(p, &window),
        )
        .assert("windowed");
    }
}

/// Each of the wavelengths of a path follows the density that it carries.
#[test]
fn wavelengths_follow_their_densities() {
    let range = [LAMBDA_MIN, LAMBDA_MAX];
    let width = LAMBDA_MAX - LAMBDA_MIN;
    let density = |draw: fn(f32) -> SampledWavelengths<4>, i: usize| {
        // The density at any wavelength, from the nearest of many samples' tables.
        let mut table: Vec<(f32, f32)> = (0..1 << 14)
            .map(|k| draw((k as f32 + 0.5) / 16384.0))
            .map(|w| (w.lambda()[i], w.pdf()[i]))
            .collect();
        table.sort_by(|a, b| a.0.total_cmp(&b.0));
        move |x: f32| {
            let at = table.partition_point(|&(lambda, _)| lambda < x);
            table[at.min(table.len() - 1)].1
        }
    };
    for i in 0..4 {
        let even = |rng: &mut Rng| Some(SampledWavelengths::<4>::uniform(rng.f32()).lambda()[i]);
        DensityTest::default()
            .interval(range, even, |_| 1.0 / width)
            .assert("uniform");
        let visible = |rng: &mut Rng| Some(SampledWavelengths::<4>::visible(rng.f32()).lambda()[i]);
        DensityTest::default()
            .interval(range, visible, density(SampledWavelengths::visible, i))
            .assert("visible");
    }
}

/// Frequencies against probabilities, and the rest of `u` against the uniform distribution.
fn check_choice(what: &str, pmf: &[f64], mut choose: impl FnMut(u64) -> SampledIndex) {
    const SAMPLES: u32 = 1 << 16;
    let mut rng = Rng::new(9);
    let mut observed = vec![0; pmf.len()];
    let mut rests = Vec::new();
    for _ in 0..SAMPLES {
        let chosen = choose(rng.u64());
        assert_eq!(
            f64::from(chosen.pmf),
            pmf[chosen.index],
            "{what}: {chosen:?}"
        );
        observed[chosen.index] += 1;
        rests.push(fraction::to_f64(chosen.u));
    }
    let expected: Vec<f64> = pmf.iter().map(|p| p * f64::from(SAMPLES)).collect();
    assert!(
        chi_squared(&observed, &expected).passes(),
        "{what}: frequencies"
    );
    assert!(
        kolmogorov_smirnov_uniform(&mut rests).passes(),
        "{what}: what is left of u"
    );
}

#[test]
fn choices_follow_their_probabilities() {
    let weights = weights(40);
    let pmfs = |pmf: &dyn Fn(usize) -> f32| -> Vec<f64> {
        (0..weights.len()).map(|i| f64::from(pmf(i))).collect()
    };
    let pmf = pmfs(&|i| discrete::pmf(&weights, i));
    check_choice("discrete", &pmf, |u| {
        discrete::sample(&weights, u).expect("weights")
    });
    let table = AliasTable::new(&weights).expect("weights");
    let pmf = pmfs(&|i| table.pmf(i));
    check_choice("alias table", &pmf, |u| table.sample(u));
}

/// Stratified random numbers give every one of a million weights its exact share.
#[test]
fn a_million_weights_get_their_shares() {
    const COUNT: usize = 1_000_000;
    let weights: Vec<f32> = (0..COUNT)
        .map(|i| if i % 1000 == 0 { 500.0 } else { 1.0 })
        .collect();
    let table = AliasTable::new(&weights).expect("weights");
    let mut mass = vec![0; COUNT];
    for (index, bin) in table.bins().iter().enumerate() {
        mass[index] += u64::from(bin.own);
        mass[bin.alias as usize] += u64::from(discrete::PARTS - bin.own);
    }
    let all = COUNT as f64 * f64::from(discrete::PARTS);
    for (index, mass) in mass.into_iter().enumerate() {
        let pmf = (mass as f64 / all) as f32;
        assert_eq!(pmf, table.pmf(index), "share of {index}");
    }
}

#[test]
fn sums_agree_with_adding_up() {
    let (nx, ny) = (7, 5);
    let weights = weights(nx * ny);
    let table = SummedAreaTable::new(&weights, nx, ny).expect("weights");
    for x0 in 0..nx {
        for x1 in x0..=nx {
            for y0 in 0..ny {
                for y1 in y0..=ny {
                    let rows = (y0..y1).flat_map(|y| (x0..x1).map(move |x| y * nx + x));
                    let exact: f64 = rows.map(|i| f64::from(weights[i])).sum();
                    let sum = table.sum(x0..x1, y0..y1);
                    assert!(
                        (sum - exact).abs() <= 1e-15 * exact,
                        "{x0} {x1} {y0} {y1}: {sum} {exact}"
                    );
                }
            }
        }
    }
}

/// What a builder should say of `weights`.
fn verdict(weights: &[f32]) -> Option<TableError> {
    let odd = weights.iter().position(|w| !w.is_finite() || *w < 0.0);
    match odd {
        _ if weights.is_empty() => Some(TableError::Empty),
        Some(index) if weights[index].is_finite() => Some(TableError::Negative { index }),
        Some(index) => Some(TableError::NotFinite { index }),
        None if weights.iter().all(|&w| w == 0.0) => Some(TableError::AllZero),
        None => None,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn builders_refuse_exactly_what_makes_no_sense(
        weights in prop::collection::vec(
            prop_oneof![8 => edge_cases::non_negative(), 1 => edge_cases::anything()],
            0..12,
        ),
    ) {
        let expected = verdict(&weights);
        prop_assert_eq!(AliasTable::new(&weights).err(), expected, "alias table");
        prop_assert_eq!(PiecewiseConstant1D::new(&weights).err(), expected, "1d");
        let n = weights.len();
        prop_assert_eq!(PiecewiseConstant2D::new(&weights, n, 1).err(), expected, "row");
        prop_assert_eq!(PiecewiseConstant2D::new(&weights, 1, n).err(), expected, "column");
        let sums = SummedAreaTable::new(&weights, n, 1).err();
        let expected = expected.filter(|&e| e != TableError::AllZero);
        prop_assert_eq!(sums, expected, "zeros have sums");
    }

    #[test]
    fn samples_have_weight(
        weights in prop::collection::vec(edge_cases::non_negative(), 1..40),
        u in edge_cases::unit_square(),
        u64 in any::<u64>(),
        columns in 1usize..5,
    ) {
        prop_assume!(verdict(&weights).is_none());
        let line = PiecewiseConstant1D::new(&weights).expect("weights");
        let s = line.sample(u.x);
        prop_assert!(weights[s.index] > 0.0 && s.pdf > 0.0 && line.pdf(s.x) == s.pdf, "1d {s:?}");

        let rows = weights.len() / columns;
        if let Ok(plane) = PiecewiseConstant2D::new(&weights[..columns * rows], columns, rows) {
            let s = plane.sample(u);
            let [x, y] = s.texel;
            prop_assert!(weights[y * columns + x] > 0.0 && s.pdf > 0.0, "2d {s:?}");
            prop_assert_eq!(plane.pdf(s.p), s.pdf, "2d {:?}", s);
        }

        let alias = AliasTable::new(&weights).expect("weights");
        prop_assert!(AliasTable::from_bins(alias.bins()).is_ok(), "its own bins");
        for s in [alias.sample(u64), discrete::sample(&weights, u64).expect("weights")] {
            prop_assert!(weights[s.index] > 0.0 && s.pmf > 0.0, "choice {s:?}");
        }
        let s = discrete::sample(&weights, u64).expect("weights");
        prop_assert_eq!(s.pmf, discrete::pmf(&weights, s.index), "same bits");
    }

    #[test]
    fn a_choice_is_where_the_running_sum_passes_u(
        weights in edge_cases::weights(1..20),
        u in any::<u64>(),
    ) {
        let share = |weights: &[f32]| weights.iter().map(|&w| f64::from(w)).sum::<f64>();
        let total = share(&weights);
        if let Some(s) = discrete::sample(&weights, u) {
            let (low, high) = (share(&weights[..s.index]), share(&weights[..=s.index]));
            let position = fraction::to_f64(u) * total;
            // A part a weight is kept back, and all before may be too many or too few.
            let rounding = (weights.len() + 1) as f64 / f64::from(discrete::PARTS) * total;
            prop_assert!(low - rounding <= position && position <= high + rounding, "{s:?}");
        } else {
            prop_assert!(total == 0.0, "a weight of {weights:?}");
        }
    }

    #[test]
    fn windows_hold_their_samples(
        weights in prop::collection::vec(edge_cases::non_negative(), 20),
        u in edge_cases::unit_square(),
        corners in prop::array::uniform2(edge_cases::unit_square()),
    ) {
        let sums = SummedAreaTable::new(&weights, 4, 5).expect("no odd weights");
        let windowed = WindowedPiecewiseConstant2D::new(sums);
        let window = Window::new(corners[0].min(corners[1]), corners[0].max(corners[1]));
        if let Some(s) = windowed.sample(u, &window) {
            let [x, y] = s.texel;
            prop_assert!(window.contains(s.p) && weights[y * 4 + x] > 0.0, "{s:?} in {window:?}");
            prop_assert!(s.pdf > 0.0 && windowed.pdf(s.p, &window) == s.pdf, "{s:?} in {window:?}");
        } else {
            prop_assert!(windowed.table().integral(&window) < 1e-30, "something in {window:?}");
        }
    }
}
