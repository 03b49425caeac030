use super::*;
use alloc::vec::Vec;

/// The running sum of some weights.
fn below(weights: &[u64]) -> impl Fn(usize) -> u128 + '_ {
    |i| weights[..i].iter().copied().map(u128::from).sum()
}

#[test]
fn covers_texels_in_part() {
    let weights = [1, 2, 3, 4];
    let sum = |min, max| {
        let span = Span::new(min, max, 4);
        // The logarithm is beyond what a double can be a power of.
        let half = span.log2_steps() / 2;
        let sum = span.sum(below(&weights)) as f64 / 2f64.powi(half);
        sum / 2f64.powi(span.log2_steps() - half)
    };
    assert_eq!(sum(0.125, 0.875), 0.5 + 2.0 + 3.0 + 2.0, "in part");
    assert_eq!(sum(0.25, 0.375), 1.0, "within one");
    assert_eq!(sum(0.25, 0.5), 2.0, "exactly one");
    assert_eq!(sum(0.0, 1.0), 10.0, "all");
    let narrow = f32::from_bits(3);
    assert_eq!(
        sum(0.0, narrow),
        4.0 * f64::from(narrow),
        "three of the smallest"
    );
}

#[test]
fn choices_are_where_the_running_sum_passes_u() {
    let weights = [5, 0, 1 << 61, 7, 0, 1, 1 << 62, 3];
    let ends = [0.0, 1e-30, 0.01, 0.125, 0.3, 0.375, 0.56, 0.8, 0.875, 1.0];
    for (i, &min) in ends.iter().enumerate() {
        for &max in &ends[i + 1..] {
            let span = Span::new(min, max, 8);
            let total = span.sum(below(&weights));
            for u in [0.0, 1e-9, 0.2, 0.5, 0.999, 0.999_999_94, 1.0, f32::NAN] {
                let Some(chosen) = span.choose(u, below(&weights)) else {
                    assert_eq!(total, 0, "from {min} to {max}");
                    continue;
                };
                let (texel, x) = (chosen.texel, chosen.x);
                assert!(weights[texel] > 0 && (min..=max).contains(&x), "{u}: {x}");
                assert_eq!(super::texel(x, 8), texel, "{u} from {min} to {max}");
                assert_eq!(chosen.total, total, "{u} from {min} to {max}");
                // The share of the interval up to there, of weights that doubles can hold.
                let up_to = |x: f64| -> f64 {
                    let texels = weights.iter().zip(0..);
                    let covered = |i: i32| (x * 8.0).min(f64::from(i + 1)) - f64::from(i);
                    let from = |i: i32| f64::from(min) * 8.0 - f64::from(i);
                    texels
                        .map(|(&w, i)| w as f64 * (covered(i) - from(i).max(0.0)).max(0.0))
                        .sum()
                };
                let share = up_to(x.into()) / up_to(max.into());
                let u = f64::from(u.clamp(0.0, 1.0));
                // A step of a float of the point, where a texel holds all the weight.
                let rounding = 1e-6 * f64::from(max / (max - min));
                assert!(u.is_nan() || (share - u).abs() <= rounding, "{u}: {share}");
            }
        }
    }
}

#[test]
fn narrow_intervals_across_an_edge_have_both_sides() {
    // 1/3 of a texel on the left, 2/3 on the right, at the least distances between floats.
    let edge = 0.5f32;
    let span = Span::new(next_down(edge), next_up(edge), 1000);
    let points: Vec<usize> = [0.0, 0.33, 0.34, 0.9]
        .into_iter()
        .filter_map(|u| span.choose(u, |i| i as u128))
        .map(|chosen| chosen.texel)
        .collect();
    assert_eq!(points, [499, 499, 500, 500], "by width");
}
