use alloc::vec::Vec;

use crate::rgb_sum::single;

/// The weights of MIS compensation: the part above the mean.
///
/// # Source
/// `[Karlik2019]`, with the constant for an image that is the same everywhere.
pub(crate) fn compensate(averages: &[f32]) -> Vec<f32> {
    let sum: f64 = averages.iter().copied().map(f64::from).sum();
    let mean = single(sum / averages.len() as f64);
    let above: Vec<f32> = averages.iter().map(|a| (a - mean).max(0.0)).collect();
    if mean > 0.0 && above.iter().all(|&a| a == 0.0) {
        alloc::vec![1.0; averages.len()]
    } else {
        above
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn compensation_leaves_what_is_above_the_mean() {
        assert_eq!(
            compensate(&[1.0, 2.0, 3.0, 6.0]),
            [0.0, 0.0, 0.0, 3.0],
            "above 3"
        );
        assert_eq!(compensate(&[5.0; 4]), [1.0; 4], "the same everywhere");
        assert_eq!(compensate(&[0.0; 4]), [0.0; 4], "black stays black");
    }
}
