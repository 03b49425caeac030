//! The laws of reservoirs: frequencies, unbiased weights for one receiver and across receivers, and
//! merging as streaming.

#![expect(
    clippy::cast_possible_truncation,
    reason = "indices of a few candidates"
)]

use light_math::distribution::WeightedReservoir;
use light_math::fraction;
use light_testkit::{Estimate, Rng, chi_squared};

type Reservoir = WeightedReservoir<usize>;

/// One row a receiver.
type Targets = [[f32; 6]; 3];

/// What is summed: one entry a candidate, over several orders of magnitude, one of them 0.
const F: [f64; 6] = [0.3, 2.0, 0.0, 40.0, 1.0, 7.0];

/// The density that candidates are drawn with; it reaches all of them.
const SOURCE: [f64; 6] = [0.3, 0.25, 0.1, 0.05, 0.2, 0.1];

/// Targets of three receivers, none in proportion to `F`. The first reaches all of `F`; the others
/// miss a part of it.
const TARGETS: Targets = [
    [1.0, 1.5, 0.4, 9.0, 2.0, 3.0],
    [2.0, 0.0, 0.4, 1.0, 3.0, 0.0],
    [0.0, 5.0, 0.0, 0.0, 1.0, 8.0],
];

/// The candidates of each receiver.
const COUNTS: [u32; 3] = [1, 4, 3];

const DRAWS: u32 = 1 << 17;

fn draw(rng: &mut Rng) -> usize {
    let u = rng.f64();
    let mut before = 0.0;
    let passed = |p: &f64| {
        before += p;
        u < before
    };
    SOURCE.iter().position(passed).unwrap_or(F.len() - 1)
}

/// A reservoir of `count` candidates for a target.
fn stream(target: &[f32; 6], count: u32, rng: &mut Rng) -> Reservoir {
    let mut reservoir = Reservoir::new();
    for _ in 0..count {
        let index = draw(rng);
        let weight = target[index] / SOURCE[index] as f32;
        reservoir.add(index, target[index], weight, rng.u64());
    }
    reservoir
}

/// The reservoirs of all three receivers.
fn neighbours(targets: &Targets, rng: &mut Rng) -> [Reservoir; 3] {
    core::array::from_fn(|i| stream(&targets[i], COUNTS[i], rng))
}

/// The reservoirs of others at the first receiver.
fn merge(reservoirs: [Reservoir; 3], rng: &mut Rng) -> Reservoir {
    let mut merged = Reservoir::new();
    for reservoir in reservoirs {
        merged.merge(reservoir, |&index| TARGETS[0][index], rng.u64());
    }
    merged
}

/// What `F` is at the kept value, times a weight.
fn estimate(kept: &Reservoir, weight: f32) -> f64 {
    kept.value()
        .map_or(0.0, |&index| F[index] * f64::from(weight))
}

fn total() -> f64 {
    F.iter().sum()
}

#[test]
fn weights_are_unbiased_for_any_count() {
    let mut rng = Rng::new(71);
    for count in [1, 2, 5, 16, 64] {
        let mean = Estimate::of(DRAWS, || {
            let kept = stream(&TARGETS[0], count, &mut rng);
            estimate(&kept, kept.contribution_weight())
        });
        assert!(mean.agrees_with(total()), "{count} candidates: {mean:?}");
    }
}

#[test]
fn totals_are_those_of_the_target() {
    let mut rng = Rng::new(72);
    for target in &TARGETS {
        let mean = Estimate::of(DRAWS, || {
            let kept = stream(target, 4, &mut rng);
            f64::from(kept.total()) / f64::from(kept.count())
        });
        let exact = target.iter().map(|&t| f64::from(t)).sum();
        assert!(mean.agrees_with(exact), "{target:?}: {mean:?}");
    }
}

#[test]
fn a_limit_leaves_the_weights_unbiased() {
    let mut rng = Rng::new(73);
    let mean = Estimate::of(DRAWS, || {
        let mut kept = Reservoir::new();
        for _frame in 0..4 {
            kept.merge(
                stream(&TARGETS[0], 3, &mut rng),
                |&i| TARGETS[0][i],
                rng.u64(),
            );
            kept.limit_count(5);
        }
        estimate(&kept, kept.contribution_weight())
    });
    assert!(mean.agrees_with(total()), "{mean:?}");
}

/// The kept value of every order of merging is distributed as the one of the whole stream.
#[test]
fn merging_is_distributed_as_streaming() {
    // Fixed candidates, so that the probabilities are known.
    let weights = [3.0, 1.0, 0.0, 8.0, 0.5, 2.0, 1.5];
    let all: f64 = weights.iter().map(|&w| f64::from(w)).sum();
    let expected: Vec<f64> = weights
        .iter()
        .map(|&w| f64::from(w) / all * f64::from(DRAWS))
        .collect();
    let part = |range: core::ops::Range<usize>, rng: &mut Rng| {
        let mut reservoir = Reservoir::new();
        for index in range {
            reservoir.add(index, weights[index], weights[index], rng.u64());
        }
        reservoir
    };
    let parts: [&[usize]; 5] = [&[7], &[3, 7], &[1, 2, 3, 7], &[0, 5, 5, 7], &[1, 7]];
    let mut rng = Rng::new(74);
    for ends in parts {
        let mut observed = vec![0; weights.len()];
        for _ in 0..DRAWS {
            let (mut merged, mut start) = (Reservoir::new(), 0);
            for &end in ends {
                let other = part(start..end, &mut rng);
                merged.merge(other, |&index| weights[index], rng.u64());
                start = end;
            }
            let sum = f64::from(merged.total());
            assert!((sum - all).abs() < 1e-5 && merged.count() == 7, "{ends:?}");
            observed[*merged.value().expect("a weight")] += 1;
        }
        assert!(chi_squared(&observed, &expected).passes(), "{ends:?}");
    }
}

/// Candidates of the three receivers whose target of a value is above 0.
fn reach(targets: &Targets, index: usize) -> u32 {
    let counted = targets.iter().zip(COUNTS);
    counted
        .map(|(t, n)| if t[index] > 0.0 { n } else { 0 })
        .sum()
}

/// The merged estimate, divided by the candidates that reach the kept value.
fn counted(targets: &Targets, rng: &mut Rng) -> Estimate {
    Estimate::of(DRAWS, || {
        let kept = merge(neighbours(targets, rng), rng);
        let count = kept.value().map_or(0, |&index| reach(targets, index));
        estimate(&kept, kept.contribution_weight_among(count))
    })
}

/// Across receivers whose targets miss something, dividing by all candidates loses a known part,
/// and counting those that reach the kept value loses nothing.
#[test]
fn merging_across_supports_has_the_means_that_are_stated() {
    let mut rng = Rng::new(75);
    let biased = Estimate::of(DRAWS, || {
        let kept = merge(neighbours(&TARGETS, &mut rng), &mut rng);
        assert_eq!(kept.count(), 8, "candidates");
        estimate(&kept, kept.contribution_weight())
    });
    let lost: f64 = (0..6)
        .map(|i| F[i] * f64::from(reach(&TARGETS, i)) / 8.0)
        .sum();
    assert!(biased.agrees_with(lost), "{biased:?}, stated {lost}");
    assert!(!biased.agrees_with(total()), "{biased:?}: a bias to see");

    let unbiased = counted(&TARGETS, &mut rng);
    assert!(unbiased.agrees_with(total()), "{unbiased:?}");
}

/// The merged estimate, by the balance heuristic of targets in place of a count.
fn weighted(targets: &Targets, rng: &mut Rng) -> Estimate {
    Estimate::of(DRAWS, || {
        let mut merged = Reservoir::new();
        for (i, own) in neighbours(targets, rng).iter().enumerate() {
            if let Some(&index) = own.value() {
                let of = |i: usize| COUNTS[i] as f32 * targets[i][index];
                let share = of(i) / (0..3).map(of).sum::<f32>();
                let target = TARGETS[0][index];
                let weight = share * target * own.contribution_weight();
                merged.add(index, target, weight, rng.u64());
            }
        }
        estimate(&merged, merged.contribution_weight_among(1))
    })
}

#[test]
fn merging_by_weights_is_unbiased_and_survives_small_targets() {
    let mut rng = Rng::new(76);
    let mean = weighted(&TARGETS, &mut rng);
    assert!(mean.agrees_with(total()), "{mean:?}");

    // In place of nothing, two receivers have a little where much is given.
    let small = TARGETS.map(|targets| targets.map(|t| f32::max(t, 0.02)));
    let [weights, counts] = [weighted, counted].map(|mean| mean(&small, &mut rng));
    for mean in [weights, counts] {
        assert!(mean.agrees_with(total()), "{mean:?}");
    }
    let gain = (counts.standard_error / weights.standard_error).powi(2);
    assert!(gain > 2.0, "{counts:?} by counts, {weights:?} by weights");
}

/// A value whose share of the weights is far below the step of a float is kept as often as it
/// should be.
#[test]
fn rare_values_are_kept_by_all_bits() {
    // A chance of 2^-30: of all numbers the lower 2^34.
    let keeps = |u: u64| {
        let mut reservoir = Reservoir::new();
        reservoir.add(0, 1.0, 1.0, u);
        reservoir.add(1, 1.0, 1.0 / (1 << 30) as f32, u);
        reservoir.value() == Some(&1)
    };
    assert!(keeps((1 << 34) - 1) && !keeps(1 << 34), "by all bits");
    assert!(fraction::to_f32(1 << 34) == 0.0, "which a float cuts off");
}
