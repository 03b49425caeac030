use super::*;
use crate::fraction::{from_f64, stratum};

/// Some numbers of weights: below, at and above the groups of one and two choices.
const COUNTS: [usize; 6] = [1, 3, 64, 65, 4096, 5000];

fn weight(index: usize) -> f32 {
    ((index * 37 % 101) as f32 - 50.0).exp2()
}

#[test]
fn what_is_left_of_u_is_how_far_into_the_weight_it_falls() {
    let weights = [1.0, 0.0, 3.0];
    // Two parts are left over.
    let first = (1u32 << 14) + 2;
    let s = sample(&weights, u64::from(first / 2) << 48).expect("a weight");
    assert_eq!((s.index, s.pmf), (0, first as f32 * PART), "the first");
    assert_eq!(s.u >> 48, u64::from(PARTS / 2), "half way");
    let s = sample(&weights, u64::from(first) << 48).expect("a weight");
    assert_eq!((s.index, s.u), (2, 0), "where the first ends");
    let s = sample(&weights, u64::MAX).expect("a weight");
    assert_eq!((s.index, s.u >> 32), (2, 0xffff_ffff), "the end");
}

#[test]
fn probabilities_sum_to_one_and_are_near_proportion() {
    for count in COUNTS {
        let total: f64 = (0..count).map(|i| f64::from(weight(i))).sum();
        let mut sum = 0.0;
        for index in 0..count {
            let pmf = f64::from(pmf_by(count, weight, index));
            let exact = f64::from(weight(index)) / total;
            // Three choices at the most; the first weight of each takes what is left over.
            assert!(
                pmf >= exact * (1.0 - 3.0 / 1024.0),
                "{index} of {count}: {pmf} {exact}"
            );
            assert!(
                pmf <= exact + 3.0 * 65.0 / 65536.0,
                "{index} of {count}: {pmf} {exact}"
            );
            sum += pmf;
        }
        assert!((sum - 1.0).abs() < 1e-6, "{count}: {sum}");
    }
}

#[test]
fn samples_follow_their_probabilities() {
    for count in COUNTS {
        let strata = 1 << 14;
        let (mut last, mut run) = (0, 0u32);
        for i in 0..strata {
            let s = sample_by(count, weight, stratum(i, strata, 1 << 63)).expect("weights");
            assert_eq!(s.pmf, pmf_by(count, weight, s.index), "same bits");
            assert!(s.index >= last, "a larger u, no earlier weight");
            if s.index > last {
                let pmf = pmf_by(count, weight, last);
                let expected = pmf * strata as f32;
                assert!(
                    (run as f32 - expected).abs() < 2.0,
                    "{last}: {run} {expected}"
                );
                (last, run) = (s.index, 0);
            }
            run += 1;
        }
    }
}

#[test]
fn a_weight_that_is_not_positive_is_never_chosen() {
    let weights = [0.0, f32::NAN, 2.0, -1.0, 1e-45, -0.0];
    for u in [0, 1 << 63, u64::MAX] {
        let s = sample(&weights, u).expect("a weight");
        assert!(s.index == 2 || s.index == 4, "{s:?}");
        assert_eq!(s.pmf, pmf(&weights, s.index), "same bits");
    }
    assert_eq!(pmf(&weights, 4), PART, "a part for the faintest");
    assert_eq!(pmf(&weights, 1), 0.0, "NaN");
}

#[test]
fn an_infinite_sum_is_still_a_distribution() {
    for weights in [[f32::MAX, f32::MAX, 1.0], [1.0, f32::INFINITY, 0.5]] {
        let pmfs = [0, 1, 2].map(|i| pmf(&weights, i));
        assert_eq!(pmfs.iter().sum::<f32>(), 1.0, "{weights:?}");
        assert!(pmfs.iter().all(|&pmf| pmf > 0.0), "{pmfs:?}");
    }
    for count in [2, 3, 64] {
        let pmf = pmf_by(count, |_| f32::MAX, count - 1);
        let even = 1.0 / count as f32;
        assert!((pmf / even - 1.0).abs() < 0.1, "{count} alike: {pmf}");
    }
}

#[test]
fn the_smallest_weights_keep_their_proportion() {
    assert_eq!(LEAST_TOTAL, 2f32.powi(-100), "a power of two");
    let weights = [1e-45, 0.0, 4.2e-45];
    let pmfs = [0, 1, 2].map(|i| pmf(&weights, i));
    assert!((pmfs[0] - 0.25).abs() < 1e-4 && pmfs[1] == 0.0, "{pmfs:?}");
    assert!((pmfs[2] - 0.75).abs() < 1e-4, "{pmfs:?}");
}

#[test]
fn nothing_to_choose() {
    assert_eq!(sample(&[], 0), None, "no weights");
    assert_eq!(
        sample(&[0.0, f32::NAN], from_f64(0.5)),
        None,
        "none positive"
    );
    assert_eq!(pmf(&[1.0], 7), 0.0, "out of range");
}
