use super::*;

fn of(weights: &[f32], u: u64) -> WeightedReservoir<usize> {
    let mut reservoir = WeightedReservoir::new();
    for (index, &weight) in weights.iter().enumerate() {
        reservoir.add(index, weight, weight, u);
    }
    reservoir
}

#[test]
fn an_empty_reservoir_has_nothing() {
    let mut empty = WeightedReservoir::<u8>::default();
    assert_eq!((empty.value(), empty.target()), (None, 0.0), "no value");
    assert_eq!((empty.total(), empty.count()), (0.0, 0), "no candidates");
    empty.add_none();
    assert_eq!(
        empty.contribution_weight(),
        0.0,
        "of a candidate of nothing"
    );
    assert_eq!(
        (empty.count(), empty.contribution_weight_among(0)),
        (1, 0.0)
    );
}

#[test]
fn nonsense_is_never_kept_but_counts() {
    let invalid = [f32::NAN, -1.0, f32::INFINITY, 0.0, f32::NEG_INFINITY];
    for u in [0, 1 << 63, u64::MAX] {
        for x in invalid {
            let mut reservoir = WeightedReservoir::new();
            reservoir.add('a', x, 1.0, u);
            reservoir.add('b', 1.0, x, u);
            let mut other = WeightedReservoir::new();
            other.add('c', 1.0, 1.0, u);
            reservoir.merge(other, |_| x, u);
            assert_eq!((reservoir.value(), reservoir.count()), (None, 3), "{x}");
            reservoir.add('d', f32::MIN_POSITIVE, f32::MIN_POSITIVE, u);
            reservoir.add('e', 0.0, x, u);
            assert_eq!(reservoir.value(), Some(&'d'), "the only one, {x}, {u}");
            assert_eq!(reservoir.contribution_weight(), 0.2, "{x}");
        }
    }
}

#[test]
fn sums_and_weights_stay_finite() {
    let large = of(&[f32::MAX, f32::MAX, f32::MAX], u64::MAX);
    assert_eq!(
        (large.value(), large.total()),
        (Some(&2), f32::MAX),
        "large"
    );
    let mut small = WeightedReservoir::new();
    small.add((), 1e-45, f32::MAX, 0);
    assert_eq!(small.contribution_weight(), f32::MAX, "over a small target");
    let mut merged = WeightedReservoir::new();
    merged.merge(small, |()| 1.0, 0);
    assert_eq!((merged.target(), merged.total()), (1.0, f32::MAX), "merged");
}

#[test]
fn the_first_weight_is_kept_whatever_u() {
    for u in [0, 1 << 63, u64::MAX] {
        assert_eq!(of(&[0.0, 3.0, f32::NAN], u).value(), Some(&1), "{u}");
    }
    assert_eq!(
        of(&[1.0, 3.0], (3 << 62) - 1).value(),
        Some(&1),
        "below 3/4"
    );
    assert_eq!(of(&[1.0, 3.0], 3 << 62).value(), Some(&0), "not below");
}

#[test]
fn a_limit_keeps_the_weight() {
    let mut reservoir = of(&[1.0, 2.0, 5.0, 8.0], 0);
    let before = reservoir.contribution_weight();
    reservoir.limit_count(4);
    assert_eq!(
        (reservoir.count(), reservoir.total()),
        (4, 16.0),
        "as it was"
    );
    reservoir.limit_count(1);
    assert_eq!(
        (reservoir.count(), reservoir.total()),
        (1, 4.0),
        "a quarter"
    );
    assert_eq!(reservoir.contribution_weight(), before, "the weight stays");
}

#[test]
fn merging_the_same_target_adds_up() {
    let mut all = of(&[1.0, 3.0], u64::MAX);
    all.merge(of(&[4.0, 0.0, 8.0], 0), |&index| [4.0, 0.0, 8.0][index], 0);
    assert_eq!((all.value(), all.total()), (Some(&2), 16.0), "all weights");
    assert_eq!((all.count(), all.target()), (5, 8.0), "all candidates");
    all.merge(WeightedReservoir::new(), |_| unreachable!("no value"), 0);
    assert_eq!(
        (all.count(), all.contribution_weight()),
        (5, 0.4),
        "nothing"
    );
}
